// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/path/PathProblem.hpp"

namespace tooljoint::path {
namespace {

/// The straight string: unstretched nodes below the wellhead, no rotation.
Vector straightState(const PathInput& input) {
  Vector3 position = input.trajectory->at(0.0).position;
  Vector state = Vector::Zero(6 * (static_cast<int>(input.elements.size()) + 1));
  state.head<3>() = position;
  for (std::size_t e = 0; e < input.elements.size(); ++e) {
    position.z() += input.elements[e]->length();
    state.segment<3>(6 * (static_cast<int>(e) + 1)) = position;
  }
  return state;
}

}  // namespace

ImposedNodesProblem::ImposedNodesProblem(const PathInput& input, std::vector<int> imposed)
    : PathProblem(input, 3, straightState(input),
                  std::vector<Matrix3>(input.elements.size() + 1, Matrix3::Identity()),
                  {0, 1, 2, 5}),
      imposed_(std::move(imposed)),
      target_(Matrix::Zero(2, static_cast<int>(imposed_.size()))) {
  accept(start());
  const auto nodePoses = poses(start());
  for (std::size_t i = 0; i < imposed_.size(); ++i)
    target_.col(static_cast<int>(i)) =
        nodePoses[static_cast<std::size_t>(imposed_[i])].position.head<2>();
}

void ImposedNodesProblem::prescribe(const Matrix& target) { target_ = target; }

void ImposedNodesProblem::accept(const Vector& x) { moveReference(x); }

Vector3 ImposedNodesProblem::position(const double* translations) const {
  return {translations[0], translations[1], translations[2]};
}

Matrix ImposedNodesProblem::positionDerivative(const double* /*translations*/) const {
  return Matrix3::Identity();
}

void ImposedNodesProblem::constrain(const Vector& state, Vector& r) const {
  for (std::size_t i = 0; i < imposed_.size(); ++i)
    for (int c = 0; c < 2; ++c)
      r(unknownOf(imposed_[i], c)) = state(6 * imposed_[i] + c) - target_(c, static_cast<int>(i));
}

void ImposedNodesProblem::constrain(Sparse& jacobian) const {
  for (const int node : imposed_)
    for (int c = 0; c < 2; ++c) {
      const int row = unknownOf(node, c);
      for (Sparse::InnerIterator entry(jacobian, row); entry; ++entry)
        entry.valueRef() = entry.col() == row ? 1.0 : 0.0;
    }
}

void ImposedNodesProblem::constrainScale(Vector& scale) const {
  // position errors are measured in metres
  for (const int node : imposed_)
    for (int c = 0; c < 2; ++c) scale(unknownOf(node, c)) = 1.0;
}

}  // namespace tooljoint::path
