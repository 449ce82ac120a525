// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Modes whose states of point laws follow them: the delay of a cutting bit, the integral of a
/// drive.
#pragma once

#include <optional>

#include "estimate/ModeComparison.hpp"
#include "linalg/DynamicStiffness.hpp"
#include "model/SecondOrderModel.hpp"

namespace tooljoint::stability {

/// What a mode of held states becomes when they follow it: s and x of
///
///     (s^2 M + s C(s) + K(s)) x = 0,   C, K = (1 - a) those of held states + a those of e^{s t},
///
/// a from 0 to 1. Each s gives real matrices, whose mode is the next s.
class ReleasedStates {
 public:
  /// \param held  the equations about the start at the time t with held states; must outlive this
  ReleasedStates(const model::SecondOrderModel& model, double t, const estimate::Linearised& held)
      : model_(model), t_(t), held_(held) {}

  /// Nothing where s does not settle, or where the mode cannot be told from its neighbours.
  std::optional<linalg::DampedMode> operator()(linalg::DampedMode mode) const;

  /// How far the states may move s, to first order in what they add to the tangent and with the
  /// mode in place of the left one [1/s].
  double reach(const linalg::DampedMode& mode) const;

 private:
  /// The same mode, by the MAC with the mass.
  bool alike(const linalg::DampedMode& x, const linalg::DampedMode& y) const;
  std::optional<linalg::DampedMode> iterated(double a, linalg::DampedMode mode,
                                             double accuracy) const;

  const model::SecondOrderModel& model_;
  double t_;
  const estimate::Linearised& held_;
};

}  // namespace tooljoint::stability
