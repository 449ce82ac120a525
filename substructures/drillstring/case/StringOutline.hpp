// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The lines of `tooljoint check` for a string.
#pragma once

#include "cases/Case.hpp"
#include "substructures/drillstring/scene/Scene.hpp"

namespace tooljoint::drillstring {

cases::CaseOutline outlineOf(const Scene& scene);

}  // namespace tooljoint::drillstring
