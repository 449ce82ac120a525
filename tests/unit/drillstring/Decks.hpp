// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Scenes of the string tests: a straight well of a given bore and length, and a list Drillstring.
#pragma once

#include <string>

#include "deck/Deck.hpp"
#include "substructures/drillstring/Supports.hpp"
#include "substructures/drillstring/assembly/DrillstringReader.hpp"
#include "substructures/well/Well.hpp"

namespace tooljoint::drillstring::testing {

inline std::string real(const std::string& name, const std::string& value) {
  return "<Parameter name=\"" + name + "\" type=\"double\" value=\"" + value + "\"/>\n";
}
inline std::string whole(const std::string& name, int value) {
  return "<Parameter name=\"" + name + "\" type=\"int\" value=\"" + std::to_string(value) +
         "\"/>\n";
}
inline std::string text(const std::string& name, const std::string& value) {
  return "<Parameter name=\"" + name + "\" type=\"string\" value=\"" + value + "\"/>\n";
}
inline std::string array(const std::string& name, const std::string& value) {
  return "<Parameter name=\"" + name + "\" type=\"Array(string)\" value=\"{" + value + "}\"/>\n";
}
inline std::string list(const std::string& name, const std::string& inside) {
  return "<ParameterList name=\"" + name + "\">\n" + inside + "</ParameterList>\n";
}
/// A component of one segment.
inline std::string tube(const std::string& name, double length, int elements, double outer,
                        double inner, const std::string& more = "") {
  return list(name, real("Length", std::to_string(length)) + whole("Elements", elements) +
                        real("Outer Radius", std::to_string(outer)) +
                        real("Inner Radius", std::to_string(inner)) + more);
}

inline deck::Deck scene(const std::string& drillstring, const std::string& file = "deck.xml") {
  deck::ListSpec spec("scene", "A scene.");
  spec.requiredList(drillstringParameters());
  return deck::Deck::parse(list("scene", list("Drillstring", drillstring)), file, spec);
}

inline well::Well verticalWell(double length = 1000.0, double bore = 0.108) {
  return well::Well(well::straight(length), bore);
}

inline DrillString build(const std::string& drillstring, const well::Well& well = verticalWell()) {
  return buildDrillString(readDrillstring(scene(drillstring)), well);
}

inline std::string errorOf(const std::string& drillstring,
                           const well::Well& well = verticalWell()) {
  try {
    build(drillstring, well);
  } catch (const DeckError& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace tooljoint::drillstring::testing
