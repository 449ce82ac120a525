// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Components of a string. A component consists of segments, or of parts that are components
/// themselves (a stand of pipes). Components are defined in the deck (`Drillstring/Components`) or
/// in a component library, a separate XML file.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "deck/Deck.hpp"
#include "substructures/beam/Element.hpp"

namespace Teuchos {
class ParameterList;
}

namespace tooljoint::drillstring {

/// Uniform piece of a component, divided into equal elements.
struct Segment {
  double length = 0.0;  ///< [m]
  int elements = 1;
  beam::Section section;
  beam::ElementChoice element;
  double frictionFactor = 1.0;  ///< on the friction coefficients of the wall it touches
};

/// `count` times the component `name`: one entry of an assembly, "3*collar". "fill*stand" repeats
/// it until the string reaches the surface.
struct AssemblyEntry {
  int count = 1;
  std::string name;
  bool fill = false;
};

/// A feature at a position of a component that points to one side of the string.
struct SidedFeature {
  double position = 0.0;   ///< from the top of the component [m]; must be a node
  double size = 0.0;       ///< angle of a bend [rad], force of a pad [N]
  double direction = 0.0;  ///< from the tool face, clockwise looking down the hole [rad]
};

/// A component: either segments or parts, and perhaps a gauge, a bend and a pad.
struct Component {
  std::string name;
  std::string
      where;  ///< where it is defined, for messages: "string.xml:12: /Drillstring/Components/pipe"
  std::vector<Segment> segments;
  std::vector<AssemblyEntry> parts;
  std::optional<double>
      gaugePosition;  ///< distance of the gauge from the top of the component [m]; must be a node
  double gaugeRadius = 0.0;     ///< [m]
  double gaugeOffset = 0.0;     ///< of the centre of the gauge from that of the string [m]
  double gaugeDirection = 0.0;  ///< of the offset, from the tool face [rad]
  std::optional<SidedFeature> bend;
  std::optional<SidedFeature> pad;
  /// Names and units with which the deck gives the length of the first segment, its outer radius
  /// and the gauge.
  deck::Given length{"Length", "m"}, outer{"Outer Radius", "m"}, gauge{"Gauge Radius", "m"};
};

/// Values of pieces that do not set their own.
struct SegmentDefaults {
  beam::Material material;
  beam::ElementChoice element;
};

/// Components by name.
using ComponentLibrary = std::map<std::string, Component>;

/// Lists of components in a deck or a library.
struct ComponentLists {
  const deck::Deck& deck;
  std::string below;  ///< path of the lists with a "/" at its end; "" for the root list

  std::string where(const std::string& path) const { return deck.where(below + path); }
  deck::Given length(const std::string& path) const { return deck.given(below + path, "m"); }
};

/// Description of one component, and of a library file: a list of components named by the user.
deck::ListSpec componentParameters();
deck::ListSpec libraryParameters();

/// "3*collar" -> {3, "collar"}, "fill*stand" -> {1, "stand", true}. Throws DeckError with a
/// sentence when it is not of the form "name", "count*name" or "fill*name".
AssemblyEntry parseEntry(const std::string& text);

/// Adds a component to the library. Returns the fault of its name (characters with a meaning in an
/// assembly, defined before), "" if there is none; with a fault it is not added.
std::string addComponent(Component component, ComponentLibrary& library);

/// Adds the components of a list to the library. Faults (radii, missing parameters, a name defined
/// before ...) go to `faults`, one rendered line each; that component is omitted.
void readComponents(const Teuchos::ParameterList& list, const SegmentDefaults& standard,
                    const ComponentLists& lists, ComponentLibrary& library,
                    std::vector<std::string>& faults);

}  // namespace tooljoint::drillstring
