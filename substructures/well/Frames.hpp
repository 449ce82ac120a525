// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Local frames along a well: z is the tangent, x and y do not spin about it.
#pragma once

#include <vector>

#include "common/Types.hpp"
#include "substructures/well/Trajectory.hpp"

namespace tooljoint::well {

/// The smallest rotation that turns one unit vector into another. Throws ModelError when they are
/// opposite.
Matrix3 smallestRotation(const Vector3& from, const Vector3& to);

/// Unit vector across a hole towards its high side: away from gravity (+Z). A vertical hole
/// (inclination below 1e-6 rad) has no high side; the vector then points north (+X), which is the
/// limit for a hole of azimuth 0.
Vector3 highSide(const Vector3& tangent);

/// Rotation-minimising (Bishop) frames at the depths s [m], non-decreasing: matrices with columns
/// x, y, z, where z is the tangent. At the surface x and y are global X and Y carried by the
/// smallest rotation from Z to the tangent; from there they are transported without spin (double
/// reflection, Wang et al., ACM Trans. Graph. 27, 2008). Fine substeps that end at curvature jumps
/// keep the angle accurate to 1e-10 rad. Throws ModelError when depths decrease or the well starts
/// straight upwards.
std::vector<Matrix3> bishopFrames(const Trajectory& trajectory, const std::vector<double>& s);

}  // namespace tooljoint::well
