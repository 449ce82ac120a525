// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drillstring/ContactNodes.hpp"

#include <string>

namespace tooljoint::drillstring {

contact::ContactPoints contactPoints(const contact::ContactSettings& settings,
                                     const DrillString& string, const std::vector<char>& held) {
  contact::ContactPoints points;
  for (int i = 0; i < string.nodeCount(); ++i) {
    const auto dof = static_cast<std::size_t>(6 * i);
    if (held.at(dof) != 0 && held.at(dof + 1) != 0) continue;
    const Node& node = string.nodes[static_cast<std::size_t>(i)];
    auto point = settings.pointAt(node.s, i + 1, node.clearance, node.contactRadius);
    point.muStatic *= node.frictionFactor;
    point.muDynamic *= node.frictionFactor;
    points.add(point);
  }
  return points;
}

}  // namespace tooljoint::drillstring
