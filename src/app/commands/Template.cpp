// SPDX-License-Identifier: BSD-3-Clause
#include "deck/Template.hpp"

#include <iostream>
#include <sstream>

#include "app/commands/Command.hpp"
#include "common/Error.hpp"
#include "common/Text.hpp"
#include "common/report/Terminal.hpp"
#include "substructures/drillstring/assembly/Components.hpp"
#include "substructures/drillstring/scene/Scene.hpp"
#include "texts/Templates.hpp"

namespace tooljoint::app {

namespace {

/// All lists of a scene, with a string of pipes that hangs in a vertical hole: values that do not
/// follow from types and ranges.
std::string everyList(bool experts) {
  const deck::Examples hanging{{"Well/Trajectory", "Vertical"},
                               {"Well/Bore Radius", "0.108"},
                               {"Well/Vertical/Length", "100"},
                               {"Drillstring/Components/pipe/Length", "9.6"},
                               {"Drillstring/Components/pipe/Outer Radius", "0.0635"},
                               {"Drillstring/Components/pipe/Inner Radius", "0.0543"},
                               {"Drillstring/Assembly", "{10*pipe}"},
                               {"Loads/Gravity", "9.81"}};
  return deck::templateXml(drillstring::sceneSpec(), "my_scene", hanging,
                           experts ? deck::Level::Expert : deck::Level::Basic);
}

/// The numbers of survey.csv; its first line is a remark and its second one the header.
std::string stations() {
  std::istringstream rows(texts::templateFiles().at("survey.csv"));
  std::string all, row;
  for (int line = 1; std::getline(rows, row); ++line)
    if (line > 2) all += (all.empty() ? "" : ",   ") + row;
  return all;
}

/// The deck of `tooljoint new` with its survey inside, so that it needs no other file.
std::string wellAlone() {
  const std::string file = R"(<Parameter name="File" type="string" value="survey.csv"/>)";
  std::string text = texts::templateFiles().at("well.xml");
  const auto at = text.find(file);
  if (at == std::string::npos)
    throw Error(ExitCode::Internal, "The template of a well names no survey.csv.");
  const std::string inDeck =
      R"~(<Parameter name="Stations" type="Array(double)" value="{)~" + stations() + R"~(}"/>
      <!-- measured depth, inclination and azimuth of each; or File, a table -->
      <Parameter name="Depth Unit" type="string" value="ft"/>)~";
  return terminal::wrapped(text.replace(at, file.size(), inDeck), 4);
}

const std::vector<std::string> templateKinds{"well",  "parts", "part",
                                             "study", "scene", "components"};

/// A deck to start from; `all` includes the parameters for experts. UsageError for an unknown kind,
/// and for `all` with a kind other than "scene".
std::string deckTemplate(const std::string& kind, bool all) {
  if (all && kind != "scene")
    throw UsageError("--all belongs to the template \"scene\"; \"" + kind +
                     "\" has no other parameters.");
  if (kind == "well") return wellAlone();
  if (kind == "parts") return texts::templateFiles().at("parts.xml");
  if (kind == "part") return texts::templateFiles().at("bar.json");
  if (kind == "study") return texts::templateFiles().at("study.xml");
  if (kind == "scene") return everyList(all);
  if (kind == "components")
    return deck::templateXml(drillstring::libraryParameters(), "my_components");
  throw UsageError("There is no template " + inQuotes(kind) +
                   ". Available: " + quotedList(templateKinds) + ".");
}

Action prepareTemplate(CLI::App& line) {
  struct Options {
    std::string kind;
    bool all = false;
  };
  auto options = std::make_shared<Options>();
  line.add_option("KIND", options->kind,
                  "a surveyed well, parts, the part file of parts, a study, a scene with every "
                  "list, or a library of components")
      ->type_name("{" + join(templateKinds, ",") + "}")
      ->required();
  line.add_flag("--all", options->all, "of scene: parameters for experts, too");
  return [options] { print(std::cout, deckTemplate(options->kind, options->all)); };
}

const bool templateRegistered =
    addCommand({Group::Begin, "template", "print a commented deck to start from", prepareTemplate});

}  // namespace

}  // namespace tooljoint::app
