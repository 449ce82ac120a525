// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drillstring/Mesh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <utility>

#include "common/Error.hpp"
#include "common/Index.hpp"
#include "common/Text.hpp"
#include "common/report/Log.hpp"

namespace tooljoint::drillstring {
namespace {

/// Positions along the string closer than this are the same [m].
constexpr double samePlace = 1e-6;

/// A body or gauge with less clearance than this does not fit [m]. A negative clearance above it is
/// rounding and counts as zero.
constexpr double tightFit = -1e-9;

/// Shortest remainder of an element cut at the surface, as a fraction of its length. A shorter one
/// would be much stiffer than its neighbours and is merged with the next element.
constexpr double shortestRest = 0.1;

/// A string with more elements than this is rejected; the repeat count is probably wrong.
constexpr int mostElements = 200000;

/// Largest number of printed faults: the faults of a component recur in every stand of the string.
constexpr std::size_t mostFaults = 10;

/// Largest number of components named in a message.
constexpr std::size_t mostNames = 12;

/// "diameter" or "radius", whichever the deck uses.
std::string across(const deck::Given& given) {
  return given.name.find("Diameter") == std::string::npos ? "radius" : "diameter";
}

/// A place on one occurrence of a component.
struct Place {
  double s;  ///< [m]
  const Component* component;
  double position;  ///< from the top of its component [m]
  int firstNode, lastNode;
};

class Mesher {
 public:
  Mesher(const ComponentLibrary& library, const well::Well& well, std::string where,
         std::optional<double> bit)
      : library_(library), well_(well), where_(std::move(where)), bit_(bit) {}

  DrillString mesh(const std::vector<AssemblyEntry>& assembly) {
    out_.nodes.emplace_back();
    std::map<std::string, int> occurrences;
    for (const AssemblyEntry& entry : assembly) placeAll(entry, "", occurrences, where_);
    if (faults_.empty() && out_.elements.empty())
      fault(where_, "The assembly is empty; it needs at least one component.");
    if (faults_.empty() && bit_) cutAtSurface(out_.length() - *bit_);
    if (faults_.empty()) {
      checkLength();
      setClearances();
      setGauges();
      setBends();
      setPads();
      warnOfUnseenBores();
    }
    if (!faults_.empty()) throw DeckError(firstLines(faults_, mostFaults, where_));
    return std::move(out_);
  }

 private:
  void fault(const std::string& where, const std::string& sentence) {
    const std::string line = where + ": " + sentence;
    if (std::find(faults_.begin(), faults_.end(), line) == faults_.end()) faults_.push_back(line);
  }

  /// Appends every occurrence of an entry; ends at the first fault, since the other occurrences
  /// would only repeat it.
  bool placeAll(const AssemblyEntry& entry, const std::string& parent,
                std::map<std::string, int>& occurrences, const std::string& where) {
    for (int i = 0; i < entry.count; ++i)
      if (!place(entry.name, parent, occurrences, where)) return false;
    return true;
  }

  /// Appends one occurrence of a component. `parent` is the path that contains it, `where` the
  /// array that names it. False after a fault.
  bool place(const std::string& name, const std::string& parent,
             std::map<std::string, int>& occurrences, const std::string& where) {
    const auto found = library_.find(name);
    if (found == library_.end()) {
      fault(where, unknown(name));
      return false;
    }
    const Component& component = found->second;
    if (std::find(stack_.begin(), stack_.end(), name) != stack_.end()) {
      fault(component.where,
            "The component contains itself (" + join(stack_, " > ") + " > " + name + ").");
      return false;
    }
    if (out_.elementCount() > mostElements) {
      fault(where_, "The string has more than " + std::to_string(mostElements) +
                        " elements; check the repeat counts and the "
                        "length of elements.");
      return false;
    }
    const bool top = parent.empty();
    Instance instance;
    instance.component = name;
    instance.path = parent + name + " " + std::to_string(++occurrences[name]);
    instance.firstElement = out_.elementCount();
    const double start = out_.nodes.back().s;
    if (top) out_.instances.emplace_back();
    const std::size_t slot = out_.nested.size();
    if (!top) out_.nested.emplace_back();
    stack_.push_back(name);
    for (const Segment& segment : component.segments) append(segment, component.where);
    std::map<std::string, int> inner;
    bool good = true;
    for (const AssemblyEntry& entry : component.parts)
      good = placeAll(entry, instance.path + "/", inner, component.where + "/Parts") && good;
    stack_.pop_back();
    instance.lastElement = out_.elementCount() - 1;
    const auto on = [&](double position) {
      return Place{start + position, &component, position, instance.firstElement,
                   out_.elementCount()};
    };
    if (component.gaugePosition) gauges_.push_back(on(*component.gaugePosition));
    if (component.bend) bends_.push_back(on(component.bend->position));
    if (component.pad) pads_.push_back(on(component.pad->position));
    if (top)
      out_.instances.back() = instance;
    else
      out_.nested[slot] = instance;
    return good;
  }

