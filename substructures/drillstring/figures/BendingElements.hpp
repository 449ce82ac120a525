// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Elements of a string on its path for the evaluation of bending.
#pragma once

#include <string>
#include <vector>

#include "cases/Case.hpp"
#include "substructures/drillstring/DrillString.hpp"
#include "substructures/drillstring/figures/BendingFigures.hpp"
#include "substructures/path/PathState.hpp"

namespace tooljoint::drillstring {

std::vector<BendingElement> bendingElements(const DrillString& string, const path::PathState& path);

/// The mean moments of the elements relative to the static state, as sums of the rotations of their
/// nodes, which are numbered from 1.
/// \param belowReleases  elements (0-based, increasing) that take the moments of the next one
std::vector<cases::BendingPlace> bendingPlaces(const DrillString& string,
                                               const path::PathState& path,
                                               const std::vector<int>& belowReleases);

}  // namespace tooljoint::drillstring
