// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The elements of a string on its path as the figures of bending see them.
#pragma once

#include <string>
#include <vector>

#include "substructures/drillstring/DrillString.hpp"
#include "substructures/drillstring/figures/BendingFigures.hpp"
#include "substructures/path/PathState.hpp"

namespace tooljoint::drillstring {

std::vector<BendingElement> bendingElements(const DrillString& string, const path::PathState& path);

}  // namespace tooljoint::drillstring
