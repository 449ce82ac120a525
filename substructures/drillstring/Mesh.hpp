// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// From components and their order to nodes, elements and clearances.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "substructures/drillstring/DrillString.hpp"
#include "substructures/drillstring/assembly/Components.hpp"
#include "substructures/well/Well.hpp"

namespace tooljoint::drillstring {

/// Meshes the assembly from the surface down and finds the radial clearance of every node: bore
/// radius minus outer radius, the smaller one where the section or the bore changes, with R_c the
/// radius of the section whose clearance counts; at a gauge bore radius minus gauge radius (this
/// reproduces the published contact count of Nguyen et al. 2020), unless a wider body begins there.
///
/// Throws DeckError with one line per fault: unknown component, a component inside itself, a string
/// longer than the well, a body or gauge that does not fit into the hole, a gauge that is not at a
/// node. `assemblyWhere` says where the assembly stands. With `bit` [m], not below the end of the
/// assembly, the string hangs with its lower end at that depth, cut at the surface: the element
/// that is cut is shortened, and one of which less than a tenth is left goes to its neighbour.
DrillString buildDrillString(const ComponentLibrary& library,
                             const std::vector<AssemblyEntry>& assembly, const well::Well& well,
                             const std::string& assemblyWhere = "Assembly",
                             std::optional<double> bit = std::nullopt);

}  // namespace tooljoint::drillstring
