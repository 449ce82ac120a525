// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// `Substructures/Rule` "By cost": what of the cut is left to the predicted cost of a step. Parts
/// of other lengths are compared where their modes end at one frequency or by one tolerance: with a
/// number of modes longer parts would cost less because they are less accurate.
#pragma once

#include <vector>

#include "cases/Case.hpp"
#include "cases/CaseLists.hpp"
#include "substructures/drillstring/scene/Scene.hpp"

namespace tooljoint::drillstring {

/// What such a scene must have, and lists that name parts, which are not known before.
void checkCutByCost(const Scene& scene, cases::Faults& faults);

/// Lengths [m] that are tried: about one component, two, four, ... up to half of the string.
std::vector<double> lengthsOfParts(const DrillString& drillString);

/// The choices of Case::openChoices(); none with other rules.
std::vector<std::vector<cases::Overrides>> cutsByCost(const Scene& scene);

}  // namespace tooljoint::drillstring
