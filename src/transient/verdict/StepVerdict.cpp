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
#include "common/report/Percent.hpp"

namespace tooljoint::transient {
namespace {

/// The motion is compared if S exceeds this part of `Step Error Limit`, or the damping of the
/// scheme this part of `Step Error Warning`: vibration damped from the start has little amplitude
/// to lose.
constexpr double comparedError = 0.5, comparedDamping = 0.2;
/// A run is refused if S is above this, unless all of its motion is compared and D is within this
/// part of `Step Error Limit`: D is half of a first-order error.
constexpr double lostMotion = 1, savedError = 0.5;
/// Sensitivity over D above which the motion is chaotic.
constexpr double chaoticShare = 0.25;
/// Allowed errors of speeds and of velocities, as multiples of that of displacements.
constexpr double speedTolerance = 2.5, velocityTolerance = 4;
/// V above which the velocities are uncorrelated; part of `Step Error Warning` up to which the
/// displacements are right nevertheless: 2 % at its default.
constexpr double lostVelocities = 0.8, nearlyRight = 0.4;

/// Findings on the steps of a run, or on its busiest span alone.
struct Findings {
  double limit = 0, warning = 0;  ///< of the deck
  bool late = false;              ///< findings on the busiest span
  double begin = 0, span = 0;     ///< of the compared motion [s]
  double error = 0;               ///< S of the run
  double damped = 0;              ///< fraction of the amplitude that the scheme damps
  bool rests = false;             ///< contact rests on walls too stiff for the step
  double shorterStep = 0;         ///< [s]
  std::optional<StepComparison::Difference> shorter;
  std::optional<StepComparison::Difference> neighbour;  ///< of the shorter steps

