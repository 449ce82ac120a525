// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drillstring/assembly/Components.hpp"

#include <Teuchos_ParameterList.hpp>
#include <array>
#include <charconv>
#include <utility>

#include "common/Constants.hpp"
#include "common/Text.hpp"

namespace tooljoint::drillstring {
namespace {

using deck::Optional;
using deck::Range;
using deck::Required;
using Teuchos::ParameterList;

const std::array<const char*, 4> generalNames = {"Area", "Inertia X", "Inertia Y",
                                                 "Torsion Constant"};

/// Largest angle of a bend [rad]: displacements are linearised.
constexpr double largestBend = 10.0 * constants::degree;

deck::ListSpec materialSpec() {
  return deck::ListSpec("Material",
                        "Material of this piece, where it differs from Drillstring/Material.")
      .real("Density", "kg/m3", Optional{}, Range::positive(), "Density.")
      .real("Young Modulus", "Pa", Optional{}, Range::positive(), "Young's modulus E.")
      .real("Poisson Ratio", "", Optional{}, Range{-1.0, 0.5, true, false},
            "Ratio of lateral contraction to stretch (Poisson).")
      .real("Yield Strength", "Pa", Optional{}, Range::positive(),
            "Stress at which it yields: that of the margins to yield.");
}

/// The parameters of a segment; a component of one segment has them directly.
void addSegmentParameters(deck::ListSpec& spec, const deck::Default& length) {
  spec.real("Length", "m", length, Range::positive(), "Length along the axis.");
  spec.integer("Elements", Optional{}, Range::between(1, 10000),
               "Number of beam elements it is cut into; 1 when absent.");
  spec.radius("Outer Radius", Optional{}, Range::positive(),
              "Outer radius of the body; of a general section for contact and mud only.");
  spec.radius("Inner Radius", Optional{}, Range::nonNegative(), "Inner radius; 0 when absent.");
  spec.boolean("Shear Deformation", Optional{},
               "Whether a circular section deforms in shear (Timoshenko); true when absent.")
      .expert();
  spec.real("Area", "m2", Optional{}, Range::positive(),
            "Area of a general section, which has no shear deformation.")
      .expert();
  spec.real("Inertia X", "m4", Optional{}, Range::positive(),
            "Second moment about x of a general section.")
      .expert();
  spec.real("Inertia Y", "m4", Optional{}, Range::positive(),
            "Second moment about y of a general section.")
      .expert();
  spec.real("Torsion Constant", "m4", Optional{}, Range::positive(),
            "Torsion constant J of a general section.")
      .expert();
  spec.real(
          "Friction Factor", "", Optional{}, Range::nonNegative(),
          "Factor on the friction coefficients of Contact where this piece touches the wall: tool "
          "joints with hard bands, bodies, stabilisers apart; 1 when absent.")
      .expert();
  beam::declareElement(spec, Optional{},
                       "Finite element of this piece, where it differs from Drillstring/Element.");
  spec.list(materialSpec());
}

/// A bend or a pad: size, position and side.
deck::ListSpec sidedSpec(const std::string& name, const std::string& doc, const Range& range,
                         const std::string& size, const std::string& unit,
                         const std::string& sizeDoc) {
  return deck::ListSpec(name, doc)
      .real(size, unit, Required{}, range, sizeDoc)
      .real("Position", "m", Required{}, Range::nonNegative(),
            "Distance from the top of the component; a node must stand there.")
      .real("Direction", "rad", 0.0, Range::any(),
            "Side it points to, from Drillstring/Tool Face, clockwise looking down the hole.")
      .expert();
}

double valueOr(const ParameterList& list, const char* name, double standard) {
  return list.isParameter(name) ? list.get<double>(name) : standard;
}

beam::Material readMaterial(const ParameterList& list, const beam::Material& standard) {
  if (!list.isSublist("Material")) return standard;
  const ParameterList& own = list.sublist("Material");
  beam::Material material = standard;
  material.density = valueOr(own, "Density", standard.density);
  material.youngModulus = valueOr(own, "Young Modulus", standard.youngModulus);
  material.poissonRatio = valueOr(own, "Poisson Ratio", standard.poissonRatio);
  if (own.isParameter("Yield Strength")) material.yieldStrength = own.get<double>("Yield Strength");
  return material;
}

/// The values of a list; `standard` for those it does not have.
SegmentDefaults readDefaults(const ParameterList& list, const SegmentDefaults& standard) {
  return {readMaterial(list, standard.material), beam::readElement(list, standard.element)};
}

/// Fault of a component name in an assembly; "" if there is none.
std::string nameFault(const std::string& name) {
  if (name.empty()) return "The component has no name.";
  if (name.find_first_of("*,/{}") == std::string::npos) return "";
  return "The name of a component must not hold any of the characters * , / { }.";
}

/// Reads one component; ends at the first fault.
class ComponentReader {
 public:
  ComponentReader(const SegmentDefaults& standard, const ComponentLists& lists)
      : standard_(standard), lists_(lists) {}

