// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The states at rest of a Campbell diagram: one for all speeds, or one for each speed.
#pragma once

#include <list>
#include <memory>
#include <utility>
#include <vector>

#include "response/RotatingCase.hpp"

namespace tooljoint::response {

/// Equations about states at rest, and common shapes for the equations of all states.
///
/// With one state, common shapes are those of its model. With a state for each speed, models may
/// have different bases; common shapes are then rows of the recovery, with the mass R M R' of the
/// full model.
class RotatingStates {
 public:
  /// The state at the start time. For a state of each speed that of the lowest speed; it is logged.
  /// DeckError: the state of this case is the same at all speeds. Otherwise as RotatingCase.
  /// \param one  must outlive the object
  RotatingStates(const cases::Case& one, bool friction, bool ofEachSpeed, double lowest);

  bool ofEachSpeed() const { return ofEachSpeed_; }
  /// The equations at this speed [rad/s]. ConvergenceError names the speed. Collective.
  std::shared_ptr<const RotatingCase> about(double speed) const;
  /// The logged state.
  const RotatingCase& first() const { return *first_; }

  /// Mass of the common shapes.
  Sparse mass() const;
  /// Converts shapes of a model to common shapes.
  Eigen::MatrixXcd common(const RotatingCase& rotating, const Eigen::MatrixXcd& shapes) const;
  /// The shape of a model closest to a common shape in the norm of the mass.
  Eigen::VectorXcd own(const RotatingCase& rotating, const Eigen::VectorXcd& shape) const;
  /// Rows of the recovery of a common shape.
  Eigen::VectorXcd recovered(const Eigen::VectorXcd& shape) const;

 private:
  /// A case at a speed, and its equations, which refer to the case.
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
  Sparse mass_;      ///< of the rows of the recovery; only with a state for each speed
  mutable std::list<std::pair<double, std::shared_ptr<const RotatingCase>>> latest_;
};

}  // namespace tooljoint::response