  /// Names of the library that share a word of three letters or more with this one.
  static std::vector<std::string> alike(const std::string& name,
                                        const std::vector<std::string>& names) {
    std::vector<std::string> found;
    const auto words = split(lower(name), ' ');
    for (const auto& known : names)
      if (std::any_of(words.begin(), words.end(), [&](const std::string& word) {
            return word.size() > 2 && lower(known).find(word) != std::string::npos;
          }))
        found.push_back(known);
    return found;
  }

  std::string unknown(const std::string& name) const {
    std::vector<std::string> names;
    for (const auto& entry : library_) names.push_back(entry.first);
    const std::string sentence = "The component " + inQuotes(name) + " is not defined.";
    const std::string meant = closest(name, names);
    if (!meant.empty()) return sentence + " Did you mean " + inQuotes(meant) + "?";
    if (names.empty())
      return sentence + " No components are defined: give a Library or the list Components.";
    const auto few = alike(name, names);
    if (few.empty() && names.size() > mostNames)
      return sentence + " None of the " + std::to_string(names.size()) +
             " known ones has such a name: describe it in Drillstring/Components.";
    auto listed = few.empty() ? names : few;
    const auto more = listed.size() - std::min(listed.size(), mostNames);
    listed.resize(listed.size() - more);
    return sentence + (few.empty() ? " Known are " : " Known with such a name are ") +
           quotedList(listed) + (more > 0 ? " and " + std::to_string(more) + " more." : ".");
  }

  /// All elements of a segment are equal and share one formulation.
  void append(const Segment& segment, const std::string& where) {
    std::shared_ptr<const beam::Element> formulation;
    try {
      formulation = segment.element.make(segment.section, segment.length / segment.elements);
    } catch (const DeckError& error) {
      fault(where, error.what());
      return;
    }
    const double start = out_.nodes.back().s;
    for (int i = 1; i <= segment.elements; ++i) {
      Node node;
      node.s = start + segment.length * i / segment.elements;
      out_.nodes.push_back(node);
      out_.elements.push_back(
          {formulation, static_cast<int>(out_.instances.size()) - 1, segment.frictionFactor});
      segments_.push_back(&segment);
    }
  }

  /// Removes the upper `above` [m] of the string, the part above the surface.
  void cutAtSurface(double above) {
    if (above < samePlace) return;
    int first = 0;
    const auto left = [&](int e) { return out_.nodes[at(e + 1)].s - above; };
    while (first + 1 < out_.elementCount() &&
           left(first) < shortestRest * out_.elements[at(first)].length())
      ++first;
    const Segment& cut = *segments_[at(first)];
    out_.elements[at(first)].formulation = cut.element.make(cut.section, left(first));

    // A remainder too short for an element is merged with the next one; the node between them is
    // removed.
    const double joined = std::max(0.0, out_.nodes[at(first)].s - above);
    out_.elements.erase(out_.elements.begin(), out_.elements.begin() + first);
    out_.nodes.erase(out_.nodes.begin(), out_.nodes.begin() + first);
    for (Node& node : out_.nodes) node.s -= above;
    out_.nodes.front().s = 0.0;
    const auto gone = cutInstances(out_.instances, first);
    for (Element& element : out_.elements) element.instance -= gone;
    cutInstances(out_.nested, first);
    for (auto* places : {&gauges_, &bends_, &pads_}) cutPlaces(*places, above, first, joined);
  }

  /// Removes places down to `joined` [m], whose node no longer exists.
  static void cutPlaces(std::vector<Place>& places, double above, int removed, double joined) {
    for (Place& place : places) {
      place.s -= above;
      place.firstNode = std::max(0, place.firstNode - removed);
      place.lastNode -= removed;
    }
    places.erase(std::remove_if(places.begin(), places.end(),
                                [&](const Place& place) { return place.s < joined + samePlace; }),
                 places.end());
  }