  /// Speed over that of the shorter steps, and over that of their neighbour if known: both motions
  /// are equally valid, and in chaotic motion a mean of two is more accurate.
  double speeds() const {
    return neighbour ? farthest(shorter->ratios * neighbour->ratios.sqrt()) : shorter->speeds;
  }
  /// max(r, 1/r) - 1
  double speedError() const { return std::exp(std::abs(std::log(speeds()))) - 1; }
  /// Whether the velocities are uncorrelated and their motion is a relevant part of the
  /// displacements.
  bool isOther() const {
    return shorter->size > nearlyRight * warning && shorter->velocities > lostVelocities;
  }
  /// Whether S is as large as the motion and no comparison over all of the motion disproves it.
  bool isLost() const {
    return error > std::max(lostMotion, limit) &&
           !(shorter && shorter->whole && shorter->size <= savedError * limit);
  }
  /// Whether neighbours differ as much as steps and shorter steps in all norms above the bound.
  bool partsLikeNeighbours(double bound) const {
    return neighbour &&
           (shorter->sizes <= bound || neighbour->sizes > chaoticShare * shorter->sizes).all();
  }
  /// Whether neighbours in the busiest span differ as much in everything that is not right. Such a
  /// short span has no meaningful averages either.
  bool isParting() const {
    return late && partsLikeNeighbours(warning) &&
           (shorter->velocities <= velocityTolerance * warning ||
            neighbour->velocities > chaoticShare * shorter->velocities);
  }
  /// Whether the damping of the scheme, and no other known effect, suppresses the motion.
  bool isHeldDown() const {
    return shorter && isOther() && speeds() * (1 + speedTolerance * limit) < 1 && !isParting() &&
           !isLost() && !rests;
  }
  /// Contact that neither the steps nor the shorter steps resolve.
  bool isUnknown() const { return rests && shorterStep > 0 && (!shorter || shorter->unresolved); }
  /// The step error. Without a comparison it is S, at most the limit. Else it is the largest of
  /// three: D, at most the limit if neighbours differ as much; the error of the speeds, if the
  /// velocities are uncorrelated; V scaled, at most the limit, if it is above the warning, because
  /// vibration too fast for the step is a small part of the displacement.
  double stepError() const {
    if (isLost()) return error;
    if (!shorter) return std::min(error, limit);
    if (isParting()) return 0.0;
    double found = partsLikeNeighbours(limit) ? std::min(shorter->size, limit) : shorter->size;
    if (isOther()) found = std::max(found, std::min(lostMotion, speedError() / speedTolerance));
    const double fast = shorter->velocities / velocityTolerance;
    return fast > warning ? std::max(found, std::min(fast, limit)) : found;
  }
  /// Whether the motion from the start must be compared.
  bool isDue() const {
    return error > comparedError * limit || damped > comparedDamping * warning || rests;
  }
  bool isTooLarge() const { return stepError() > limit; }
  bool isWide() const { return stepError() > warning || isUnknown(); }
  /// S is large but D is right: halves may miss what the steps miss.
  bool isDoubtful() const {
    return !late && shorterStep > 0 && error > limit && shorter && shorter->size <= warning;
  }
  bool isRight() const { return shorter && !isWide() && speedError() <= warning; }
  /// Value in the summary: 0 if the step error is within the warning but may be incomplete.
  double reported() const { return isUnknown() && !(stepError() > warning) ? 0.0 : stepError(); }
  /// Whether neighbours must be evaluated.
  bool isInDoubt() const { return shorter && !isLost() && (isTooLarge() || (late && !isRight())); }
};

std::string describe(const Findings& found) {
  std::ostringstream text;
  if (found.isParting())
    text << "later motion parts from its neighbours, which says nothing of the step";
  else
    text << "step error " << (found.isUnknown() ? "at least " : "") << percent(found.stepError());
  if (found.shorter)
    text << std::setprecision(2)
         << (found.late ? std::string(": in the ")
                        : ": estimated " + percent(found.error) + "; in the ")
         << found.span << " s from t = " << found.begin << " s the motion differs by "
         << percent(found.shorter->size) << ", and its velocities by "
         << percent(found.shorter->velocities) << ", from that in steps of " << found.shorterStep
         << " s without numerical damping, at " << percent(found.shorter->speeds)
         << " of its speed";
  if (found.neighbour)
    text << ", and a disturbance of 0.1 % changes that by " << percent(found.neighbour->size)
         << ", its speed by " << percent(std::abs(1 / found.neighbour->speeds - 1));
  if (found.isUnknown())
    text << "; points rest on walls, or laws, too stiff for the step, and steps of "
         << found.shorterStep << " s "
         << (found.shorter ? "do not resolve it either" : "led to no motion to compare with");
  return text.str();
}

/// Compares with steps short enough for contact that rests on walls.
void compare(StepComparison motions, Findings& found) {
  bool confirm = false, confirmed = false;
  do {
    found.shorterStep = motions.shorterStep();
    found.shorter = motions.withShorter();
    found.neighbour.reset();
    if (found.isInDoubt()) found.neighbour = motions.withDisturbed();
    confirm = !confirmed && found.isDoubtful();
    confirmed = confirmed || confirm;
  } while (found.shorter && (confirm || found.shorter->unresolved) && !found.isTooLarge() &&
           motions.shorten());
  if (!found.shorter || !found.shorter->still || found.shorter->unresolved) return;
  found.shorter.reset();  // no motion to compare
  found.rests = false;
}

void warnOfDamping(const Findings& found, const StepError& error, double step) {
  std::ostringstream text;
  text << "The scheme damps vibration: steps of " << step << " s take " << percent(found.damped)
       << " of its amplitude in " << error.span() << " s. Growth caused by friction may be hidden. "
       << error.damping().scheme()->dampingAdvice();
  log::warn(text.str());
}

}  // namespace

double judgeSteps(const Integrator& run, const StepError& error, const TransientOptions& options,
                  const Comparison& comparison) {
  Findings found;
  found.limit = options.stepErrorLimit;
  found.warning = options.stepErrorWarning;
  found.rests = error.damping().hasUnresolvedContact();
  found.damped = error.damped();
  Findings later = found;
  found.begin = error.beginning().t;
  found.span = error.span();
  found.error = error.value();
  const bool compared = found.limit < lostMotion;
  if (compared && found.isDue()) {
    compare(comparison(error.beginning(), found.span), found);
    log::info("accuracy    " + describe(found));
  }
  const BusiestSpan* busiest = error.later();
  if (compared && busiest != nullptr && !found.isTooLarge()) {
    later.late = true;
    later.begin = busiest->start().t;
    later.span = busiest->length();
    compare(comparison(busiest->start(), later.span), later);
    if (later.shorter) log::info("accuracy    " + describe(later));
    if (later.isTooLarge() || later.stepError() > found.stepError()) found = later;
  }
  const bool tooLarge = found.isTooLarge();
  if (!tooLarge && found.isRight()) return found.reported();
  const double step = run.equalStep();
  if (found.damped > found.warning) warnOfDamping(found, error, step);
  if (!tooLarge && !found.isWide()) return found.reported();
  std::ostringstream text;
  text << "The time step (" << step << " s) is " << (tooLarge ? "too large" : "coarse") << ": "
       << describe(found) << ". "
       << (found.isHeldDown() && error.damping().scheme() != nullptr
               ? error.damping().scheme()->dampingAdvice()
               : run.stepAdvice());
  if (tooLarge) throw ConvergenceError(text.str());
  log::warn(text.str());
  return found.reported();
}

}  // namespace tooljoint::transient
