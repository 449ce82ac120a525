// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drillstring/scene/SlidingRest.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "common/Index.hpp"
#include "common/Interrupt.hpp"
#include "deck/PrintedUnits.hpp"
#include "substructures/beam/NodalDofs.hpp"
#include "substructures/equilibrium/LoadPath.hpp"
#include "substructures/softstring/SoftString.hpp"

namespace tooljoint::drillstring {

using namespace beam::nodal;

namespace {

/// Number of equal increments of weight on bit and friction, so that the string reaches the nearest
/// state. Applied at once they would wind a string with a stable sinusoidal state into a helix.
constexpr int slidingSteps = 8;
/// Newton iterations within which a string that does not buckle converges.
constexpr int nearIterations = 60;
/// Largest number of repeated disturbances of a string that rests in an unstable state.
constexpr int mostDisturbances = 3;
/// Residual tolerance of the intermediate increments.
constexpr double slidingTolerance = 1e-5;
/// Largest number of sliding iterations, over Static/Max Iterations.
constexpr int slidingEffort = 6;
/// Helix that disturbs the string before each increment: amplitude over clearance, and pitch [m],
/// two to four half waves of buckling drill pipe. The motion selects the waves that grow; a helix
/// of their own length would wind a string with a stable sinusoidal state into a helix.
constexpr double helixSize = 0.05, helixPitch = 25.0;
/// Elements that resolve a half wave of a helix.
constexpr double elementsPerHalfWave = 3.0;
/// A point that has gone round the hole this often, in the direction of friction, shows that the
/// string does not come to rest. A string that winds into a helix and rests turns its points by at
/// most half of this.
constexpr double roundsWithoutRest = 3.0;
/// The angle of points closer to the axis than this fraction of the clearance is not evaluated.
constexpr double aside = 0.5;

/// Rotation of the points of a string about the hole since the first call.
class Rounds {
 public:
  explicit Rounds(const contact::ContactPoints& points)
      : points_(points), last_(points.node.size()), turned_(points.node.size(), 0.0) {}

  /// Largest number of turns of a point from x to y, or in the other direction if `sense` is
  /// negative.
  double farthest(const Vector& displacement, double sense) {
    double most = 0.0;
    for (std::size_t p = 0; p < turned_.size(); ++p) {
      const int first = perNode * (points_.node[p] - 1);
      const double x = displacement(first + u), y = displacement(first + v);
      if (std::hypot(x, y) < aside * points_.clearance[p]) continue;
      const double angle = std::atan2(y, x);
      if (last_[p]) turned_[p] += std::remainder(angle - *last_[p], constants::twoPi);
      last_[p] = angle;
      most = std::max(most, sense * turned_[p] / constants::twoPi);
    }
    return most;
  }