  /// Returns the number of removed instances, those above the surface.
  static int cutInstances(std::vector<Instance>& instances, int removed) {
    const auto below = std::find_if(instances.begin(), instances.end(), [&](const Instance& one) {
      return one.lastElement >= removed;
    });
    const auto gone = static_cast<int>(below - instances.begin());
    instances.erase(std::remove_if(instances.begin(), instances.end(),
                                   [&](const Instance& one) { return one.lastElement < removed; }),
                    instances.end());
    for (Instance& one : instances) {
      one.firstElement = std::max(0, one.firstElement - removed);
      one.lastElement -= removed;
    }
    return gone;
  }

  /// A component with segments: this one, or the first one inside it.
  const Component& solid(const std::string& name) const {
    const Component& component = library_.at(name);
    return component.parts.empty() ? component : solid(component.parts.front().name);
  }

  void checkLength() {
    const auto& length = solid(out_.instances.front().component).length;
    if (out_.length() > well_.length() + samePlace)
      fault(where_, "The string is " + length.text(out_.length()) + " long, but the well ends at " +
                        length.text(well_.length()) +
                        ". Shorten the string or lengthen the well. It is " +
                        length.text(out_.length() - well_.length()) + " too long.");
  }

  /// The smaller clearance of both sides of a node; the bore is evaluated slightly inside the
  /// element.
  void setClearances() {
    for (int i = 0; i < out_.nodeCount(); ++i) {
      Node& node = out_.nodes[static_cast<std::size_t>(i)];
      bool first = true;
      for (const int e : {i - 1, i}) {
        if (e < 0 || e >= out_.elementCount()) continue;
        const Element& element = out_.elements[static_cast<std::size_t>(e)];
        if (first)
          node.component = out_.instances[static_cast<std::size_t>(element.instance)].component;
        const double bore = well_.boreRadius(node.s + (e < i ? -samePlace : samePlace));
        const double clearance = bore - element.section().outerRadius();
        if (clearance < tightFit) tooWide(i, element, bore);
        if (first || clearance < node.clearance) {
          node.clearance = std::max(0.0, clearance);
          node.contactRadius = element.section().outerRadius();
          node.frictionFactor = element.frictionFactor;
        }
        first = false;
      }
    }
  }

  void tooWide(int node, const Element& element, double bore) {
    const Instance& instance = out_.instances[static_cast<std::size_t>(element.instance)];
    if (!tooWide_.insert(element.instance).second) return;  // one line per occurrence
    const Component& own = solid(instance.component);
    fault(library_.at(instance.component).where,
          "The " + own.outer.name + " of " + instance.path + ", " +
              own.outer.text(element.section().outerRadius()) + ", does not fit into the hole of " +
              across(own.outer) + " " + own.outer.text(bore) + " at " +
              own.length.text(out_.nodes[at(node)].s) + " (node " + std::to_string(node + 1) +
              ").");
  }

  void setGauges() {
    for (const Place& place : gauges_) {
      const int at = nodeAt(place, "Gauge Position");
      if (at >= 0) setGauge(place, at);
    }
  }

