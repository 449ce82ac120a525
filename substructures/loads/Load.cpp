// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/loads/Load.hpp"

#include <string>
#include <utility>

#include "common/Error.hpp"
#include "deck/Variants.hpp"

namespace tooljoint::loads {
namespace {

constexpr const char* listName = "Loads";

/// A load on the lower part of a string; shifts depths by the top of that part.
class OfLowerPart final : public Load {
 public:
  OfLowerPart(std::shared_ptr<const Load> load, double top) : load_(std::move(load)), top_(top) {}

  Vector3 acceleration() const override { return load_->acceleration(); }
  std::vector<LineLoad> onElement(const LoadedElement& element,
                                  const RotarySpeed& rotary) const override {
    return load_->onElement(
        {element.section, element.frame, element.from + top_, element.to + top_}, rotary);
  }
  std::vector<PointLoad> atNodes(const std::vector<double>& depths,
                                 const RotarySpeed& rotary) const override {
    std::vector<double> measured = depths;
    for (double& depth : measured) depth += top_;
    return load_->atNodes(measured, rotary);
  }
  std::vector<LoadRemark> describe(const RotarySpeed& rotary) const override {
    return load_->describe(rotary);
  }
  std::string list() const override { return load_->list(); }

 private:
  std::shared_ptr<const Load> load_;
  double top_;
};

void requirePlace(const PointLoad& load, int nodes) {
  const auto refuse = [&](const std::string& what, int value, const std::string& expected) {
    throw ModelError("The load \"" + load.name + "\" acts on " + what + " " +
                     std::to_string(value) + ", expected " + expected + ".");
  };
  if (load.node < 1 || load.node > nodes)
    refuse("node", load.node, "1 to " + std::to_string(nodes));
  constexpr int components = 6;
  if (load.component < 0 || load.component >= components)
    refuse("component", load.component, "0 to " + std::to_string(components - 1));
}

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
    for (PointLoad& point : load->atNodes(depths, rotary)) {
      requirePlace(point, static_cast<int>(depths.size()));
      all.push_back(std::move(point));
    }
  return all;
}

Vector3 steadyBesideWeight(const Loads& loads, const LoadedElement& element,
                           const RotarySpeed& rotary) {
  Vector3 sum =
      -element.section.massPerLength() * (element.frame.transpose() * acceleration(loads));
  for (const auto& load : loads)
    for (const auto& line : load->onElement(element, rotary))
      if (line.law.isOne()) sum += line.force;
  return sum;
}

Loads below(const Loads& loads, double top) {
  Loads shifted;
  for (const auto& load : loads) shifted.push_back(std::make_shared<OfLowerPart>(load, top));
  return shifted;
}

}  // namespace tooljoint::loads
