// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The string of a scene with its bit at another depth.
#pragma once

#include "substructures/drillstring/scene/Scene.hpp"

namespace tooljoint::drillstring {

/// The lower part of the string with the bit at the depth `bit` [m]. Only hook and rotary table
/// hold it along and about its axis, and only its weight (in the mud) acts. Lateral supports move
/// with their nodes. Bit law and top drive are omitted. DeckError if it does not fit into the hole
/// there. Collective.
Scene hungAt(const Scene& scene, double bit);

}  // namespace tooljoint::drillstring
