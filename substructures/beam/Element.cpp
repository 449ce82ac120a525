// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/beam/Element.hpp"

#include <utility>

#include "deck/Deck.hpp"
#include "deck/Variants.hpp"

namespace tooljoint::beam {

CorotationalResponse Element::response(const ElementPose& pose, bool withTangent) const {
  return CorotationalElement(stiffness(), length()).evaluate(pose, withTangent);
}

std::vector<DofMap> nodalDofs(const std::vector<std::shared_ptr<const Element>>& chain) {
  std::vector<DofMap> nodes(chain.size() + 1, DofMap{});
  for (std::size_t e = 0; e < chain.size(); ++e) {
    const DofMap dofs = chain[e]->dofs();
    for (std::size_t c = 0; c < dofs.size(); ++c)
      if (dofs[c]) nodes[e][c] = nodes[e + 1][c] = true;
  }
  return nodes;
}

void declareElement(deck::ListSpec& list, deck::Default chosen, const std::string& doc) {
  deck::declareVariants<Element, const Teuchos::ParameterList&, const Section&, double>(
      list, "Element", std::move(chosen), doc)
      .expert();
}

ElementChoice readElement(const Teuchos::ParameterList& list, const ElementChoice& standard) {
  if (!list.isParameter("Element")) return standard;
  const auto& name = list.get<std::string>("Element");
  return {name, deck::variantList(list, name, ElementRegistry::instance().find(name).parameters)};
}

}  // namespace tooljoint::beam
