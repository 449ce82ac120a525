// SPDX-License-Identifier: BSD-3-Clause
#include "deck/Template.hpp"

#include "app/commands/Commands.hpp"
#include "common/Error.hpp"
#include "substructures/drillstring/Components.hpp"
#include "substructures/drillstring/case/Scene.hpp"

namespace tooljoint::app {

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
  if (kind == "scene") return deck::templateXml(drillstring::sceneSpec(), "my_scene", hanging);
  if (kind == "components")
    return deck::templateXml(drillstring::libraryParameters(), "my_components");
  throw UsageError("There is no template \"" + kind +
                   "\". Available: \"scene\" and \"components\".");
}

}  // namespace tooljoint::app
