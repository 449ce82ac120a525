// SPDX-License-Identifier: BSD-3-Clause
#include "app/commands/Commands.hpp"
#include "deck/Manual.hpp"
#include "substructures/drillstring/assembly/Components.hpp"
#include "substructures/drillstring/scene/Scene.hpp"

namespace tooljoint::app {

std::string manual(const std::string& topic, const std::string& format) {
  const std::vector<deck::ListSpec> roots{drillstring::sceneSpec(),
                                          drillstring::libraryParameters()};
  if (deck::isUnitsTopic(topic))
    return format == "json" ? deck::unitsJson() : deck::unitsMarkdown();
  if (format == "json") return deck::manualJson(roots, topic) + "\n";
  if (!topic.empty()) return deck::manualMarkdown(roots, topic);
  return "# Parameters of a deck\n\nWritten by `tooljoint doc`; every parameter a deck may hold, "
         "and the component libraries it may name.\n\n" +
         deck::manualMarkdown(roots) + "\n" + deck::unitsMarkdown();
}

}  // namespace tooljoint::app
