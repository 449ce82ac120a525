// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Point laws on dofs whose motion contains the forces between parts (Dual Craig-Bampton).
#pragma once

#include <string>
#include <vector>

#include "coupling/assembly/LabelAssembly.hpp"

namespace tooljoint::coupling {

/// Such a dof moves by
///
///     u = Phi_b p + G (C' lambda + f),
///
/// G the residual flexibility, but the force f of a law finds no coordinate for its own part G f:
/// the law sees u without it. A spring k acts as k/(1 - k G), and a damper c adds a mode that grows
/// at 1/(c G).
///
/// ModelError where that makes a connector wrong at rest: k G above a hundredth, or a damper. Of
/// all other laws on such dofs a remark; "" without.
/// \param connectors  so many of the last point sets of the labelled model are connectors
std::string checkLawsOnForces(const std::vector<AlignedPart>& alignedParts,
                              const Labelled& labelled, std::size_t connectors);

}  // namespace tooljoint::coupling
