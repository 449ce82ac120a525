// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Makes nodes, elements and clearances from components and their order.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "substructures/drillstring/DrillString.hpp"
#include "substructures/drillstring/assembly/Components.hpp"
#include "substructures/well/Well.hpp"

namespace tooljoint::drillstring {

/// Meshes the assembly from the surface down and computes the radial clearance of every node: bore
/// radius minus outer radius, the smaller value at a change of section or bore. R_c is the radius
/// of the section with that clearance. At a gauge the clearance is bore radius minus gauge radius
/// (this reproduces the published contact count of Nguyen et al. 2020), unless a wider body begins
/// there.
///
/// Throws DeckError with one line per fault: unknown component, a component inside itself, a string
/// longer than the well, a body or gauge that does not fit into the hole, a gauge that is not at a
/// node. `assemblyWhere` is the position of the assembly in the deck. With `bit` [m], not below the
/// end of the assembly, the string hangs with its lower end at that depth and is cut at the
/// surface. The cut element is shortened; a remainder below a tenth is merged with the next
/// element.
DrillString buildDrillString(const ComponentLibrary& library,
                             const std::vector<AssemblyEntry>& assembly, const well::Well& well,
                             const std::string& assemblyWhere = "Assembly",
                             std::optional<double> bit = std::nullopt);

}  // namespace tooljoint::drillstring
