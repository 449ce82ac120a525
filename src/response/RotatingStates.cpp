// SPDX-License-Identifier: BSD-3-Clause
#include "response/RotatingStates.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <fmt/format.h>
#include <utility>

#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "linalg/ComplexProduct.hpp"

namespace tooljoint::response {

namespace {

using linalg::times;

/// Number of stored states: a step that is halved returns to its end.
constexpr std::size_t kept = 4;

std::unique_ptr<cases::Case> turningAt(const cases::Case& one, double speed) {
  auto turning = one.turningAt(speed);
  if (turning) return turning;
  throw DeckError(one.deck().error(
      "Campbell/Static State",
      "is \"Each Speed\", but the state at rest of this scene is the same at all speeds. Leave it "
      "out; only the state of a string with the list Rotary Speed depends on the speed."));
}

}  // namespace

RotatingStates::RotatingStates(const cases::Case& one, bool friction, bool ofEachSpeed,
                               double lowest)
    : case_(one), friction_(friction), ofEachSpeed_(ofEachSpeed) {
  if (!ofEachSpeed) {
    first_ = std::make_shared<const RotatingCase>(one, friction);
    recovery_ = first_->model().recovery;
    return;
  }
  first_ = solve(lowest, true);
  const auto& full = first_->full();
  const Sparse recovery = full.recovery;
  mass_ = recovery * first_->fullAt(lowest).mass * Sparse(recovery.transpose());
  latest_.emplace_back(lowest, first_);
}

std::shared_ptr<const RotatingCase> RotatingStates::solve(double speed, bool announce) const {
  auto state = std::make_shared<State>();
  try {
    state->turning = turningAt(case_, speed);
    state->rotating = std::make_unique<RotatingCase>(*state->turning, friction_, announce);
  } catch (const ConvergenceError& error) {
    throw ConvergenceError(fmt::format("The static state at {:.6g} rpm: {}",
                                       speed * constants::rpmPerRadianPerSecond, error.what()));
  }
  const auto* rotating = state->rotating.get();
  return {std::move(state), rotating};
}

std::shared_ptr<const RotatingCase> RotatingStates::about(double speed) const {
  if (!ofEachSpeed_) return first_;
  const auto known = std::find_if(latest_.begin(), latest_.end(),
                                  [speed](const auto& one) { return one.first == speed; });
  if (known != latest_.end()) {
    latest_.splice(latest_.begin(), latest_, known);
  } else {
    latest_.emplace_front(speed, solve(speed, false));
    if (latest_.size() > kept) latest_.pop_back();
  }
  return latest_.front().second;
}

Sparse RotatingStates::mass() const { return ofEachSpeed_ ? mass_ : first_->at(0.0).mass; }

Eigen::MatrixXcd RotatingStates::common(const RotatingCase& rotating,
                                        const Eigen::MatrixXcd& shapes) const {
  return ofEachSpeed_ ? times(rotating.model().recovery, shapes) : shapes;
}

Eigen::VectorXcd RotatingStates::own(const RotatingCase& rotating,
                                     const Eigen::VectorXcd& shape) const {
  if (!ofEachSpeed_) return shape;
  // R' M R q = R' M x
  const Sparse recovery = rotating.model().recovery;
  const Sparse weighed = Sparse(recovery.transpose()) * mass_;
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> normal(
      Eigen::SparseMatrix<double>(weighed * recovery));
  const Eigen::MatrixXcd right = times(weighed, shape);
  Eigen::VectorXcd q(recovery.cols());
  q.real() = normal.solve(Vector(right.real()));
  q.imag() = normal.solve(Vector(right.imag()));
  return q;
}

Eigen::VectorXcd RotatingStates::recovered(const Eigen::VectorXcd& shape) const {
  return ofEachSpeed_ ? shape : times(recovery_, shape);
}

}  // namespace tooljoint::response
