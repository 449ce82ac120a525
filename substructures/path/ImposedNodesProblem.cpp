// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

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

ImposedNodesProblem::ImposedNodesProblem(const PathInput& input, std::vector<int> imposed,
                                         Imposition imposition, double factor)
    : PathProblem(input, 3, straightState(input),
                  std::vector<Matrix3>(input.elements.size() + 1, Matrix3::Identity()),
                  {0, 1, 2, 5}),
      imposed_(std::move(imposed)),
      imposition_(imposition),
      factor_(factor),
      target_(Matrix::Zero(2, static_cast<int>(imposed_.size()))) {
  accept(start());
  const auto nodePoses = poses(start());
  for (std::size_t i = 0; i < imposed_.size(); ++i)
    target_.col(static_cast<int>(i)) =
        nodePoses[static_cast<std::size_t>(imposed_[i])].position.head<2>();
}

void ImposedNodesProblem::prescribe(const Matrix& target) { target_ = target; }

void ImposedNodesProblem::accept(const Vector& x) {
  moveReference(x);
  if (imposition_ != Imposition::Penalty) return;
  // 10^6 c_p with c_p the largest entry of the stiffness, equation (13)
  penalty_ = 0.0;
  Sparse k;
  jacobian(start(), k);
  double largest = 0.0;
  for (int i = 0; i < k.nonZeros(); ++i) largest = std::max(largest, std::abs(k.valuePtr()[i]));
  penalty_ = factor_ * largest;
}

Vector3 ImposedNodesProblem::position(const double* translations) const {
  return {translations[0], translations[1], translations[2]};
}

Matrix ImposedNodesProblem::positionDerivative(const double* /*translations*/) const {
  return Matrix3::Identity();
}

void ImposedNodesProblem::constrain(const Vector& state, Vector& r) const {
  for (std::size_t i = 0; i < imposed_.size(); ++i)
    for (int c = 0; c < 2; ++c) {
      const double miss = state(6 * imposed_[i] + c) - target_(c, static_cast<int>(i));
      double& row = r(unknownOf(imposed_[i], c));
      row = imposition_ == Imposition::Elimination ? miss : row + penalty_ * miss;
    }
}

void ImposedNodesProblem::constrain(Sparse& jacobian) const {
  for (const int node : imposed_)
    for (int c = 0; c < 2; ++c) {
      const int row = unknownOf(node, c);
      for (Sparse::InnerIterator entry(jacobian, row); entry; ++entry) {
        if (imposition_ == Imposition::Elimination) entry.valueRef() = 0.0;
        if (entry.col() == row)
          entry.valueRef() += imposition_ == Imposition::Elimination ? 1.0 : penalty_;
      }
    }
}

void ImposedNodesProblem::constrainScale(Vector& scale) const {
  // misses count in metres
  for (const int node : imposed_)
    for (int c = 0; c < 2; ++c)
      scale(unknownOf(node, c)) = imposition_ == Imposition::Elimination ? 1.0 : 1.0 / penalty_;
}

}  // namespace tooljoint::path
