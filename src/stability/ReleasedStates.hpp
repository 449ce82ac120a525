// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Modes with moving states of point laws, such as the delay of a cutting bit or the integral of a
/// drive.
#pragma once

#include <optional>

#include "estimate/ModeComparison.hpp"
#include "linalg/DynamicStiffness.hpp"
#include "model/SecondOrderModel.hpp"

namespace tooljoint::stability {

/// Follows a mode from held to moving states: s and x of
///
///     (s^2 M + s C(s) + K(s)) x = 0,   C, K = (1 - a) those of held states + a those of e^{s t},
///
/// a from 0 to 1. Each s gives real matrices, whose mode gives the next s.
class ReleasedStates {
 public:
  /// \param held equations about the start at the time t with held states; must outlive this
  ReleasedStates(const model::SecondOrderModel& model, double t, const estimate::Linearised& held)
      : model_(model), t_(t), held_(held) {}

  /// Empty if s does not converge, or if the mode cannot be told from its neighbours.
  std::optional<linalg::DampedMode> operator()(linalg::DampedMode mode) const;

  /// Estimate of the change of s by the states, to first order in their part of the tangent and
  /// with the mode in place of the left mode [1/s].
  double reach(const linalg::DampedMode& mode) const;

 private:
  /// Whether both are the same mode, by the MAC with the mass.
  bool alike(const linalg::DampedMode& x, const linalg::DampedMode& y) const;
  std::optional<linalg::DampedMode> iterated(double a, linalg::DampedMode mode,
                                             double accuracy) const;

  const model::SecondOrderModel& model_;
  double t_;
  const estimate::Linearised& held_;
};

}  // namespace tooljoint::stability
