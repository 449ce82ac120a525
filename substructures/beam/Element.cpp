// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/beam/Element.hpp"

#include <array>
#include <string>
#include <utility>

#include "common/Error.hpp"
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

namespace {

/// Entries smaller than this fraction of the largest entry of their kind are rounding.
constexpr double rounding = 1e-9;

/// Scales rows and columns to one unit: lengths in multiples of the element length.
Matrix12 scaled(const Matrix12& A, double length) {
  Vector12 unit;
  for (int i = 0; i < 12; ++i) unit[i] = i % 6 < 3 ? 1.0 : 1.0 / length;
  return unit.asDiagonal() * A * unit.asDiagonal();
}

void requireSymmetric(const Matrix12& A, const std::string& who, const char* what) {
  int row = 0, column = 0;
  const double gap = (A - A.transpose()).cwiseAbs().maxCoeff(&row, &column);
  if (gap <= rounding * A.cwiseAbs().maxCoeff()) return;
  throw ModelError(who + " has a " + what + " that is not symmetric: entries (" +
                   std::to_string(row + 1) + ", " + std::to_string(column + 1) + ") and (" +
                   std::to_string(column + 1) + ", " + std::to_string(row + 1) +
                   ") of its matrix differ.");
}

void requireSound(const Element& element, const std::string& name) {
  const std::string who = "The element \"" + name + "\"";
  const Matrix12 K = scaled(element.stiffness(), element.length());
  requireSymmetric(K, who, "stiffness");
  requireSymmetric(scaled(element.mass(), element.length()), who, "mass");
  constexpr std::array<const char*, 6> motions{"u", "v", "w", "", "", "theta_z"};
  for (int c = 0; c < 6; ++c)
    if (const auto* motion = motions[static_cast<std::size_t>(c)];
        *motion != '\0' &&
        (K.col(c) + K.col(c + 6)).cwiseAbs().maxCoeff() > rounding * K.cwiseAbs().maxCoeff())
      throw ModelError(who + " resists a rigid motion in " + motion +
                       ": columns of its stiffness at both ends do not add up to zero.");
}

}  // namespace

std::shared_ptr<const Element> ElementChoice::make(const Section& section, double length) const {
  std::shared_ptr<const Element> element =
      ElementRegistry::instance().make(name, own, section, length);
  requireSound(*element, name);
  return element;
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
