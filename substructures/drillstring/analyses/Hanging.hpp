// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The string of a scene with its bit at another depth.
#pragma once

#include "substructures/drillstring/scene/Scene.hpp"

namespace tooljoint::drillstring {

/// The lower part of the string with the bit at the depth `bit` [m], held along and about its axis
/// by hook and rotary table alone, under its weight (in the mud) alone; supports across the string
/// go with their nodes. Bit law and top drive are left out. DeckError where it does not fit into
/// the hole there. Collective.
Scene hungAt(const Scene& scene, double bit);

}  // namespace tooljoint::drillstring
