// SPDX-License-Identifier: BSD-3-Clause
#include "transient/accuracy/StepVerdict.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <optional>
#include <sstream>
#include <string>

#include "common/Error.hpp"
#include "common/report/Log.hpp"

namespace tooljoint::transient {
namespace {

/// The motion is compared from this part of `Step Error Limit` on, and from this part of `Step
/// Error Warning` that the scheme damps: what it holds down from the start has little to lose.
constexpr double compared = 0.5, damps = 0.2;
/// Step error as large as the motion, which no comparison saves.
constexpr double all = 1;
/// Part of D from which the sensitivity explains it.
constexpr double explains = 0.25;
/// Times `Step Error Limit` by which speeds may be larger or smaller: by half at its default.
constexpr double ofSpeeds = 2.5;

/// A part of 1 in per cent, with two digits.
std::string percent(double part) {
  std::ostringstream text;
  text << std::setprecision(2) << 100 * part;
  std::ostringstream plain;
  plain << std::stod(text.str()) << " %";
  return plain.str();
}

/// What is known of the steps of a run.
struct Findings {
  double error = 0;   ///< S
  double damped = 0;  ///< part of the amplitude that the scheme takes
  std::optional<StepComparison::Difference> halves;
  std::optional<StepComparison::Difference> neighbour;  ///< of the halves

  /// Means that are far from those of the halves.
  bool isSlow(double limit) const { return halves && halves->speeds * (1 + ofSpeeds * limit) < 1; }
  bool isFast(double limit) const { return halves && halves->speeds > 1 + ofSpeeds * limit; }
  /// Neighbours part as far as steps and halves do.
  bool isChaos() const { return neighbour && neighbour->size > explains * halves->size; }
  double reported() const { return halves ? halves->size : error; }
  bool isRight(double warning) const {
    return halves && halves->size <= warning && std::abs(halves->speeds - 1) <= warning;
  }
};

std::string describe(const Findings& found, double span) {
  std::ostringstream text;
  text << "step error " << percent(found.error);
  if (!found.halves) return text.str();
  text << std::setprecision(2) << "; in its first " << span << " s the motion differs by "
       << percent(found.halves->size)
       << " from that in half the step without numerical damping, at " << found.halves->speeds
       << " of its speed";
  if (found.neighbour)
    text << ", and a disturbance of 0.1 % changes that by " << percent(found.neighbour->size);
  return text.str();
}

void warnOfDamping(const Findings& found, const StepError& error, double step) {
  std::ostringstream text;
  text << "The scheme damps vibration: steps of " << step << " s take " << percent(found.damped)
       << " of its amplitude in " << error.span() << " s. What friction makes grow may stay small. "
       << error.damping()->dampingAdvice();
  log::warn(text.str());
}

}  // namespace

double judgeSteps(const Integrator& run, const StepError& error, const TransientOptions& options,
                  const std::function<StepComparison()>& comparison) {
  const double limit = options.stepErrorLimit, warning = options.stepErrorWarning;
  Findings found;
  found.error = error.value();
  found.damped = error.damped();
  const bool lost = found.error > std::max(all, limit);
  const bool due = found.error > compared * limit || found.damped > damps * warning;
  if (due && !lost && limit < all) {
    auto motions = comparison();
    found.halves = motions.withHalves();
    if (found.halves && found.halves->size > limit) found.neighbour = motions.withDisturbed();
    log::info("accuracy    " + describe(found, error.span()));
  }
  const bool slow = found.isSlow(limit);
  const bool apart = found.neighbour && !found.isChaos();
  const bool tooLarge = lost || apart || slow || found.isFast(limit);
  if (!tooLarge && found.isRight(warning)) return found.reported();
  const double step = run.counters().maxStep;
  if (found.damped > warning) warnOfDamping(found, error, step);
  const bool wide = found.error > warning || (found.halves && found.halves->size > warning);
  if (!tooLarge && !wide) return found.reported();
  std::ostringstream text;
  text << "The time step (" << step << " s) is " << (tooLarge ? "too large" : "coarse") << ": "
       << describe(found, error.span()) << ". "
       << (slow && error.damping() != nullptr ? error.damping()->dampingAdvice()
                                              : run.stepAdvice());
  if (tooLarge) throw ConvergenceError(text.str());
  log::warn(text.str());
  return found.reported();
}

}  // namespace tooljoint::transient
