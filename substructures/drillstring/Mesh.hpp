// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// From components and their order to nodes, elements and clearances.
#pragma once

#include <string>
#include <vector>

#include "substructures/drillstring/Components.hpp"
#include "substructures/drillstring/DrillString.hpp"
#include "substructures/well/Well.hpp"

namespace tooljoint::drillstring {

/// Meshes the assembly from the surface down and finds the radial clearance of every node: bore
/// radius minus outer radius, the smaller one where the section or the bore changes, with R_c the
/// radius of the section whose clearance counts; at a gauge bore radius minus gauge radius (this
/// reproduces the published contact count of Nguyen et al. 2020).
///
/// Throws DeckError with one line per fault: unknown component, a component inside itself, a string
/// longer than the well, a body or gauge that does not fit into the hole, a gauge that is not at a
/// node. `assemblyWhere` says where the assembly stands.
DrillString buildDrillString(const ComponentLibrary& library,
                             const std::vector<AssemblyEntry>& assembly, const well::Well& well,
                             const std::string& assemblyWhere = "Assembly");

}  // namespace tooljoint::drillstring
