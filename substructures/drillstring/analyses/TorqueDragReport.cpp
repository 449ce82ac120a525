// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <vector>

#include "cases/run/AnalysisFiles.hpp"
#include "cases/run/Run.hpp"
#include "common/Constants.hpp"
#include "common/report/Detail.hpp"
#include "common/report/Log.hpp"
#include "deck/PrintedUnits.hpp"
#include "substructures/drillstring/analyses/Calibration.hpp"
#include "substructures/drillstring/analyses/TorqueDrag.hpp"
#include "substructures/drillstring/analyses/TorqueDragTables.hpp"
#include "substructures/drillstring/scene/Remarks.hpp"
#include "substructures/drillstring/scene/Stages.hpp"

namespace tooljoint::drillstring {
namespace {

/// A torque imbalance above this fraction of its scale is reported.
constexpr double worthAWarning = 0.02;

std::string text(double value, int digits) {
  if (!std::isfinite(value)) return "-";
  const auto number = fmt::format("{:.{}f}", value, digits);
  const bool zero = number.find_first_not_of("-0.") == std::string::npos;
  return zero && number[0] == '-' ? number.substr(1) : number;
}
/// An SI value in its printed unit.
std::string text(double value, const char* usual, int digits) {
  const deck::PrintedUnit unit(usual);
  return std::isfinite(value) ? text(unit(value), digits) + " " + unit.name() : "-";
}
/// A margin; a value beyond any realistic load is printed as ">999".
std::string inColumn(const Margin& margin) {
  return std::isfinite(margin.factor) && margin.factor > 999.0 ? ">999" : text(margin.factor, 2);
}

void print(const TorqueDragRow& row) {
  log::info(fmt::format("{:<18}{:>13}{:>15}{:>9}{:>14}{:>8}{:>8}{:>8}", row.operation,
                        text(row.hookLoad, "kN", 1), text(row.surfaceTorque, "kN m", 2),
                        text(row.twist / constants::twoPi, 2),
                        text(row.largestSideForce, "kN/m", 2), inColumn(row.yield),
                        inColumn(row.sinusoidal), inColumn(row.helical)));
  if (row.lockUpDepth >= 0.0)
    log::warn(
        fmt::format("{} with the bit at {}: the string locks up at {}. No force from the surface "
                    "reaches the bit.",
                    row.operation, text(row.bit, "m", 0), text(row.lockUpDepth, "m", 0)));
  else if (row.hookLoad < 0.0)
    log::warn(
        fmt::format("{} with the bit at {}: the hook load is {}. The string has to be pushed from "
                    "the surface.",
                    row.operation, text(row.bit, "m", 0), text(row.hookLoad, "kN", 1)));
}

/// "+1.2 %" relative to the value of the soft string.
std::string beside(double stiff, double soft) {
  if (!std::isfinite(soft) || soft == 0.0) return "-";
  const std::string text = fmt::format("{:+.1f}", 100.0 * (stiff / soft - 1.0));
  return (text == "-0.0" || text == "+0.0" ? "0.0" : text) + " %";
}

/// Reason for a missing buckled state; with a remedy unless the soft string locks up.
std::string withAdvice(const std::string& why, const TorqueDragRow& row, const StiffLoads& stiff) {
  return row.lockUpDepth >= 0.0 || stiff.advice.empty() ? why : why + " " + stiff.advice;
}

/// Reason for a missing result of the stiff string, with the related result of the soft one.
std::string reason(const TorqueDragRow& row, const StiffLoads& stiff) {
  const std::string failure = withAdvice(stiff.failure, row, stiff);
  const auto buckled = [&](const Margin& margin, const char* limit) {
    return fmt::format("Its compression at {} is {:.1f} times the {} limit (soft string). {}",
                       text(margin.depth, "m", 0), 1.0 / margin.factor, limit, failure);
  };
  if (row.lockUpDepth >= 0.0) return "The soft string locks up. " + failure;
  if (row.helical.factor < 1.0) return buckled(row.helical, "helical");
  if (row.sinusoidal.factor < 1.0) return buckled(row.sinusoidal, "sinusoidal");
  return failure;
}

void printStiff(const Scene& scene, const TorqueDragProfile& profile,
                const softstring::TorqueDragSettings& settings) {
  const TorqueDragRow& row = profile.row;
  const StiffLoads& stiff = *profile.stiff;
  if (!stiff.found()) {
    log::detail(stiff.failure);
    if (stiff.locksUp)
      return log::warn(fmt::format("{} with the bit at {}: the stiff string locks up.",
                                   row.operation, text(row.bit, "m", 0)));
    return log::warn(fmt::format("{} with the bit at {}: the stiff string has no result. {}",
                                 row.operation, text(row.bit, "m", 0), reason(row, stiff)));
  }
  const double hookLoad = stiff.hookLoad + settings.blockWeight;
  log::info(fmt::format(
      "{:<18}{:>13}{:>9}{:>15}{:>9}{:>9}{:>14}{:>8}", row.operation, text(hookLoad, "kN", 1),
      beside(hookLoad, row.hookLoad), text(stiff.surfaceTorque, "kN m", 2),
      beside(stiff.surfaceTorque, row.surfaceTorque), text(stiff.twist / constants::twoPi, 2),
      text(largestContact(stiff).factor, "kN", 2), inColumn(stiff.yield)));
  if (stiff.torqueDefect > worthAWarning && prestressRemark(scene).empty())
    log::warn(
        fmt::format("{} with the bit at {}: the torque of the stiff string is out of balance by "
                    "{:.1f} %. Use shorter elements where the well bends most.",
                    row.operation, text(row.bit, "m", 0), 100.0 * stiff.torqueDefect));
}

void warnOfBuckling(const std::vector<TorqueDragProfile>& profiles) {
  int all = 0, unstable = 0, buckled = 0;
  const TorqueDragProfile *first = nullptr, *bent = nullptr;
  for (const auto& profile : profiles) {
    if (!profile.stiff || !profile.stiff->found()) continue;
    ++all;
    if (profile.stiff->buckled && buckled++ == 0) bent = &profile;
    if (profile.stiff->negativePivots == 0) continue;
    ++unstable;
    if (first == nullptr) first = &profile;
  }
  if (bent != nullptr)
    log::info(fmt::format(
        "{} of {} states of the stiff string are buckled ({} with the bit at {} first); a buckled "
        "string can rest in several ways, with other loads",
        buckled, all, bent->row.operation, text(bent->row.bit, "m", 0)));
  if (first != nullptr)
    log::warn(fmt::format(
        "{} of {} states of the stiff string are unstable ({} with the bit at {} first): there its "
        "contact and torque are larger than these. {}",
        unstable, all, first->row.operation, text(first->row.bit, "m", 0),
        withAdvice(first->stiff->unsettled, first->row, *first->stiff)));
}

/// Parts of the string without a known strength have no margin to yield.
void warnOfStrength(const Scene& scene, const softstring::TorqueDragSettings& settings) {
  if (settings.yieldStrength) return;
  double whole = 0.0, without = 0.0;
  for (const auto& stretch : softModel(scene).string) {
    whole += stretch.length;
    if (!stretch.section.material().yieldStrength) without += stretch.length;
  }
  if (without > 0.0 && without < whole)
    log::warn(fmt::format(
        "{} of the string's {} have no yield strength: the yield margins leave them out. Give "
        "Torque and Drag/Yield Strength, or that of the Material of Drillstring or of a component.",
        text(without, "m", 0), text(whole, "m", 0)));
}

/// The tables of the deepest bit.
void print(const Scene& scene, const std::vector<TorqueDragProfile>& profiles,
           const softstring::TorqueDragSettings& settings) {
  const double deepest = deepestBit(profiles);
  log::info(
      fmt::format("torque and drag, soft string, bit at {}; margins are allowed over present load",
                  text(deepest, "m", 1)));
  log::info(fmt::format("operations that turn do so at {:.4g} rpm",
                        turningSpeed(scene, settings) / constants::rpm));
  log::info(fmt::format("{:<18}{:>13}{:>15}{:>9}{:>14}{:>8}{:>8}{:>8}", "operation", "hook load",
                        "surface torque", "turns", "side force", "yield", "sinus.", "helix"));
  for (const auto& profile : profiles)
    if (profile.row.bit == deepest) print(profile.row);
  warnOfStrength(scene, settings);
  if (std::none_of(profiles.begin(), profiles.end(),
                   [](const auto& profile) { return profile.stiff.has_value(); }))
    return;
  log::info("the string with bending stiffness, clearance and contact beside it");
  log::info(fmt::format("{:<18}{:>13}{:>9}{:>15}{:>9}{:>9}{:>14}{:>8}", "operation", "hook load",
                        "", "surface torque", "", "turns", "contact", "yield"));
  for (const auto& profile : profiles)
    if (profile.stiff && (profile.row.bit == deepest || !profile.stiff->found()))
      printStiff(scene, profile, settings);
  warnOfBuckling(profiles);
  if (const auto remark = prestressRemark(scene); !remark.empty()) log::warn(remark);
}

}  // namespace

bool torqueDragAfterRun(const DrillstringCase& one) {
  if (!torqueDragList(one.scene()).afterRun) return false;
  softModel(one.scene());
  calibrationOf(one.scene(), torqueDragSettings(one.scene()));
  return true;
}

void reportTorqueDrag(const DrillstringCase& one, const std::string& folder, bool fresh,
                      bool announced) {
  const Scene& scene = one.scene();
  const auto settings = torqueDragSettings(scene);
  cases::AnalysisFiles files(one, folder, "torque_drag", cases::Beside::Results);
  std::vector<TorqueDragProfile> profiles;
  CalibrationResults calibration;
  files.complete(
      [&] {
        if (!announced) cases::announce(one);
        calibration = calibrationOf(scene, settings);  // reports its faults before the long
                                                       // computation
        profiles = torqueDrag(scene, {one, files.folder().folder(), fresh});
        print(scene, profiles, settings);
      },
      [&](io::ResultsFile& file) {
        stageTables(profiles, settings, files.folder());
        writeDatasets(profiles, settings, file);
        summarise(profiles, settings, files.summary());
        files.summary().set("torque_drag.rotary_speed_rpm",
                            turningSpeed(scene, settings) / constants::rpm);
        stage(calibration, files.folder());
        summarise(calibration, files.summary());
      });
}

}  // namespace tooljoint::drillstring
