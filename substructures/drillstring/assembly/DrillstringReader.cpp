// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drillstring/assembly/DrillstringReader.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/Error.hpp"
#include "common/Text.hpp"
#include "substructures/drillstring/Mesh.hpp"
#include "substructures/drillstring/assembly/Libraries.hpp"
#include "substructures/drillstring/assembly/PipeTable.hpp"

namespace tooljoint::drillstring {
namespace {

using deck::Range;

const std::string here = "Drillstring";

/// Lengths with a smaller relative difference are the same.
constexpr double roundOff = 1e-9;

beam::Material readMaterial(const Teuchos::ParameterList& list) {
  beam::Material material;
  if (!list.isSublist("Material")) return material;
  const Teuchos::ParameterList& own = list.sublist("Material");
  material.density = own.get<double>("Density");
  material.youngModulus = own.get<double>("Young Modulus");
  material.poissonRatio = own.get<double>("Poisson Ratio");
  if (own.isParameter("Yield Strength")) material.yieldStrength = own.get<double>("Yield Strength");
  return material;
}

/// Length of a component [m]. None if it, or a part of it, is not in the library or contains
/// itself; the mesh reports that.
std::optional<double> lengthOf(const ComponentLibrary& library, const std::string& name,
                               std::size_t depth = 0) {
  const auto found = library.find(name);
  if (found == library.end() || depth > library.size()) return std::nullopt;
  double length = 0.0;
  for (const Segment& segment : found->second.segments) length += segment.length;
  for (const AssemblyEntry& part : found->second.parts) {
    const auto own = lengthOf(library, part.name, depth + 1);
    if (!own) return std::nullopt;
    length += part.count * *own;
  }
  return length;
}

/// The assembly with as many of its first component as reach from the bit to the surface. With none
/// if an analysis has a bit above the length of the other components.
std::vector<AssemblyEntry> filled(const StringSettings& settings, double bit, bool asked) {
  auto assembly = settings.assembly;
  std::vector<double> lengths;
  for (const AssemblyEntry& entry : assembly) {
    const auto length = lengthOf(settings.library, entry.name);
    if (!length) return assembly;
    lengths.push_back(entry.count * *length);
  }
  const double whole = std::accumulate(lengths.begin(), lengths.end(), 0.0);
  if (!assembly.empty() && assembly.front().fill) {
    const double below = whole - lengths.front();
    if (!(bit > below)) {
      if (asked) return {assembly.begin() + 1, assembly.end()};
      throw DeckError(settings.bitAt(bit) + ", but the string below " +
                      inQuotes("fill*" + assembly.front().name) + " is " +
                      settings.depth.text(below) +
                      " long. The uppermost component fills the hole above it: give a Bit Depth "
                      "of more than " +
                      settings.depth.text(below) + ", or take components out of the Assembly.");
    }
    assembly.front().count =
        std::max(1, static_cast<int>(std::ceil((bit - below) / lengths.front() - roundOff)));
  } else if (whole < bit * (1.0 - roundOff)) {
    throw DeckError(settings.bitAt(bit) + ", but the Assembly is " + settings.depth.text(whole) +
                    " long and does not reach the surface from there. Begin it with \"fill*" +
                    assembly.front().name + "\", or set a smaller Bit Depth.");
  }
  return assembly;
}

deck::Deck readLibrary(const deck::Deck& deck, const std::string& name) {
  const auto builtIn = componentLibraries().find(name);
  if (builtIn != componentLibraries().end())
    return deck::Deck::parse(builtIn->second, name, libraryParameters());
  return deck.readNamed(here + "/Library", name, libraryParameters());
}

}  // namespace

std::string StringSettings::bitAt(double bit) const {
  return (bitDepth ? depthWhere + " is " : assemblyWhere + ": the bit is at ") + depth.text(bit);
}

deck::ListSpec drillstringParameters() {
  const beam::Material steel;
  deck::ListSpec spec(here, "Components of the string.");
  spec.text("Library", deck::Optional{},
            "Component library: \"api_pipes\", which is built in, or an XML file relative to the "
            "deck.")
      .text("Pipe Table", deck::Optional{},
            "Table of drill pipe, a CSV file relative to the deck: a row is a component of that "
            "name, as \"5 in 19.50 S-135 NC50\", with a stand of three, \"5 in 19.50 S-135 NC50 "
            "stand\".")
      .expert()
      .list(deck::ListSpec(
                "Components",
                "Components defined in the deck itself, in addition to those of the Library.")
                .namedLists(componentParameters()))
      .textArray(
          "Assembly", deck::Required{}, {},
          "Components from the surface to the bit, repeated as in {10*stand, 3*collar, bit}; "
          "{fill*stand, 3*collar, bit} takes as many stands as reach the surface.")
      .real("Bit Depth", "m", deck::Optional{}, Range::positive(),
            "Measured depth of the bit; the string is cut at the surface. Without it the bit is "
            "where "
            "the Assembly ends, or at the end of the well for one that fills.")
      .list(deck::ListSpec("Material", "Material of components that give none; steel when absent.")
                .real("Density", "kg/m3", steel.density, Range::positive(), "Density.")
                .real("Young Modulus", "Pa", steel.youngModulus, Range::positive(),
                      "Young's modulus E.")
                .real("Poisson Ratio", "", steel.poissonRatio, Range{-1.0, 0.5, true, false},
                      "Ratio of lateral contraction to stretch (Poisson).")
                .real("Yield Strength", "Pa", deck::Optional{}, Range::positive(),
                      "Stress at which it yields, e.g. 931 MPa for S-135. Without it no margin to "
                      "yield."));
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
    const deck::Deck library = readLibrary(deck, list.get<std::string>("Library"));
    readComponents(library.list(), settings.defaults, {library, ""}, settings.library, faults);
  }
  if (list.isParameter("Pipe Table")) {
    try {
      readPipeTable(deck.resolve(list.get<std::string>("Pipe Table")), settings.defaults,
                    settings.library, faults);
    } catch (const FileError& fault) {
      throw DeckError(
          deck.error(here + "/Pipe Table", std::string("names a file, but ") + fault.what()));
    }
  }
  if (list.isSublist("Components"))
    readComponents(list.sublist("Components"), settings.defaults,
                   {deck, std::string(here) + "/Components/"}, settings.library, faults);
  if (list.isParameter("Bit Depth")) {
    settings.bitDepth = list.get<double>("Bit Depth");
    settings.depthWhere = deck.where(here + "/Bit Depth");
    settings.depth = deck.given(here + "/Bit Depth", "m");
  }
  for (const std::string& text : list.get<Teuchos::Array<std::string>>("Assembly")) {
    try {
      settings.assembly.push_back(parseEntry(text));
      if (settings.assembly.back().fill && settings.assembly.size() > 1)
        throw DeckError(inQuotes(text) +
                        " is not the first entry. Only the uppermost component can fill the string "
                        "up to the surface.");
    } catch (const DeckError& error) {
      faults.push_back(settings.assemblyWhere + ": " + error.what());
    }
  }
  if (!faults.empty()) throw DeckError(join(faults, "\n"));
  return settings;
}

DrillString buildDrillString(const StringSettings& settings, const well::Well& well,
                             std::optional<double> bit) {
  const bool fills = !settings.assembly.empty() && settings.assembly.front().fill;
  const bool asked = bit.has_value();
  if (!bit) bit = settings.bitDepth;
  if (!bit && fills) bit = well.length();
  if (!asked && settings.bitDepth && *bit > well.length() + roundOff * well.length())
    throw DeckError(settings.bitAt(*bit) + ", but the well ends at " +
                    settings.depth.text(well.length()) +
                    ". Set a smaller Bit Depth, or lengthen the well.");
  const auto assembly = bit ? filled(settings, *bit, asked) : settings.assembly;
  DrillString string =
      buildDrillString(settings.library, assembly, well, settings.assemblyWhere, bit);
  string.toolFace = settings.toolFace;
  return string;
}

}  // namespace tooljoint::drillstring
