// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Difference of the mud pressure inside and outside the string.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "substructures/softstring/SoftString.hpp"

namespace tooljoint::softstring {

/// p_i - p_o along the string. The weight of the mud is the same inside and outside. With mean
/// velocities U of the flow, the radii R_i and R_e of the pipe and R_w of the hole,
///
///     d(p_i - p_o)/ds = -C_f rho/pi (U_i^2/R_i + U_o^2/(R_w - R_e))
///
/// from the pump pressure at the surface down, with the opposite sign for mud that flows down the
/// annulus. Without a given pump pressure the difference is zero at the bit: the pump overcomes
/// these losses and there are no nozzles.
class PressureDifference {
 public:
  PressureDifference(const std::vector<Stretch>& string, const Hole& hole, double bit,
                     std::optional<double> pumpPressure);
  /// p_i - p_o at a measured depth [m] down to the bit [Pa].
  double at(double depth) const;

 private:
  std::vector<double> depth_, loss_;  ///< losses from the surface [m, Pa]
  double atSurface_ = 0.0;
};

}  // namespace tooljoint::softstring
