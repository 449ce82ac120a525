// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/path/PathProblem.hpp"

namespace tooljoint::path {
namespace {

/// Depth and zero rotation of every node.
Vector stateOf(const std::vector<double>& depths) {
  Vector state = Vector::Zero(4 * static_cast<int>(depths.size()));
  for (std::size_t n = 0; n < depths.size(); ++n) state(4 * static_cast<int>(n)) = depths[n];
  return state;
}

}  // namespace

CentreLineProblem::CentreLineProblem(const PathInput& input, const std::vector<double>& depths,
                                     const std::vector<Matrix3>& frames)
    : PathProblem(input, 1, stateOf(depths), frames, {0, 3}), trajectory_(input.trajectory) {}

std::vector<double> CentreLineProblem::depths(const Vector& x) const {
  const Vector state = expand(x);
  std::vector<double> out;
  for (int n = 0; n < nodes(); ++n) out.push_back(state(4 * n));
  return out;
}

Vector3 CentreLineProblem::position(const double* translations) const {
  return trajectory_->at(*translations).position;
}

Matrix CentreLineProblem::positionDerivative(const double* translations) const {
  return trajectory_->at(*translations).tangent;
}

Vector3 CentreLineProblem::positionCurvature(const double* translations) const {
  return trajectory_->at(*translations).curvature;
}

}  // namespace tooljoint::path
