// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Point laws on dofs whose motion contains the forces between parts (Dual Craig-Bampton).
#pragma once

#include <string>
#include <vector>

#include "coupling/assembly/LabelAssembly.hpp"

namespace tooljoint::coupling {

/// The displacement of a dof whose motion contains the forces between parts is
///
///     u = Phi_b p + G (C' lambda + f),
///
/// with the residual flexibility G. The force f of a law has no coordinate for its own contribution
/// G f, so the law is evaluated without it: a spring k acts as k/(1 - k G), and a damper c adds a
/// mode that grows at 1/(c G).
///
/// ModelError if this makes a connector wrong at rest: k G above a hundredth, or a damper. Returns
/// a remark for all other laws on such dofs; "" without. \param connectors  number of connectors,
/// the last point sets of the labelled model
std::string checkLawsOnForces(const std::vector<AlignedPart>& alignedParts,
                              const Labelled& labelled, std::size_t connectors);

}  // namespace tooljoint::coupling
