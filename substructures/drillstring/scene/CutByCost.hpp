// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// `Substructures/Rule` "By cost": choices of the partition that the predicted cost of a step
/// decides. Parts of different lengths are compared with modes up to the same frequency or
/// tolerance. With a given number of modes longer parts would cost less only because they are less
/// accurate.
#pragma once

#include <vector>

#include "cases/Case.hpp"
#include "cases/CaseLists.hpp"
#include "substructures/drillstring/scene/Scene.hpp"

namespace tooljoint::drillstring {

/// Checks such a scene. Lists that name parts are rejected, since the parts are not known
/// beforehand.
void checkCutByCost(const Scene& scene, cases::Faults& faults);

/// Trial lengths [m]: about one component, two, four, ... up to half of the string.
std::vector<double> lengthsOfParts(const DrillString& drillString);

/// The choices of Case::openChoices(); empty for other rules.
std::vector<std::vector<cases::Overrides>> cutsByCost(const Scene& scene);

}  // namespace tooljoint::drillstring