 private:
  const contact::ContactPoints& points_;
  std::vector<std::optional<double>> last_;
  std::vector<double> turned_;  ///< [rad]
};

}  // namespace

Vector withoutFriction(equilibrium::StaticInput input, const equilibrium::StaticOptions& options,
                       const model::NonlinearSolver& solver, const Vector& mass) {
  input.sliding = {0.0, 0.0};
  try {
    return equilibrium::solveStatic(input, options, solver).displacement;
  } catch (const ConvergenceError&) {
    equilibrium::SlideRequest request;
    request.mass = mass;
    request.tolerance = options.tolerance;
    request.mostIterations = slidingEffort * options.maxIterations;
    request.stop = [](const Vector&) { return interruptRequested(); };
    const auto slid = equilibrium::slideStatic(input, options, request, Vector::Zero(mass.size()));
    if (interruptRequested()) throw InterruptedError("Interrupted.");
    if (!slid) throw;
    return slid->displacement;
  }
}

SlidingRest::SlidingRest(const DrillString& string, const equilibrium::StaticOptions& options,
                         Vector mass, SharedProblem problem)
    : string_(string), options_(options), mass_(std::move(mass)), problem_(std::move(problem)) {}

equilibrium::SlideRequest SlidingRest::request(double share, double tolerance) const {
  equilibrium::SlideRequest request;
  request.mass = mass_;
  request.frictionScale = share;
  request.tolerance = tolerance;
  request.mostIterations = nearIterations;
  request.stop = [](const Vector&) { return interruptRequested(); };
  return request;
}

/// The static state nearest to `start`, and the negative pivots of its tangent: by Newton's method,
/// or with the viscous forces of alpha. None if it does not converge in few iterations, as for a
/// string that buckles.
std::optional<SlidingRest::Rest> SlidingRest::near(double share, const Vector& start,
                                                   double tolerance, double alpha,
                                                   int& iterations) const {
  auto asked = request(share, tolerance);
  asked.alpha = alpha;
  const auto input = problem_(share);
  auto state = equilibrium::slideStatic(input, options_, asked, start);
  iterations += state ? state->report.iterations : nearIterations;
  if (!state) return std::nullopt;
  const int pivots = equilibrium::negativePivots(input, state->displacement).value_or(0);
  return Rest{std::move(*state), pivots};
}

Vector SlidingRest::withHelix(const equilibrium::StaticInput& input,
                              const Vector& displacement) const {
  Vector x = displacement;
  const contact::ContactPoints& points = input.contact->points();
  for (std::size_t p = 0; p < points.node.size(); ++p) {
    const int node = points.node[p] - 1;
    const double angle = constants::twoPi * string_.nodes[at(node)].s / helixPitch;
    x(perNode * node + u) += helixSize * points.clearance[p] * std::cos(angle);
    x(perNode * node + v) += helixSize * points.clearance[p] * std::sin(angle);
  }
  return x;
}

/// With weight on bit and friction in equal increments, from the largest number of increments at
/// which the string does not buckle. None if it does not come to rest; `why` has the reason.
std::optional<SlidingRest::Rest> SlidingRest::slide(const Vector& start, Found& why) const {
  Vector x = start;
  int stable = 0;
  for (int parts = slidingSteps / 2; parts > 0; parts /= 2)
    if (const auto rest =
            near(double(stable + parts) / slidingSteps, x, slidingTolerance, 0.0, why.iterations);
        rest && rest->negativePivots == 0) {
      stable += parts;
      x = rest->state.displacement;
    }
  int left = slidingEffort * options_.maxIterations;
  int again = mostDisturbances;
  for (int step = stable + 1;;) {
    const double share = double(step) / slidingSteps;
    const auto input = problem_(share);
    const equilibrium::StaticProblem problem(input);
    auto asked = request(share, step < slidingSteps ? slidingTolerance : options_.tolerance);
    asked.mostIterations = left;
    Rounds rounds(input.contact->points());
    const double against = -input.sliding.rotarySpeed;  // sense of friction
    asked.stop = [&](const Vector& full) {
      why.locksUp = compressed(problem, full);
      why.driven =
          against != 0.0 && rounds.farthest(full, against > 0.0 ? 1.0 : -1.0) > roundsWithoutRest;
      return why.locksUp || why.driven || interruptRequested();
    };
    auto slid = equilibrium::slideStatic(input, options_, asked, withHelix(input, x));
    if (interruptRequested()) throw InterruptedError("Interrupted.");
    if (!slid) {
      const double atBit = input.load(input.load.size() - perNode + w);
      why.unsettled = tooLong(Vector::Constant(string_.elementCount(), atBit));
      if (!why.unsettled.empty())
        why.locksUp = why.driven = false;
      else if (why.locksUp)
        why.unsettled = "It locks up.";
      else if (why.driven)
        why.unsettled =
            "It buckles while it turns, and friction drives it round the hole: there is no state "
            "of rest.";
      else {
        const bool turns = against != 0.0;
        why.unsettled = "It buckles" + std::string(turns ? " while it turns" : "") +
                        " and does not come to rest within " +
                        std::to_string(slidingEffort * options_.maxIterations) + " iterations.";
        why.advice = turns ? "Friction may drive it round the hole; if it does not, raise "
                             "Static/Max Iterations."
                           : "Raise Static/Max Iterations.";
      }
      return std::nullopt;
    }
    why.unsettled = tooLong(slid->axialForce);
    if (!why.unsettled.empty()) return std::nullopt;
    x = slid->displacement;
    left -= slid->report.iterations;
    why.iterations += slid->report.iterations;
    if (step < slidingSteps) {
      ++step;
      continue;
    }
    const int pivots = equilibrium::negativePivots(input, x).value_or(0);
    if (pivots == 0 || again-- == 0) return Rest{std::move(*slid), pivots};
  }
}

/// A sentence if elements do not resolve the half waves pi sqrt(2 E I/F) of a helix under their
/// compression F; else empty.
std::string SlidingRest::tooLong(const Vector& axialForce) const {
  double worst = 0.0, length = 0.0, wave = 0.0;
  for (int e = 0; e < string_.elementCount(); ++e) {
    const auto& element = string_.elements[at(e)];
    if (!(axialForce(e) < 0.0)) continue;
    const auto& section = element.section();
    const double half = constants::pi * std::sqrt(2.0 * section.youngModulus() *
                                                  section.inertiaX() / -axialForce(e));
    if (element.length() / half > worst)
      worst = element.length() / half, length = element.length(), wave = half;
  }
  if (worst <= 1.0 / elementsPerHalfWave) return "";
  return "It buckles, and its elements of " + deck::printed(length, "m", 2) +
         " are too long for the half waves of a helix, " + deck::printed(wave, "m", 2) +
         ". Use three or more to a half wave.";
}

/// True if the compression of an element is so large that the string counts as locked up.
bool SlidingRest::compressed(const equilibrium::StaticProblem& problem, const Vector& x) const {
  for (int e = 0; e < string_.elementCount(); ++e)
    if (problem.elements().axialForce(e, x) <
        -softstring::lockedStrain * string_.elements[at(e)].section().axialRigidity())
      return true;
  return false;
}

SlidingRest::Found SlidingRest::from(const Vector& start) const {
  Found found;
  found.rest = near(1.0, start, options_.tolerance, 0.0, found.iterations);
  if (!found.rest)
    found.rest = near(1.0, start, options_.tolerance, equilibrium::slidingAlpha, found.iterations);
  if (found.rest && found.rest->negativePivots == 0) return found;
  auto slid = slide(start, found);
  found.buckled = slid.has_value();
  if (slid) found.rest = std::move(slid);
  if (found.locksUp) found.rest.reset();
  return found;
}

std::optional<equilibrium::StaticState> SlidingRest::withPull(
    const equilibrium::StaticState& state) const {
  const auto input = problem_(1.0);
  auto asked = request(1.0, options_.tolerance);
  asked.pull = 1.0;
  asked.mostIterations = options_.maxIterations;
  return equilibrium::slideStatic(input, options_, asked, state.displacement);
}

}  // namespace tooljoint::drillstring
