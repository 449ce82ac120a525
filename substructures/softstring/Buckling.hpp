// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Critical loads of sinusoidal and helical buckling of a string in its hole.
#pragma once

#include "substructures/well/Trajectory.hpp"

namespace tooljoint::softstring {

/// Critical effective compressions [N].
struct BucklingLimits {
  double sinusoidal = 0.0;
  double helical = 0.0;
};

/// The smallest F with
///
///     F = 2 sqrt(E I N(F)/r),   helical: 2 sqrt(2) sqrt(E I N(F)/r)
///
/// where N(F) is the side force per length of the unbuckled string at T = -F (He and Kyllingstad,
/// SPE Drilling & Completion 10, 1995; straight: Dawson and Paslay, J. Petroleum Technology 36,
/// 1984). It is not less than in a vertical hole, 2.55 and 5.55 (E I w^2)^(1/3) (Wu and
/// Juvkam-Wold, 1992). Infinite without clearance.
/// \param weight     buoyed weight per length w [N/m]
/// \param stiffness  E I [N m2]
/// \param clearance  r, radius of the hole minus that of the body [m]
double helicalLimit(const well::WellPoint& point, double weight, double stiffness,
                    double clearance);
BucklingLimits bucklingLimits(const well::WellPoint& point, double weight, double stiffness,
                              double clearance);

/// Side force per length of a string buckled into a helix under the compression F, r F^2/(4 E I)
/// [N/m].
double helicalSideForce(double compression, double stiffness, double clearance);

}  // namespace tooljoint::softstring