  Component read(const std::string& name, const ParameterList& list) const {
    Component component;
    component.name = name;
    component.where = lists_.where(name);
    if (const auto fault = nameFault(name); !fault.empty()) fail(name, fault);
    const bool own = hasSegment(list);
    const bool segments = list.isSublist("Segments");
    const bool parts = list.isParameter("Parts");
    if (static_cast<int>(own) + static_cast<int>(segments) + static_cast<int>(parts) != 1)
      fail(name,
           "A component is given by exactly one of: Length with a section, the list Segments, or "
           "the array Parts.");
    if (own) {
      component.segments.push_back(segment(name, list, standard_));
      setGiven(name, component);
    } else if (segments) {
      const SegmentDefaults standard = readDefaults(list, standard_);
      const ParameterList& pieces = list.sublist("Segments");
      for (auto it = pieces.begin(); it != pieces.end(); ++it)
        component.segments.push_back(segment(name + "/Segments/" + pieces.name(it),
                                             pieces.sublist(pieces.name(it)), standard));
      if (pieces.begin() != pieces.end())
        setGiven(name + "/Segments/" + pieces.name(pieces.begin()), component);
      if (component.segments.empty())
        fail(name + "/Segments", "The list is empty; a component needs at least one segment.");
    } else {
      readParts(name, list, component);
    }
    readGauge(name, list, component);
    component.bend = sided(list, "Bend", "Angle");
    component.pad = sided(list, "Pad", "Force");
    return component;
  }

 private:
  [[noreturn]] void fail(const std::string& path, const std::string& sentence) const {
    throw DeckError(lists_.where(path) + ": " + sentence);
  }

  void setGiven(const std::string& path, Component& component) const {
    component.length = lists_.length(path + "/Length");
    component.outer = lists_.length(path + "/Outer Radius");
  }

  [[noreturn]] void failInner(const std::string& path, double inner, double outer) const {
    const auto& [own, around] =
        std::pair(lists_.length(path + "/Inner Radius"), lists_.length(path + "/Outer Radius"));
    fail(path + "/Inner Radius",
         own.text(inner) + " must be below the " + around.name + ", " + around.text(outer) + ".");
  }

  static bool hasSegment(const ParameterList& list) {
    for (const char* name :
         {"Length", "Elements", "Outer Radius", "Inner Radius", "Area", "Inertia X", "Inertia Y",
          "Torsion Constant", "Shear Deformation", "Friction Factor"})
      if (list.isParameter(name)) return true;
    return false;
  }

  Segment segment(const std::string& path, const ParameterList& list,
                  const SegmentDefaults& standard) const {
    if (!list.isParameter("Length")) fail(path, "The segment has no Length.");
    Segment piece;
    piece.length = list.get<double>("Length");
    if (list.isParameter("Elements")) piece.elements = list.get<int>("Elements");
    const SegmentDefaults own = readDefaults(list, standard);
    piece.section = section(path, list, own.material);
    piece.element = own.element;
    piece.frictionFactor = valueOr(list, "Friction Factor", 1.0);
    return piece;
  }

