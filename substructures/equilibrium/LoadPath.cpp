// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/equilibrium/LoadPath.hpp"

#include "common/Error.hpp"
#include "linalg/trilinos/EigenSolver.hpp"

namespace tooljoint::equilibrium {
namespace {

StaticSwitches switches(const StaticInput& input, bool exactJacobian) {
  StaticSwitches switches;
  switches.geometricStiffness = input.geometricStiffness;
  switches.exactJacobian = exactJacobian;
  switches.frictionScale = switches.pull = 0.0;
  return switches;
}

Sparse symmetricJacobian(const StaticProblem& tangent, const Vector& x) {
  Sparse K;
  tangent.jacobian(x, K);
  const Sparse transposed = K.transpose();
  return 0.5 * (K + transposed);
}

}  // namespace

std::optional<int> negativePivots(const StaticInput& input, const Vector& displacement) {
  StaticProblem tangent(input);
  tangent.set(switches(input, false));
  return linalg::negativeEigenvalues(symmetricJacobian(tangent, tangent.restrict(displacement)));
}

LoadPath::LoadPath(const StaticInput& input, const GrowingLoad& load)
    : problem_(input), tangent_(input), contained_(load.contained), scale_(load.scale) {
  problem_.set(switches(input, true));
  tangent_.set(switches(input, false));
  load_ = problem_.restrict(load.direction);
  weights_ = problem_.restrict(load.pathWeights);
  if (!load_.any())
    throw ModelError("The load that grows along the path acts on held dofs alone. Release them.");
}

void LoadPath::residual(const Vector& x, double p, Vector& r) const {
  problem_.residual(x, r);
  r -= (p - contained_) * load_;
}

void LoadPath::jacobian(const Vector& x, double, Sparse& J) const { problem_.jacobian(x, J); }

void LoadPath::parameterDerivative(const Vector&, double, Vector& drdp) const { drdp = -load_; }

Sparse LoadPath::symmetricTangent(const Vector& x) const { return symmetricJacobian(tangent_, x); }

std::optional<int> LoadPath::negativePivots(const Vector& x, double) const {
  // None if K is almost singular, as at the bifurcations and turning points of a path.
  return linalg::negativeEigenvalues(symmetricTangent(x));
}

}  // namespace tooljoint::equilibrium
