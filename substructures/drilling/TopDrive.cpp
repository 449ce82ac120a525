// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drilling/TopDrive.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "common/Index.hpp"
#include "common/Text.hpp"
#include "common/report/Log.hpp"
#include "deck/PrintedUnits.hpp"
#include "model/laws/PointLawRegistry.hpp"
#include "substructures/beam/NodalDofs.hpp"
#include "substructures/drilling/BitLaw.hpp"

namespace tooljoint::drilling {
namespace {

using deck::Optional;
using deck::Range;

struct Control {
  DriveControl control;
  const char* name;
  std::vector<std::string> needs, takes;  ///< in addition to the parameters of every control
};

const std::vector<Control>& controls() {
  static const std::vector<Control> all{
      {DriveControl::Stiff, "Stiff", {}, {}},
      {DriveControl::Torque, "Torque", {"Inertia"}, {"Inertia", "Torque"}},
      {DriveControl::Speed,
       "Speed",
       {"Inertia", "Proportional Gain"},
       {"Inertia", "Proportional Gain", "Integral Gain", "Torque Limit"}},
      {DriveControl::ImpedanceMatched,
       "Impedance Matched",
       {"Inertia"},
       {"Inertia", "Tuning Frequency", "High-Pass Frequency", "Impedance Ratio", "Torque Limit"}}};
  return all;
}

const Control& controlNamed(const std::string& name) {
  for (const auto& one : controls())
    if (one.name == name) return one;
  throw Error(ExitCode::Internal, "There is no control " + inQuotes(name) + " of a top drive.");
}

double given(const Teuchos::ParameterList& list, const char* name, double otherwise = 0.0) {
  return list.isParameter(name) ? list.get<double>(name) : otherwise;
}

void checkParameters(const Teuchos::ParameterList& list, const Control& control) {
  for (const auto& needed : control.needs)
    if (!list.isParameter(needed))
      throw DeckError(list.name() + "/" + needed + " is missing: the control " +
                      inQuotes(control.name) + " needs it.");
  for (const auto& other : controls())
    for (const auto& name : other.takes)
      if (list.isParameter(name) && !contains(control.takes, name))
        throw DeckError(list.name() + "/" + name + " is not used by the control " +
                        inQuotes(control.name) + ". Leave it out, or choose another control.");
  if (control.control == DriveControl::ImpedanceMatched &&
      list.isParameter("Tuning Frequency") == list.isParameter("High-Pass Frequency"))
    throw DeckError(list.name() + "/Control is " + inQuotes(control.name) +
                    ", which needs either Tuning Frequency or High-Pass Frequency. Give one.");
  if (list.isParameter("Tuning Frequency") && given(list, "Inertia") == 0.0)
    throw DeckError(list.name() +
                    "/Tuning Frequency has no effect on a drive without Inertia, which has no "
                    "integral gain then. Give the Inertia, or High-Pass Frequency instead.");
  if (list.isParameter("Torque Limit") && given(list, "Integral Gain") > 0.0 &&
      given(list, "Proportional Gain") == 0.0)
    throw DeckError(list.name() +
                    "/Torque Limit with an Integral Gain needs a positive Proportional Gain, which "
                    "keeps the integral within the limit.");
}

}  // namespace

deck::ListSpec topDriveParameters() {
  std::vector<std::string> names;
  for (const auto& one : controls()) names.emplace_back(one.name);
  return deck::ListSpec("Top Drive",
                        "How the drive turns and carries the string; without this list it turns "
                        "with the speed of Rotary Speed and stands.")
      .choice("Control", std::string("Stiff"), names,
              "Stiff: the top turns with Rotary Speed, whatever the torque. Torque: a constant "
              "torque on the inertia of the drive. Speed: a PI controller holds the speed of "
              "Rotary Speed. Impedance Matched: the same with gains that absorb torsional waves, "
              "those of the Tuning Frequency or those above the High-Pass Frequency.")
      .real("Inertia", "kg m2", Optional{}, Range::nonNegative(),
            "Moment of inertia J of drive and gear at the string; all controls but Stiff.")
      .real("Proportional Gain", "N m s/rad", Optional{}, Range::nonNegative(),
            "Gain k_p on the speed error; control Speed.")
      .real("Integral Gain", "N m/rad", Optional{}, Range::nonNegative(),
            "Gain k_i on the integral of the speed error, 0 without it; control Speed.")
      .real("Tuning Frequency", "Hz", Optional{}, Range::positive(),
            "Frequency without reflection, that of stick-slip: the integral gain cancels the "
            "inertia there; control Impedance Matched.")
      .real("High-Pass Frequency", "Hz", Optional{}, Range::positive(),
            "Instead of it: the drive holds its set speed against torques below this frequency and "
            "yields to those above as the pipe would; control Impedance Matched.")
      .expert()
      .real("Impedance Ratio", "", Optional{}, Range::positive(),
            "k_p over the impedance of the uppermost tenth of the string, 1 without it; control "
            "Impedance Matched.")
      .expert()
      .real("Torque", "N m", Optional{}, Range::any(),
            "Torque of the control Torque; without it that of the static state.")
      .real("Torque Limit", "N m", Optional{}, Range::positive(),
            "Largest torque of a controlled drive either way; no limit without it.")
      .real("Block Speed", "m/s", 0.0, Range::any(),
            "Downward speed of the block: the feed of a Bit law that gives the weight on bit, and "
            "with Contact/Friction/Axial the speed at which the string slides along the hole; "
            "negative upwards, without such a Bit. With an Autodriller that of the static state; "
            "without it the one of its Weight On Bit.")
      .choice("Hook", std::string("Block"), {"Block", "Constant Load"},
              "Block: the top moves with the block. Constant Load: the top is free along the well "
              "under the hook load of the static state at the Block Speed.")
      .expert()
      .list(autodrillerParameters());
}

TopDrive readTopDrive(const Teuchos::ParameterList& list) {
  const auto& control = controlNamed(list.get<std::string>("Control"));
  checkParameters(list, control);
  TopDrive drive;
  drive.control = control.control;
  drive.inertia = given(list, "Inertia");
  drive.proportionalGain = given(list, "Proportional Gain");
  drive.integralGain = given(list, "Integral Gain");
  drive.tuningFrequency = given(list, "Tuning Frequency");
  drive.highPass = given(list, "High-Pass Frequency");
  drive.impedanceRatio = given(list, "Impedance Ratio", 1.0);
  drive.torque = given(list, "Torque");
  drive.torqueGiven = list.isParameter("Torque");
  drive.torqueLimit = given(list, "Torque Limit");
  drive.blockSpeed = list.get<double>("Block Speed");
  drive.constantHookLoad = list.get<std::string>("Hook") == "Constant Load";
  if (list.isSublist("Autodriller"))
    drive.autodriller = readAutodriller(list.sublist("Autodriller"));
  return drive;
}

double torsionalImpedance(const std::vector<std::pair<beam::Section, double>>& pieces) {
  double inertia = 0.0, compliance = 0.0;
  for (const auto& [section, length] : pieces) {
    inertia += section.density() * section.polar() * length;
    compliance += length / section.torsionalRigidity();
  }
  return std::sqrt(inertia / compliance);
}

WaveReflection waveReflection(const TopDrive& drive) {
  const double zeta = drive.pipeImpedance, kp = drive.proportionalGain, ki = drive.integralGain,
               J = drive.inertia, infinite = std::numeric_limits<double>::infinity();
  WaveReflection found;
  found.least = std::abs(kp - zeta) / (kp + zeta);
  found.frequency = ki == 0.0 ? 0.0 : J == 0.0 ? infinite : std::sqrt(ki / J) / constants::twoPi;
  // |r| < 1/2 where |omega J - k_i/omega| < x, 3 x^2 = (k_p + zeta)^2 - 4 (k_p - zeta)^2
  const double square = ((kp + zeta) * (kp + zeta) - 4 * (kp - zeta) * (kp - zeta)) / 3;
  found.from = found.to = found.frequency;
  if (square <= 0.0) return found;
  const double x = std::sqrt(square), root = std::sqrt(square + 4 * J * ki);
  found.from = 2 * ki / (x + root) / constants::twoPi;
  found.to = J == 0.0 ? infinite : (x + root) / (2 * J) / constants::twoPi;
  return found;
}

namespace {

void warnOfIdleHighPass(const TopDrive& drive) {
  const auto waves = waveReflection(drive);
  if (drive.highPass == 0.0 || waves.from >= waves.to || waves.to > drive.highPass) return;
  log::warn("Top Drive/High-Pass Frequency is " + deck::printed(drive.highPass, "Hz") +
            ", but the inertia of " + deck::printed(drive.inertia, "kg m2") +
            " keeps the drive from yielding to waves above it: it sends back more than half of "
            "all above " +
            deck::printed(waves.to, "Hz", 3) +
            ". Give the Inertia that the controller leaves of it, or a Tuning Frequency instead.");
}

}  // namespace

TopDrive tuned(TopDrive drive, double impedance) {
  drive.pipeImpedance = impedance;
  if (drive.control != DriveControl::ImpedanceMatched) return drive;
  const double omega = constants::twoPi * drive.tuningFrequency;
  drive.proportionalGain = drive.impedanceRatio * impedance;
  drive.integralGain = drive.highPass > 0.0
                           ? constants::twoPi * drive.highPass * drive.proportionalGain
                           : drive.inertia * omega * omega;
  warnOfIdleHighPass(drive);
  return drive;
}

PointOnString driveOnString(const TopDrive& drive, double staticTorque) {
  if (drive.torqueLimit > 0.0 && std::abs(staticTorque) > drive.torqueLimit)
    throw ModelError("The static state needs a torque of " +
                     formatNumber(std::round(staticTorque)) +
                     " N m from the top drive, more than its Top Drive/Torque Limit of " +
                     formatNumber(drive.torqueLimit) + " N m. Raise it, or reduce the torque.");
  // the frame turns with the set speed, so the set speed in the frame is zero
  Teuchos::ParameterList own("Speed Control");
  own.set("Speed", 0.0)
      .set("Proportional Gain", drive.proportionalGain)
      .set("Integral Gain", drive.integralGain)
      .set("Initial Force", drive.torqueGiven ? drive.torque : staticTorque);
  if (drive.torqueLimit > 0.0) own.set("Force Limit", drive.torqueLimit);
  return onString(topDriveSet, 0,
                  {{beam::nodal::thetaZ,
                    {},
                    {"top_drive_torque", "N m", "Torque of the top drive on the string"},
                    1.0}},
                  model::PointLawRegistry::instance().make("Speed Control", own, {1, 1}));
}

std::string describeWaves(const TopDrive& drive) {
  if (drive.control != DriveControl::Speed && drive.control != DriveControl::ImpedanceMatched)
    return {};
  const auto waves = waveReflection(drive);
  const auto hertz = [](double f) { return deck::printed(f, "Hz", 3); };
  const auto share = deck::printed(100 * waves.least, "%", 2);
  const std::string least = "the drive sends back " + share + " at least, " +
                            (std::isinf(waves.frequency) ? "at high frequencies"
                             : waves.frequency == 0.0    ? "at low frequencies"
                                                         : "at " + hertz(waves.frequency));
  if (waves.from >= waves.to) return least;
  return least + "; less than half " +
         (waves.from == 0.0      ? "below " + hertz(waves.to)
          : std::isinf(waves.to) ? "above " + hertz(waves.from)
                                 : "from " + hertz(waves.from) + " to " + hertz(waves.to));
}

std::string describe(const TopDrive& drive) {
  std::string text;
  if (drive.control == DriveControl::Stiff)
    text = "stiff";
  else if (drive.control == DriveControl::Torque)
    text = drive.torqueGiven ? "constant torque of " + deck::printed(drive.torque, "N m")
                             : "constant torque of the static state";
  else
    text = "speed controlled, k_p = " + deck::printed(drive.proportionalGain, "N m s/rad", 6) +
           ", k_i = " + deck::printed(drive.integralGain, "N m/rad", 6);
  if (drive.turnsFreely()) text += ", inertia " + deck::printed(drive.inertia, "kg m2");
  if (drive.torqueLimit > 0.0) text += ", at most " + deck::printed(drive.torqueLimit, "N m");
  if (drive.blockSpeed != 0.0)
    text += std::string(", block ") + (drive.blockSpeed > 0.0 ? "down" : "up") + " at " +
            deck::printed(std::abs(drive.blockSpeed), "m/s", 6);
  if (drive.autodriller)
    text += ", autodriller for " + deck::printed(drive.autodriller->weight, "kN", 6);
  return text + (drive.constantHookLoad ? ", constant hook load" : "");
}

}  // namespace tooljoint::drilling
