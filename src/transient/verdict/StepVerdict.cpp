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

/// The motion is compared from this part of `Step Error Limit` on, and from this part of `Step
/// Error Warning` that the scheme damps: what it holds down from the start has little to lose.
constexpr double comparedError = 0.5, comparedDamping = 0.2;
/// S from which a run is lost, unless all of its motion is compared and D within this part of
/// `Step Error Limit`: steps of first order miss twice D.
constexpr double lostMotion = 1, savedError = 0.5;
/// Sensitivity over D from which the motion is chaotic.
constexpr double chaoticShare = 0.25;
/// Speeds, and velocities, may be off by so many times what displacements may.
constexpr double speedTolerance = 2.5, velocityTolerance = 4;
/// V from which velocities are others, and the part of `Step Error Warning` up to which
/// displacements are right all the same: 2 % at its default.
constexpr double lostVelocities = 0.8, nearlyRight = 0.4;

/// What is known of the steps of a run, or of its busiest span alone.
struct Findings {
  double limit = 0, warning = 0;  ///< of the deck
  bool late = false;              ///< of the busiest span
  double begin = 0, span = 0;     ///< of what is compared [s]
  double error = 0;               ///< S, of the run
  double damped = 0;              ///< part of the amplitude that the scheme takes
  bool rests = false;             ///< contact, on walls too stiff for the step
  double shorterStep = 0;         ///< [s]
  std::optional<StepComparison::Difference> shorter;
  std::optional<StepComparison::Difference> neighbour;  ///< of the shorter steps

  /// Speed over that of the shorter steps, and of their neighbour where it is known: both motions
  /// are as good, and of chaotic motion the mean of two says more.
  double speeds() const {
    return neighbour ? farthest(shorter->ratios * neighbour->ratios.sqrt()) : shorter->speeds;
  }
  /// max(r, 1/r) - 1
  double speedError() const { return std::exp(std::abs(std::log(speeds()))) - 1; }
  /// Velocities that are not those at all, of motion that has a share in the displacements.
  bool isOther() const {
    return shorter->size > nearlyRight * warning && shorter->velocities > lostVelocities;
  }
  /// S is as large as the motion, and the motion not found right enough in all its length.
  bool isLost() const {
    return error > std::max(lostMotion, limit) &&
           !(shorter && shorter->whole && shorter->size <= savedError * limit);
  }
  /// Of what parts by more than a bound, neighbours part as far as steps and shorter steps do.
  bool partsLikeNeighbours(double bound) const {
    return neighbour &&
           (shorter->sizes <= bound || neighbour->sizes > chaoticShare * shorter->sizes).all();
  }
  /// In the busiest span neighbours part as far as all that is not right: so short a span has no
  /// means either.
  bool isParting() const {
    return late && partsLikeNeighbours(warning) &&
           (shorter->velocities <= velocityTolerance * warning ||
            neighbour->velocities > chaoticShare * shorter->velocities);
  }
  /// By the damping of the scheme, and by nothing else that is known.
  bool isHeldDown() const {
    return shorter && isOther() && speeds() * (1 + speedTolerance * limit) < 1 && !isParting() &&
           !isLost() && !rests;
  }
  /// Contact that neither the steps nor what they are compared with resolve.
  bool isUnknown() const { return rests && shorterStep > 0 && (!shorter || shorter->unresolved); }
  /// The step error. S where nothing is compared, which refuses nothing below 1. Else the largest
  /// of D, which refuses nothing where neighbours part as far; of the speeds, where the motion is
  /// another; and of V where it is above the warning, which refuses nothing either: vibration too
  /// fast for the step has little of the displacement.
  double stepError() const {
    if (isLost()) return error;
    if (!shorter) return std::min(error, limit);
    if (isParting()) return 0.0;
    double found = partsLikeNeighbours(limit) ? std::min(shorter->size, limit) : shorter->size;
    if (isOther()) found = std::max(found, std::min(lostMotion, speedError() / speedTolerance));
    const double fast = shorter->velocities / velocityTolerance;
    return fast > warning ? std::max(found, std::min(fast, limit)) : found;
  }
  /// Whether the motion from the start is to be compared.
  bool isDue() const {
    return error > comparedError * limit || damped > comparedDamping * warning || rests;
  }
  bool isTooLarge() const { return stepError() > limit; }
  bool isWide() const { return stepError() > warning || isUnknown(); }
  /// D is right where S is not: halves may miss what the steps miss.
  bool isDoubtful() const {
    return !late && shorterStep > 0 && error > limit && shorter && shorter->size <= warning;
  }
  bool isRight() const { return shorter && !isWide() && speedError() <= warning; }
  /// What the summary holds: 0 where a step error within the warning is not known to be all.
  double reported() const { return isUnknown() && !(stepError() > warning) ? 0.0 : stepError(); }
  /// Whether neighbours have to be evaluated.
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

/// Beside steps short enough for contact that rests on walls.
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
  found.shorter.reset();  // nothing moves that could be compared
  found.rests = false;
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
