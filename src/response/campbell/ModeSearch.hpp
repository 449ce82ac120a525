// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Selection of the damped modes of a Campbell diagram: the lowest ones, those nearest a frequency,
/// or those in a window of frequencies.
#pragma once

#include <complex>
#include <optional>
#include <vector>

#include "response/RotatingStates.hpp"
#include "response/campbell/Campbell.hpp"
#include "response/campbell/ModeTracker.hpp"

namespace tooljoint::response {

/// Im s > 0, apart from rounding.
bool vibrates(std::complex<double> s);
/// Re s > 0, apart from rounding.
bool grows(std::complex<double> s);

class ModeSearch {
 public:
  /// Both must outlive the object.
  ModeSearch(const RotatingStates& states, const CampbellSettings& settings);

  /// The modes at a speed [rad/s], with common shapes, for a tracker that follows `followed` modes.
  /// For a window all modes inside, and as edge modes those within a quarter of its width on both
  /// sides and those with more damping.
  VibratingModes at(double speed, int followed);
  /// All modes of the last call, including those that do not vibrate, with shapes of their model.
  const linalg::QuadraticModes& latest() const { return latest_; }

  /// True for a mode of the diagram: in a window
  ///
  ///     omega_1 <= Im s <= omega_2,  |Re s| <= (omega_2 - omega_1) / 2
  ///
  /// A mode with more damping has a peak wider than the window.
  bool shown(std::complex<double> s) const;
  /// Errors of the modes of the last call. Needs estimated().
  Eigen::VectorXcd errors(double speed) const;
  /// The shown modes of the full model and those of the reduced one.
  std::vector<estimate::ModeComparison> compare(double speed) const;

 private:
  bool nearest() const { return settings_.target.has_value(); }
  /// Target of the mode search; none for the lowest modes.
  std::optional<linalg::DampedTarget> target(int count) const;
  linalg::QuadraticModes solve(const RotatingCase& rotating, double speed, int count) const;
  void markWindow(VibratingModes& modes) const;

  const RotatingStates& states_;
  const CampbellSettings& settings_;
  linalg::QuadraticModes latest_;
};

}  // namespace tooljoint::response
