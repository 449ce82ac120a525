// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drillstring/DrillstringReader.hpp"

#include "common/Text.hpp"
#include "substructures/drillstring/Mesh.hpp"

namespace tooljoint::drillstring {
namespace {

using deck::Range;

const std::string here = "Drillstring";

beam::Material readMaterial(const Teuchos::ParameterList& list) {
  beam::Material material;
  if (!list.isSublist("Material")) return material;
  const Teuchos::ParameterList& own = list.sublist("Material");
  material.density = own.get<double>("Density");
  material.youngModulus = own.get<double>("Young Modulus");
  material.poissonRatio = own.get<double>("Poisson Ratio");
  return material;
}

}  // namespace

deck::ListSpec drillstringParameters() {
  const beam::Material steel;
  deck::ListSpec spec(here, "What the string is made of.");
  spec.text("Library", deck::Optional{}, "Component library, an XML file relative to the deck.")
      .list(deck::ListSpec("Components",
                           "Components defined in the deck itself, beside those of the Library.")
                .namedLists(componentParameters()))
      .textArray(
          "Assembly", deck::Required{}, {},
          "Components from the surface to the bit, repeated as in {10*stand, 3*collar, bit}.")
      .list(deck::ListSpec("Material", "Material of components that give none; steel when absent.")
                .real("Density", "kg/m3", steel.density, Range::positive(), "Density.")
                .real("Young Modulus", "Pa", steel.youngModulus, Range::positive(),
                      "Young's modulus E.")
                .real("Poisson Ratio", "", steel.poissonRatio, Range{-1.0, 0.5, true, false},
                      "Ratio of lateral contraction to stretch (Poisson)."));
  spec.real("Tool Face", "rad", 0.0, Range::any(),
            "Side that bends, eccentric gauges and pads of direction 0 point to: from the high "
            "side of the hole at the bit (from north in a vertical hole), clockwise looking down "
            "the hole.");
  beam::declareElement(spec, std::string("Timoshenko"),
                       "Finite element of components that give none.");
  return spec;
}

StringSettings readDrillstring(const deck::Deck& deck) {
  const Teuchos::ParameterList& list = deck.list().sublist(here);
  StringSettings settings;
  settings.defaults = {readMaterial(list), beam::readElement(list, {})};
  settings.toolFace = list.get<double>("Tool Face");
  settings.assemblyWhere = deck.where(here + "/Assembly");
  std::vector<std::string> faults;
  if (list.isParameter("Library")) {
    const deck::Deck library =
        deck.readNamed(here + "/Library", list.get<std::string>("Library"), libraryParameters());
    readComponents(
        library.list(), settings.defaults,
        [&](const std::string& path) { return library.where(path); }, settings.library, faults);
  }
  if (list.isSublist("Components"))
    readComponents(
        list.sublist("Components"), settings.defaults,
        [&](const std::string& path) { return deck.where(here + "/Components/" + path); },
        settings.library, faults);
  for (const std::string& text : list.get<Teuchos::Array<std::string>>("Assembly")) {
    try {
      settings.assembly.push_back(parseEntry(text));
    } catch (const DeckError& error) {
      faults.push_back(settings.assemblyWhere + ": " + error.what());
    }
  }
  if (!faults.empty()) throw DeckError(join(faults, "\n"));
  return settings;
}

DrillString buildDrillString(const StringSettings& settings, const well::Well& well,
                             std::optional<double> bit) {
  DrillString string =
      buildDrillString(settings.library, settings.assembly, well, settings.assemblyWhere, bit);
  string.toolFace = settings.toolFace;
  return string;
}

}  // namespace tooljoint::drillstring
