// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/equilibrium/Settling.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/Error.hpp"
#include "common/Text.hpp"
#include "linalg/trilinos/DirectSolver.hpp"

namespace tooljoint::equilibrium {
namespace {

/// Displacement along the mode, as a fraction of the first clearance it closes.
constexpr double firstDisplacement = 0.1;
/// alpha over growthRate^2 during the motion: the tangent is at least three times as positive as it
/// was negative.
constexpr double convexity = 4.0;
/// alpha at the end over its first value. It determines the convergence of the last steps, and
/// prevents motions without resistance (a rotation about the axis of a vertical bore).
constexpr double finalShare = 1e-6;
/// Largest lateral step of a string at rest, as a fraction of the smallest clearance.
constexpr double atRest = 1e-4;
constexpr int mostSteps = 2000, mostFinalSteps = 50, mostIterations = 60;
/// Tolerance of the intermediate steps.
constexpr double stepTolerance = 1e-6;

/// Largest lateral step of slideToRest, as a fraction of the clearance: alpha grows beyond it. It
/// is halved, down to the second number, when the string hardly moves and does not come to rest.
constexpr double slidingReach = 0.25, leastReach = 0.06;
/// A string with this alpha [1/s2] hardly moves: it is far below the square of the growth rates of
/// buckling drill pipe (1 to 5 1/s). The search restarts after `patience` steps with it.
constexpr double hardlyMoving = 0.1;
constexpr int patience = 15;

/// r(x) + alpha W (x - x_n).
class ProximalProblem : public model::InUnknownsOf<model::ChainProblem> {
 public:
  ProximalProblem(const StaticProblem& problem, Vector weights)
      : InUnknownsOf(problem), problem_(problem), weights_(std::move(weights)) {}
  void set(double alpha, const Vector& from) { alpha_ = alpha, from_ = from; }

  void residual(const Vector& x, Vector& r) const override {
    problem_.residual(x, r);
    addInertia(x, r);
  }
  void jacobian(const Vector& x, Sparse& J) const override {
    problem_.jacobian(x, J);
    addInertia({0, size()}, J);
  }
  std::vector<int> firstOfNodes() const override { return problem_.firstOfNodes(); }
  void residualRows(const Vector& x, RowRange rows, Vector& r) const override {
    problem_.residualRows(x, rows, r);
    addInertia(x, r);
  }
  void jacobianRows(const Vector& x, RowRange rows, Sparse& J) const override {
    problem_.jacobianRows(x, rows, J);
    addInertia(rows, J);
  }

 private:
  void addInertia(const Vector& x, Vector& r) const {
    r += alpha_ * weights_.cwiseProduct(x - from_);
  }
  void addInertia(RowRange rows, Sparse& J) const {
    for (int i = rows.begin; i < rows.end; ++i) J.coeffRef(i, i) += alpha_ * weights_[i];
  }

