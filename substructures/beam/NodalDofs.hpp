// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The six dofs of a node of the string by name, in the order of every vector and matrix. Header
/// only.
#pragma once

namespace tooljoint::beam::nodal {

/// Displacements [m] and rotations [rad] in the frame of the node, z along the string.
constexpr int u = 0, v = 1, w = 2, thetaX = 3, thetaY = 4, thetaZ = 5;
constexpr int perNode = 6;

}  // namespace tooljoint::beam::nodal
