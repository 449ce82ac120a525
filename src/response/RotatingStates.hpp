// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The states at rest that a Campbell diagram is about: one for all speeds, or that of each speed.
#pragma once

#include <list>
#include <memory>
#include <utility>
#include <vector>

#include "response/RotatingCase.hpp"

namespace tooljoint::response {

/// Equations about states at rest, and shapes that the equations of all states have in common.
///
/// Of one state, common shapes are those of its model. With the state of each speed, models may
/// differ in their bases: common shapes are then rows of the recovery, with the mass R M R' of the
/// full model.
class RotatingStates {
 public:
  /// The state of the start; of each speed: that of the lowest one, which announces itself.
  /// DeckError: the state of this case is the same at all speeds. Else as RotatingCase.
  /// \param one  must outlive the object
  RotatingStates(const cases::Case& one, bool friction, bool ofEachSpeed, double lowest);

  bool ofEachSpeed() const { return ofEachSpeed_; }
  /// The equations at this speed [rad/s]. ConvergenceError names the speed. Collective.
  std::shared_ptr<const RotatingCase> about(double speed) const;
  /// The state that announced itself.
  const RotatingCase& first() const { return *first_; }

  /// Mass of the common shapes.
  Sparse mass() const;
  /// Common shapes of those of a model.
  Eigen::MatrixXcd common(const RotatingCase& rotating, const Eigen::MatrixXcd& shapes) const;
  /// The shape of a model that is nearest to a common one in the norm of the mass.
  Eigen::VectorXcd own(const RotatingCase& rotating, const Eigen::VectorXcd& shape) const;
  /// Rows of the recovery of a common shape.
  Eigen::VectorXcd recovered(const Eigen::VectorXcd& shape) const;

 private:
  /// A case at a speed, and its equations, which refer to it.
  struct State {
    double speed = 0.0;
    std::unique_ptr<cases::Case> turning;
    std::unique_ptr<RotatingCase> rotating;
  };
  std::shared_ptr<const RotatingCase> solve(double speed, bool announce) const;

  const cases::Case& case_;
  bool friction_, ofEachSpeed_;
  std::shared_ptr<const RotatingCase> first_;
  Sparse recovery_;  ///< of the first model
  Sparse mass_;      ///< of the rows of the recovery; only with the state of each speed
  mutable std::list<std::pair<double, std::shared_ptr<const RotatingCase>>> latest_;
};

}  // namespace tooljoint::response