  const StaticProblem& problem_;
  Vector weights_, from_;
  double alpha_ = 0.0;
};

/// The residual alternates between few values: the same contacts open and close in turn.
bool alternates(const std::vector<double>& residuals) {
  constexpr std::size_t period = 8;
  constexpr double same = 0.01, other = 0.05;
  const auto differs = [&](std::size_t back, double share) {
    const double now = residuals.back(), then = residuals[residuals.size() - 1 - back];
    return std::abs(now - then) >= share * now;
  };
  if (residuals.size() < 3 || !differs(1, other)) return false;
  for (std::size_t back = 2; back <= period && back < residuals.size(); ++back)
    if (!differs(back, same)) return true;
  return false;
}

/// Largest lateral displacement of a contact point over its clearance. Points held on the axis do
/// not count.
double reach(const StaticInput& input, const Vector& full) {
  double largest = 0.0;
  if (input.contact == nullptr) return largest;
  const auto& points = input.contact->points();
  for (std::size_t p = 0; p < points.node.size(); ++p) {
    const int dof = 6 * (points.node[p] - 1);
    const double moved = std::hypot(full(dof), full(dof + 1));
    if (points.clearance[p] > 0.0) largest = std::max(largest, moved / points.clearance[p]);
  }
  return largest;
}

double scaledResidual(const StaticProblem& problem, const Vector& x) {
  Vector r;
  problem.residual(x, r);
  return problem.residualScale().cwiseProduct(r).cwiseAbs().maxCoeff();
}

}  // namespace

SettlingReport settle(const StaticInput& input, StaticProblem& problem, const UnstableMode& mode,
                      double tolerance, const model::NonlinearSolver& solve, Vector& x) {
  auto switches = problem.switches();
  switches.frictionScale = switches.pull = 0.0;
  problem.set(switches);
  const double size = mode.shape.cwiseAbs().maxCoeff();
  const double width = reach(input, mode.shape / size);
  if (!(width > 0.0))
    throw ConvergenceError(
        "The unstable mode of the static state does not reach a wall, so no stable state can be "
        "found by Static/Unstable State \"Perturb\". Reduce the loads, or give the string a "
        "Contact list.");
  x += problem.restrict(mode.shape) * (firstDisplacement / (width * size));

  ProximalProblem proximal(problem, problem.restrict(mode.mass));
  const double first = convexity * mode.growthRate * mode.growthRate;
  double alpha = first;
  SettlingReport report;
  model::SolveRequest request;
  request.what = "the static equilibrium after the unstable mode";
  request.maxIterations = mostIterations;
  request.search = model::LineSearch::Work;
  bool resting = false;
  for (int step = 0, final = 0; step < mostSteps && final < mostFinalSteps; ++step) {
    proximal.set(alpha, x);
    request.tolerance = resting ? tolerance : stepTolerance;
    Vector next = x;
    const auto outcome = solve(proximal, next, request);
    report.iterations += outcome.iterations;
    if (!outcome.converged || !next.allFinite()) {
      if (alpha > first / finalShare) break;
      alpha *= convexity;
      resting = false;
      continue;
    }
    const double moved = reach(input, problem.expand(next - x));
    x = next;
    report.residual = scaledResidual(problem, x);
    if (resting && report.residual <= tolerance) return report;
    if (resting) ++final;
    resting = resting || moved < atRest;
    alpha =
        resting ? std::max(finalShare * first, 0.1 * alpha) : std::max(first, alpha / convexity);
  }
  throw ConvergenceError(
      "The string left an unstable static state and did not come to rest on the wall: the residual "
      "is " +
      formatNumber(report.residual) + " of the largest load where " + formatNumber(tolerance) +
      " is allowed. Reduce the loads, or set Static/Unstable State to \"Warn\".");
}

Slide slideToRest(const StaticInput& input, const StaticProblem& problem, const SlideRequest& asked,
                  Vector& x) {
  const Vector mass = problem.restrict(asked.mass), scale = problem.residualScale();
  std::unique_ptr<linalg::DirectSolver> factors;
  std::vector<double> residuals;
  double alpha = asked.alpha, allowed = slidingReach;
  double lastMove = std::numeric_limits<double>::infinity();
  int quiet = 0;
  Slide slide;
  Vector r;
  Sparse tangent;
  while (problem.linearise(x, r, tangent), r.allFinite()) {
    slide.residual = scale.cwiseProduct(r).cwiseAbs().maxCoeff();
    slide.rests = slide.residual <= asked.tolerance;
    if (slide.rests || slide.iterations >= asked.mostIterations || asked.stop(problem.expand(x)))
      break;
    residuals.push_back(slide.residual);
    for (int i = 0; i < problem.size(); ++i) tangent.coeffRef(i, i) += alpha * mass[i];
    if (factors)
      factors->refactorUnchecked(tangent);
    else
      factors = std::make_unique<linalg::DirectSolver>(
          tangent, [&problem](int i) { return problem.unknownName(i); });
    const Vector step = -factors->apply(r);
    const double length = alternates(residuals) ? 0.5 : 1.0;
    const Vector next = problem.moved(x, step, length * problem.stepLimit(x, step));
    const double move = reach(input, problem.expand(next - x));
    x = next;
    ++slide.iterations;
    if (move > allowed)
      alpha *= std::min(2.0, move / allowed);
    else if (move < lastMove)
      alpha = std::max(finalShare, 0.5 * alpha);
    lastMove = move;
    if (alpha < hardlyMoving && ++quiet > patience) {
      alpha = slidingAlpha;
      allowed = std::max(leastReach, 0.5 * allowed);
      quiet = 0;
    }
  }
  return slide;
}

}  // namespace tooljoint::equilibrium
