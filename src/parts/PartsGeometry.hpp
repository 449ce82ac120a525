// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Where the nodes of imported parts are, for pictures. The equations do not need it.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "parts/PartsParameters.hpp"
#include "parts/PartsScene.hpp"

namespace tooljoint::parts {

/// Positions of the nodes of a scene in the common frame [m], by their numbers in the scene; nodes
/// whose file gives none are left out. A part is turned by its `Rotation Angle` and moved so that a
/// node it shares with parts before it stands where theirs does; without such a node its origin is
/// that of the frame.
std::map<std::int64_t, Vector3> nodePositions(const PartsScene& scene,
                                              const std::vector<ImportedPart>& imported);

/// Pairs of nodes that the stiffness of a part couples, the smaller number first: the edges of its
/// mesh. Parts whose nodes are coupled with more than those beside them in a grid of solids
/// (reduced parts, for one) are left out.
std::set<std::pair<std::int64_t, std::int64_t>> nodeLinks(const PartsScene& scene);

}  // namespace tooljoint::parts