  beam::Section section(const std::string& path, const ParameterList& list,
                        const beam::Material& material) const {
    int given = 0;
    std::string missing;
    for (const char* name : generalNames) {
      if (list.isParameter(name))
        ++given;
      else
        missing += (missing.empty() ? "" : ", ") + std::string(name);
    }
    const double inner = valueOr(list, "Inner Radius", 0.0);
    if (given == 0) {
      if (!list.isParameter("Outer Radius"))
        fail(path,
             "The section is missing: give Outer Radius (or Outer Diameter) and Inner Radius (or "
             "Inner Diameter), or Area, Inertia X, Inertia Y and Torsion Constant.");
      const double outer = list.get<double>("Outer Radius");
      if (!(inner < outer)) failInner(path, inner, outer);
      const beam::Section circular = beam::Section::hollow(outer, inner, material);
      const bool shear =
          !list.isParameter("Shear Deformation") || list.get<bool>("Shear Deformation");
      return shear ? circular : circular.withoutShear();
    }
    if (given < 4) fail(path, "A general section also needs " + missing + ".");
    if (list.isParameter("Shear Deformation"))
      fail(path + "/Shear Deformation",
           "A general section has no shear deformation; remove this parameter.");
    const double outer = valueOr(list, "Outer Radius", 0.0);
    if (inner > 0.0 && !(inner < outer)) failInner(path, inner, outer);
    return beam::Section::general(list.get<double>("Area"), list.get<double>("Inertia X"),
                                  list.get<double>("Inertia Y"),
                                  list.get<double>("Torsion Constant"), material, outer, inner);
  }

  void readParts(const std::string& name, const ParameterList& list, Component& component) const {
    if (list.isSublist("Material"))
      fail(name + "/Material",
           "A component made of Parts has no material of its own; give it where the parts are "
           "defined.");
    if (list.isParameter("Element"))
      fail(name + "/Element",
           "A component made of Parts has no element of its own; give it where the parts are "
           "defined.");
    for (const std::string& text : list.get<Teuchos::Array<std::string>>("Parts")) {
      try {
        component.parts.push_back(parseEntry(text));
        if (component.parts.back().fill)
          throw DeckError(inQuotes(text) +
                          " is in a component, but only the first entry of an Assembly can fill "
                          "the string up to the surface.");
      } catch (const DeckError& error) {
        fail(name + "/Parts", error.what());
      }
    }
    if (component.parts.empty())
      fail(name + "/Parts", "The array is empty; a component needs at least one part.");
  }

  void readGauge(const std::string& name, const ParameterList& list, Component& component) const {
    const bool position = list.isParameter("Gauge Position");
    if (position != list.isParameter("Gauge Radius"))
      fail(name,
           std::string("A gauge needs both Gauge Position and Gauge Radius (or Gauge Diameter); ") +
               (position ? "Gauge Radius" : "Gauge Position") + " is missing.");
    for (const char* eccentric : {"Gauge Offset", "Gauge Offset Direction"})
      if (list.isParameter(eccentric) && !position)
        fail(name + "/" + eccentric,
             "Only a gauge can be eccentric: give Gauge Position and Gauge Radius too.");
    if (list.isParameter("Gauge Offset Direction") && !list.isParameter("Gauge Offset"))
      fail(name + "/Gauge Offset Direction",
           "It has no effect on a gauge without Gauge Offset. Give that, or leave it out.");
    if (!position) return;
    component.gauge = lists_.length(name + "/Gauge Radius");
    component.gaugePosition = list.get<double>("Gauge Position");
    component.gaugeRadius = list.get<double>("Gauge Radius");
    component.gaugeOffset = valueOr(list, "Gauge Offset", 0.0);
    component.gaugeDirection = valueOr(list, "Gauge Offset Direction", 0.0);
  }

  static std::optional<SidedFeature> sided(const ParameterList& list, const char* name,
                                           const char* size) {
    if (!list.isSublist(name)) return std::nullopt;
    const ParameterList& own = list.sublist(name);
    return SidedFeature{own.get<double>("Position"), own.get<double>(size),
                        own.get<double>("Direction")};
  }

