// SPDX-License-Identifier: BSD-3-Clause
#include "transient/verdict/StepVerdict.hpp"

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
constexpr double comparedError = 0.5, comparedDamping = 0.2;
/// Step error as large as the motion, which no comparison saves.
constexpr double lostMotion = 1;
/// Sensitivity over D from which the motion is chaotic.
constexpr double chaoticShare = 0.25;
/// Times `Step Error Limit` by which speeds may be larger or smaller: by half at its default.
constexpr double speedTolerance = 2.5;

/// Times `Step Error Warning` by which velocities may differ: vibration that is too fast for the
/// step has little of the displacement.
constexpr double velocityTolerance = 4;

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
  double error = 0;        ///< S
  double damped = 0;       ///< part of the amplitude that the scheme takes
  bool rests = false;      ///< contact, on walls too stiff for the step
  double shorterStep = 0;  ///< [s]
  std::optional<StepComparison::Difference> shorter;
  std::optional<StepComparison::Difference> neighbour;  ///< of the shorter steps

  /// Means that are far from those of the shorter steps.
  bool isSlow(double limit) const {
    return shorter && shorter->speeds * (1 + speedTolerance * limit) < 1;
  }
  bool isFast(double limit) const {
    return shorter && shorter->speeds > 1 + speedTolerance * limit;
  }
  /// Neighbours part as far as steps and shorter steps do.
  bool isChaos() const { return neighbour && neighbour->size > chaoticShare * shorter->size; }
  bool isRight(double warning) const {
    return shorter && !isUnknown() && shorter->size <= warning &&
           std::abs(shorter->speeds - 1) <= warning &&
           shorter->velocities <= velocityTolerance * warning;
  }
  /// Contact that neither the steps nor what they are compared with resolve.
  bool isUnknown() const { return rests && shorterStep > 0 && (!shorter || shorter->unresolved); }
  /// The step error: D where the comparison finds the motion right, else the larger of S and D.
  double stepError(double warning) const {
    if (!shorter) return error;
    return isRight(warning) ? shorter->size : std::max(error, shorter->size);
  }
  bool isWide(double warning) const { return stepError(warning) > warning || isUnknown(); }
  /// What the summary holds: 0 where a step error within the warning is not known to be all.
  double reported(double warning) const {
    return isUnknown() && stepError(warning) <= warning ? 0.0 : stepError(warning);
  }
  bool isTooLarge(double limit) const {
    return isSlow(limit) || isFast(limit) || (neighbour && !isChaos());
  }
};

std::string describe(const Findings& found, double span, double warning) {
  std::ostringstream text;
  text << "step error " << (found.isUnknown() ? "at least " : "")
       << percent(found.stepError(warning));
  if (found.shorter)
    text << std::setprecision(2) << ": estimated " << percent(found.error) << "; in its first "
         << span << " s the motion differs by " << percent(found.shorter->size)
         << ", and its velocities by " << percent(found.shorter->velocities)
         << ", from that in steps of " << found.shorterStep << " s without numerical damping, at "
         << percent(found.shorter->speeds) << " of its speed";
  if (found.neighbour)
    text << ", and a disturbance of 0.1 % changes that by " << percent(found.neighbour->size);
  if (found.isUnknown())
    text << "; points rest on walls, or laws, too stiff for the step, and steps of "
         << found.shorterStep << " s "
         << (found.shorter ? "do not resolve it either" : "led to no motion to compare with");
  return text.str();
}

/// Beside steps short enough for contact that rests on walls.
void compare(StepComparison motions, double limit, Findings& found) {
  do {
    found.shorterStep = motions.shorterStep();
    found.shorter = motions.withShorter();
    found.neighbour.reset();
    if (found.shorter && found.shorter->size > limit) found.neighbour = motions.withDisturbed();
  } while (found.shorter && found.shorter->unresolved && !found.isTooLarge(limit) &&
           motions.shorten());
}

void warnOfDamping(const Findings& found, const StepError& error, double step) {
  std::ostringstream text;
  text << "The scheme damps vibration: steps of " << step << " s take " << percent(found.damped)
       << " of its amplitude in " << error.span() << " s. What friction makes grow may stay small. "
       << error.damping().scheme()->dampingAdvice();
  log::warn(text.str());
}

}  // namespace

double judgeSteps(const Integrator& run, const StepError& error, const TransientOptions& options,
                  const std::function<StepComparison()>& comparison) {
  const double limit = options.stepErrorLimit, warning = options.stepErrorWarning;
  Findings found;
  found.error = error.value();
  found.damped = error.damped();
  const bool lost = found.error > std::max(lostMotion, limit);
  found.rests = error.damping().hasUnresolvedContact();
  const bool due = found.error > comparedError * limit ||
                   found.damped > comparedDamping * warning || found.rests;
  if (due && !lost && limit < lostMotion) {
    compare(comparison(), limit, found);
    log::info("accuracy    " + describe(found, error.span(), warning));
  }
  const bool tooLarge = lost || found.isTooLarge(limit);
  if (!tooLarge && found.isRight(warning)) return found.reported(warning);
  const double step = run.equalStep();
  if (found.damped > warning) warnOfDamping(found, error, step);
  if (!tooLarge && !found.isWide(warning)) return found.reported(warning);
  std::ostringstream text;
  text << "The time step (" << step << " s) is " << (tooLarge ? "too large" : "coarse") << ": "
       << describe(found, error.span(), warning) << ". "
       << (found.isSlow(limit) && !found.rests && error.damping().scheme() != nullptr
               ? error.damping().scheme()->dampingAdvice()
               : run.stepAdvice());
  if (tooLarge) throw ConvergenceError(text.str());
  log::warn(text.str());
  return found.reported(warning);
}

}  // namespace tooljoint::transient
