// SPDX-License-Identifier: BSD-3-Clause
#include "app/Commands.hpp"
#include "app/Scene.hpp"
#include "common/Error.hpp"
#include "deck/Manual.hpp"
#include "deck/Template.hpp"
#include "substructures/drillstring/Components.hpp"

namespace tooljoint::app {

std::string manual(const std::string& topic, const std::string& format) {
  const std::vector<deck::ListSpec> roots{sceneSpec(), drillstring::libraryParameters()};
  if (deck::isUnitsTopic(topic))
    return format == "json" ? deck::unitsJson() : deck::unitsMarkdown();
  if (format == "json") return deck::manualJson(roots, topic) + "\n";
  if (!topic.empty()) return deck::manualMarkdown(roots, topic);
  return "# Parameters of a deck\n\nWritten by `tooljoint doc`; every parameter a deck may hold, "
         "and the component libraries it may name.\n\n" +
         deck::manualMarkdown(roots) + "\n" + deck::unitsMarkdown();
}

std::string deckTemplate(const std::string& kind) {
  // A string of pipes that hangs in a vertical hole: what nobody can guess from types and ranges.
  const deck::Examples hanging{{"Well/Trajectory", "Vertical"},
                               {"Well/Bore Radius", "0.108"},
                               {"Well/Vertical/Length", "100"},
                               {"Drillstring/Components/pipe/Length", "9.6"},
                               {"Drillstring/Components/pipe/Outer Radius", "0.0635"},
                               {"Drillstring/Components/pipe/Inner Radius", "0.0543"},
                               {"Drillstring/Assembly", "{10*pipe}"},
                               {"Loads/Gravity", "9.81"}};
  if (kind == "scene") return deck::templateXml(sceneSpec(), "my_scene", hanging);
  if (kind == "components")
    return deck::templateXml(drillstring::libraryParameters(), "my_components");
  throw UsageError("There is no template \"" + kind +
                   "\". Available: \"scene\" and \"components\".");
}

}  // namespace tooljoint::app