  const SegmentDefaults& standard_;
  const ComponentLists& lists_;
};

int wholeNumber(const std::string& number, const std::string& entry) {
  int count = 0;
  const auto result = std::from_chars(number.data(), number.data() + number.size(), count);
  if (result.ec != std::errc() || result.ptr != number.data() + number.size() || count < 1)
    throw DeckError("In " + inQuotes(entry) +
                    " the number before * must be a whole number from 1 on, as in \"3*collar\".");
  return count;
}

}  // namespace

AssemblyEntry parseEntry(const std::string& text) {
  const std::string entry = trim(text);
  const auto star = entry.find('*');
  AssemblyEntry parsed{1, entry};
  if (star != std::string::npos) {
    const std::string number = trim(entry.substr(0, star));
    parsed.name = trim(entry.substr(star + 1));
    parsed.fill = number == "fill";
    if (!parsed.fill) parsed.count = wholeNumber(number, entry);
  }
  if (parsed.name.empty() || parsed.name.find('*') != std::string::npos)
    throw DeckError(inQuotes(entry) + " is not of the form \"component\" or \"3*component\".");
  return parsed;
}

deck::ListSpec componentParameters() {
  deck::ListSpec spec("Component",
                      "A component: one segment (Length and a section), several (Segments), or "
                      "other components (Parts).");
  spec.text("Description", Optional{}, "Description for readers.");
  addSegmentParameters(spec, Optional{});
  deck::ListSpec segment("Segment", "A uniform piece.");
  addSegmentParameters(segment, Required{});
  spec.list(deck::ListSpec("Segments", "The pieces of the component from its top to its bottom.")
                .namedLists(segment));
  spec.textArray(
      "Parts", Optional{}, {},
      "Components it is made of from its top to its bottom, as in {pipe body, 2*joint half}.");
  spec.real("Gauge Position", "m", Optional{}, Range::nonNegative(),
            "Distance of a gauge (stabiliser blades, bit) from the top of the component; a node "
            "must stand there.");
  spec.radius("Gauge Radius", Optional{}, Range::positive(),
              "Radius of the gauge; it replaces the outer radius in contact at that node.");
  spec.real("Gauge Offset", "m", Optional{}, Range::positive(),
            "Distance of the centre of an eccentric gauge from that of the string.")
      .expert();
  spec.real("Gauge Offset Direction", "rad", Optional{}, Range::any(),
            "Side the eccentric gauge stands out to, from Drillstring/Tool Face; 0 when absent.")
      .expert();
  spec.list(sidedSpec("Bend", "Bend without stress, as of a bent housing or a bent sub.",
                      deck::Range{0.0, largestBend, true, false}, "Angle", "rad",
                      "Angle by which the string below points to one side."));
  spec.list(sidedSpec("Pad",
                      "Pad that presses on the wall, as of a rotary steerable tool; it does not "
                      "turn with the string.",
                      Range::positive(), "Force", "N",
                      "Force of the pad on the wall; the string is pushed the other way."));
  return spec;
}

deck::ListSpec libraryParameters() {
  return deck::ListSpec("Components",
                        "Component library: one list per component, named by the user.")
      .namedLists(componentParameters());
}

std::string addComponent(Component component, ComponentLibrary& library) {
  std::string fault = nameFault(component.name);
  if (!fault.empty()) return fault;
  const std::string name = component.name;
  const auto [place, added] = library.emplace(name, std::move(component));
  if (added) return "";
  return "The component is defined before (" + place->second.where + "); rename one of them.";
}

void readComponents(const ParameterList& list, const SegmentDefaults& standard,
                    const ComponentLists& lists, ComponentLibrary& library,
                    std::vector<std::string>& faults) {
  const ComponentReader reader(standard, lists);
  for (auto it = list.begin(); it != list.end(); ++it) {
    const std::string& name = list.name(it);
    if (!list.isSublist(name)) continue;
    try {
      const auto problem = addComponent(reader.read(name, list.sublist(name)), library);
      if (!problem.empty()) faults.push_back(lists.where(name) + ": " + problem);
    } catch (const DeckError& error) {
      faults.emplace_back(error.what());
    }
  }
}

}  // namespace tooljoint::drillstring
