// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drillstring/DrillString.hpp"

namespace tooljoint::drillstring {

std::vector<std::shared_ptr<const beam::Element>> DrillString::formulations() const {
  std::vector<std::shared_ptr<const beam::Element>> chain;
  chain.reserve(elements.size());
  for (const Element& element : elements) chain.push_back(element.formulation);
  return chain;
}

std::vector<double> DrillString::depths() const {
  std::vector<double> depths;
  depths.reserve(nodes.size());
  for (const Node& node : nodes) depths.push_back(node.s);
  return depths;
}

}  // namespace tooljoint::drillstring
