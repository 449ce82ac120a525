// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Positions of the nodes of imported parts, for pictures only; the equations do not need them.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "parts/PartsParameters.hpp"
#include "parts/PartsScene.hpp"

namespace tooljoint::parts {

/// Positions of the nodes of a scene in the common frame [m], by their numbers in the scene,
/// without nodes for which the file has none. A part is turned by its `Rotation Angle` and moved
/// such that a node shared with previous parts has their position; without such a node its origin
/// is that of the frame.
std::map<std::int64_t, Vector3> nodePositions(const PartsScene& scene,
                                              const std::vector<ImportedPart>& imported);

/// Pairs of nodes coupled by the stiffness of a part, the smaller number first: the edges of its
/// mesh. Parts with more couplings per node than a grid of solids (reduced parts, for example) are
/// omitted.
std::set<std::pair<std::int64_t, std::int64_t>> nodeLinks(const PartsScene& scene);

}  // namespace tooljoint::parts