  void setGauge(const Place& place, int index) {
    const Component& gauge = *place.component;
    Node& node = out_.nodes[at(index)];
    const double bore =
        std::min(well_.boreRadius(node.s - samePlace), well_.boreRadius(node.s + samePlace));
    const double clearance = bore - gauge.gaugeRadius;
    const deck::Given& given = gauge.gauge;
    const std::string gaugeText = "The " + given.name + " " + given.text(gauge.gaugeRadius) + " ",
                      depth = solid(gauge.name).length.text(node.s);
    if (clearance < tightFit)
      fault(gauge.where, gaugeText + "does not fit into the hole of " + across(given) + " " +
                             given.text(bore) + " at " + depth + " (node " +
                             std::to_string(index + 1) + ").");
    const double body = bodyRadius(place, index), reach = gauge.gaugeRadius + gauge.gaugeOffset;
    if (reach < body + tightFit)
      fault(gauge.where, gaugeText + "is below the outer " + across(given) + " of the body at " +
                             depth + ", " + given.text(body) + ", so it would never touch.");
    const deck::Given radius{"", given.unit,
                             given.name == "Gauge Radius" ? given.factor : 2.0 * given.factor};
    if (gauge.gaugeOffset > bore)
      fault(gauge.where, "The Gauge Offset " + radius.text(gauge.gaugeOffset) +
                             " is above the radius of the hole, " + radius.text(bore) +
                             ". Give the distance between the centres of gauge and string.");
    const int own = index < place.lastNode ? index : index - 1;
    for (auto* instances : {&out_.instances, &out_.nested})
      for (Instance& one : *instances)
        if (one.firstElement <= own && own <= one.lastElement)
          one.gaugeRadius = std::max(one.gaugeRadius, gauge.gaugeRadius);
    if (reach < node.contactRadius + tightFit) return;  // the next body is wider and touches first
    node.clearance = std::max(0.0, clearance);
    node.contactRadius = gauge.gaugeRadius;
    node.frictionFactor = out_.elements[at(own)].frictionFactor;
    node.gauge = true;
    node.component = gauge.name;
    if (gauge.gaugeOffset > 0.0)
      out_.eccentricGauges.push_back({index, gauge.gaugeOffset, gauge.gaugeDirection});
  }

  /// Outer radius of the component of a place beside its node [m].
  double bodyRadius(const Place& place, int node) const {
    double radius = 0.0;
    for (const int e : {node - 1, node})
      if (e >= place.firstNode && e < place.lastNode)
        radius = std::max(radius, out_.elements[at(e)].section().outerRadius());
    return radius;
  }

  void setBends() {
    for (const Place& place : bends_) {
      const int at = nodeAt(place, "Bend/Position");
      if (at < 0) continue;
      if (at == 0 || at == out_.elementCount())
        fault(place.component->where,
              "The bend is at an end of the string, where it has no effect. Give a Position above "
              "the bit and below the top.");
      out_.bends.push_back({at, place.component->bend->size, place.component->bend->direction});
    }
  }

  void setPads() {
    for (const Place& place : pads_) {
      const int at = nodeAt(place, "Pad/Position");
      if (at >= 0)
        out_.pads.push_back({at, place.component->pad->size, place.component->pad->direction});
    }
  }

  /// The node at a place (0-based); a fault and -1 when there is none.
  int nodeAt(const Place& place, const char* parameter) {
    const double start = place.s - place.position;
    double nearest = 0.0;
    double distance = std::numeric_limits<double>::infinity();
    for (int i = place.firstNode; i <= place.lastNode; ++i) {
      const double s = out_.nodes[static_cast<std::size_t>(i)].s;
      if (std::abs(s - place.s) < samePlace) return i;
      if (std::abs(s - place.s) >= distance) continue;
      distance = std::abs(s - place.s);
      nearest = s - start;
    }
    const auto& length = solid(place.component->name).length;
    fault(place.component->where,
          std::string("The ") + parameter + " " + length.text(place.position) +
              " is not at a node of the component; the nearest is at " + length.text(nearest) +
              ". Move it or change the number of Elements.");
    return -1;
  }

  void warnOfUnseenBores() const {
    for (const well::BoreInterval& interval : well_.intervals()) {
      if (interval.from > out_.length()) continue;
      const bool seen = std::any_of(out_.nodes.begin(), out_.nodes.end(), [&](const Node& node) {
        return node.s >= interval.from - samePlace && node.s <= interval.to + samePlace;
      });
      if (!seen)
        log::warn("No node of the string lies in the bore interval " + inQuotes(interval.name) +
                  ", so the interval has no effect on contact. Use shorter elements there.");
    }
  }

  const ComponentLibrary& library_;
  const well::Well& well_;
  std::string where_;
  std::optional<double> bit_;  ///< depth of the lower end; none: the whole assembly hangs
  DrillString out_;
  std::vector<const Segment*> segments_;  ///< of each element
  std::vector<Place> gauges_, bends_, pads_;
  std::vector<std::string> stack_;
  std::vector<std::string> faults_;
  std::set<int> tooWide_;
};

}  // namespace

DrillString buildDrillString(const ComponentLibrary& library,
                             const std::vector<AssemblyEntry>& assembly, const well::Well& well,
                             const std::string& assemblyWhere, std::optional<double> bit) {
  return Mesher(library, well, assemblyWhere, bit).mesh(assembly);
}

}  // namespace tooljoint::drillstring
