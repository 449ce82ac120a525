// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Which damped modes a Campbell diagram shows: the lowest ones, those nearest a frequency, or
/// those of a window of frequencies.
#pragma once

#include <complex>
#include <optional>
#include <vector>

#include "response/RotatingStates.hpp"
#include "response/campbell/Campbell.hpp"
#include "response/campbell/ModeTracker.hpp"

namespace tooljoint::response {

/// Im s > 0 beside rounding.
bool vibrates(std::complex<double> s);
/// Re s > 0 beside rounding.
bool grows(std::complex<double> s);

class ModeSearch {
 public:
  /// Both must outlive the object.
  ModeSearch(const RotatingStates& states, const CampbellSettings& settings);

  /// The modes at a speed [rad/s], with common shapes, for a tracker that follows so many: of a
  /// window all in it, a quarter of its width to both sides, and those that are damped more at the
  /// edge.
  VibratingModes at(double speed, int followed);
  /// All modes of the last call, with those that do not vibrate, and shapes of their model.
  const linalg::QuadraticModes& latest() const { return latest_; }

  /// A mode of the diagram: in a window
  ///
  ///     omega_1 <= Im s <= omega_2,  |Re s| <= (omega_2 - omega_1) / 2
  ///
  /// What is damped more has a peak that is wider than the window.
  bool shown(std::complex<double> s) const;
  /// Errors of the modes of the last call. Needs estimated().
  Eigen::VectorXcd errors(double speed) const;
  /// The modes that are shown of the full model beside those of the reduced one.
  std::vector<estimate::ModeComparison> compare(double speed) const;

 private:
  bool nearest() const { return settings_.target.has_value(); }
  /// Where modes are sought; none for the lowest ones.
  std::optional<linalg::DampedTarget> target(int count) const;
  linalg::QuadraticModes solve(const RotatingCase& rotating, double speed, int count) const;
  void markWindow(VibratingModes& modes) const;

  const RotatingStates& states_;
  const CampbellSettings& settings_;
  linalg::QuadraticModes latest_;
};

}  // namespace tooljoint::response
