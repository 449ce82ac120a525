// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/loads/Load.hpp"

#include <utility>

#include "deck/Variants.hpp"

namespace tooljoint::loads {
namespace {

constexpr const char* listName = "Loads";

bool inListItself(const LoadRegistry::Entry& entry) { return entry.parameters.name() == listName; }

}  // namespace

deck::ListSpec parameters() {
  deck::ListSpec spec(listName,
                      "Weight, bit loads, unbalances and nodal forces; without this list nothing "
                      "loads the string.");
  for (const auto& [name, entry] : LoadRegistry::instance().entries())
    if (inListItself(entry)) spec.merge(entry.parameters);
  for (const auto& [name, entry] : LoadRegistry::instance().entries())
    if (!inListItself(entry)) spec.list(deck::variantSpec(name, entry));
  return spec;
}

Loads readLoads(const Teuchos::ParameterList& list) {
  const LoadRegistry& registry = LoadRegistry::instance();
  Loads loads;
  for (const auto& [name, entry] : registry.entries()) {
    if (inListItself(entry))
      loads.push_back(registry.make(name, list));
    else if (list.isSublist(name))
      loads.push_back(registry.make(name, list.sublist(name)));
  }
  return loads;
}

Vector3 acceleration(const Loads& loads) {
  Vector3 sum = Vector3::Zero();
  for (const auto& load : loads) sum += load->acceleration();
  return sum;
}

std::vector<PointLoad> pointLoads(const Loads& loads, const std::vector<double>& depths,
                                  const RotarySpeed& rotary) {
  std::vector<PointLoad> all;
  for (const auto& load : loads)
    for (PointLoad& point : load->atNodes(depths, rotary)) all.push_back(std::move(point));
  return all;
}

}  // namespace tooljoint::loads
