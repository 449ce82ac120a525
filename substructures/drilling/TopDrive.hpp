// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The drive at the surface: rotation and axial support of the string. Deck list `Top Drive`.
#pragma once

#include <Teuchos_ParameterList.hpp>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "deck/ListSpec.hpp"
#include "substructures/beam/Section.hpp"
#include "substructures/drilling/Autodriller.hpp"
#include "substructures/drilling/PointOnString.hpp"

namespace tooljoint::drilling {

enum class DriveControl {
  Stiff,            ///< the top turns with the rotary speed, whatever the torque
  Torque,           ///< a constant torque on the inertia of the drive
  Speed,            ///< a PI controller of the speed
  ImpedanceMatched  ///< a PI controller with gains that absorb torsional waves
};

/// The values of the list; the defaults are those of a deck without the list.
struct TopDrive {
  DriveControl control = DriveControl::Stiff;
  double inertia = 0.0;           ///< J [kg m2]
  double proportionalGain = 0.0;  ///< k_p [N m s/rad]
  double integralGain = 0.0;      ///< k_i [N m/rad]
  double tuningFrequency = 0.0;   ///< of ImpedanceMatched [Hz]; 0: highPass is used
  double highPass = 0.0;          ///< of ImpedanceMatched [Hz]
  double impedanceRatio = 1.0;    ///< of ImpedanceMatched: k_p over the impedance of the pipe
  double pipeImpedance = 0.0;     ///< of the pipe below, torsionalImpedance() [N m s/rad]
  double torque = 0.0;            ///< of Torque [N m]
  bool torqueGiven = false;       ///< false: the torque of the static state
  double torqueLimit = 0.0;       ///< [N m]; 0: none
  double blockSpeed = 0.0;        ///< downward speed of the block [m/s]
  bool constantHookLoad = false;  ///< the top is free to move under a constant load
  std::optional<Autodriller> autodriller = std::nullopt;

  bool turnsFreely() const { return control != DriveControl::Stiff; }
  /// Free along the well.
  bool movesFreely() const { return constantHookLoad || autodriller; }
};

/// Description of the list `Top Drive`.
deck::ListSpec topDriveParameters();
/// From the validated list. DeckError for parameters that the control needs and does not find, or
/// does not use.
TopDrive readTopDrive(const Teuchos::ParameterList& list);

/// Characteristic impedance of a run of pipe for waves much longer than its pieces [N m s/rad]:
/// sqrt(j k), with the mean of j = rho I_p and the harmonic mean of k = G J over the lengths.
double torsionalImpedance(const std::vector<std::pair<beam::Section, double>>& pieces);

/// The drive with its gains, on a pipe of this impedance: ImpedanceMatched has k_p = ratio zeta.
/// With a tuning frequency f, k_i = J (2 pi f)^2: at f the impedance of the drive, k_p + i (omega J
/// - k_i/omega), equals that of the pipe and no wave is reflected (A. Kyllingstad and P. J.
/// Nessjoen, SPE 119660 (2009)). With a high-pass frequency f, k_i = 2 pi f k_p: without its
/// inertia the drive yields to the torque T by v = -s/(s + 2 pi f) T/k_p, that is only to torque
/// above f. Warns if the inertia prevents this.
TopDrive tuned(TopDrive drive, double impedance);

/// The torque of the drive on theta_z of the first node, in the frame that turns with the set
/// speed. `staticTorque` [N m]: torque of the drive in the static state, from which the motion
/// starts. Channel top_drive_torque. Throws ModelError for a static torque above the limit.
PointOnString driveOnString(const TopDrive& drive, double staticTorque);

/// Reflection of torsional waves at a controlled drive: amplitude |r|, r = (zeta - Z)/(zeta + Z),
/// with the impedances Z = k_p + i (omega J - k_i/omega) of the drive and zeta of the pipe. The
/// torque limit is not considered.
struct WaveReflection {
  double least = 1.0;      ///< |k_p - zeta|/(k_p + zeta)
  double frequency = 0.0;  ///< frequency of `least` [Hz]; infinity: far above all others
  double from = 0.0;       ///< start of the range with |r| < 1/2 [Hz]
  double to = 0.0;         ///< end of that range, may be infinite; equals `from` if there is none
};
WaveReflection waveReflection(const TopDrive& drive);

/// The description that `tooljoint check` prints.
std::string describe(const TopDrive& drive);
/// Its line on wave reflection; empty for a drive without a speed controller.
std::string describeWaves(const TopDrive& drive);

}  // namespace tooljoint::drilling
