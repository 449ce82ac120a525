// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drillstring/analyses/bottom_hole/BottomHole.hpp"

#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "common/Index.hpp"
#include "common/Text.hpp"
#include "deck/Defaults.hpp"
#include "deck/PrintedUnits.hpp"
#include "substructures/drillstring/ContactNodes.hpp"
#include "substructures/drillstring/analyses/bottom_hole/BottomHoleState.hpp"
#include "substructures/drillstring/assembly/DrillstringReader.hpp"
#include "substructures/drillstring/scene/Stages.hpp"
#include "substructures/well/ArcChain.hpp"
#include "substructures/well/Frames.hpp"

namespace tooljoint::drillstring {
namespace {

const std::string here = "Bottom-Hole Assembly";

/// The cut is held on the axis of the hole; the tilt is free.
constexpr DofFlags heldAtCut = {true, true, true, false, false, true};

/// Largest number of elements of a segment, as in the deck.
constexpr double mostPieces = 10000;

/// The whole string with elements of at most this length [m]. Nodes of the deck remain.
DrillString divided(const Scene& scene, double longest) {
  auto settings = readDrillstring(scene.deck);
  for (auto& [name, component] : settings.library)
    for (auto& segment : component.segments) {
      constexpr double rounding = 1e-9;
      const double pieces = segment.length / segment.elements / longest;
      if (pieces * segment.elements > mostPieces)
        throw DeckError(scene.deck.error(here + "/Element Length", "is") + " " +
                        deck::printed(longest, "m") + ", which cuts " +
                        deck::printed(segment.length, "m") + " of " + inQuotes(name) + " into " +
                        countText(pieces * segment.elements) + " elements; at most " +
                        countText(mostPieces) + " are possible. Give a longer one.");
      segment.elements *= std::max(1, static_cast<int>(std::ceil(pieces - rounding)));
    }
  return buildDrillString(settings, scene.well);
}

/// Features at nodes from `first` on (0-based), renumbered from there.
std::vector<SidedNode> lowerNodes(const std::vector<SidedNode>& all, int first, double turned) {
  std::vector<SidedNode> lower;
  for (const auto& one : all)
    if (one.node > first) lower.push_back({one.node - first, one.size, one.direction + turned});
  return lower;
}

std::vector<Instance> lowerInstances(const std::vector<Instance>& all, int first) {
  std::vector<Instance> lower;
  for (auto one : all) {
    if (one.lastElement < first) continue;
    one.firstElement = std::max(0, one.firstElement - first);
    one.lastElement -= first;
    lower.push_back(one);
  }
  return lower;
}

/// The string from the node `first` on (0-based); bends and eccentric gauges are turned, pads are
/// not.
DrillString lowerString(const DrillString& whole, int first, double turned) {
  DrillString lower;
  lower.nodes.assign(whole.nodes.begin() + first, whole.nodes.end());
  const double top = lower.nodes.front().s;
  for (auto& node : lower.nodes) node.s -= top;
  lower.instances = lowerInstances(whole.instances, first);
  lower.nested = lowerInstances(whole.nested, first);
  lower.elements.assign(whole.elements.begin() + first, whole.elements.end());
  const auto gone = static_cast<int>(whole.instances.size() - lower.instances.size());
  for (auto& element : lower.elements) element.instance -= gone;
  lower.bends = lowerNodes(whole.bends, first, turned);
  lower.eccentricGauges = lowerNodes(whole.eccentricGauges, first, turned);
  lower.pads = lowerNodes(whole.pads, first, 0.0);
  return lower;
}

/// Hole of constant curvature kappa = B h + T sin(I) r that ends at this inclination I and azimuth.
/// Above the end, t(-x) = t cos(kappa x) - n sin(kappa x).
std::shared_ptr<const well::Trajectory> arcTo(double inclination, double azimuth,
                                              const BottomHoleSettings& settings, double length) {
  const Vector3 tangent = well::direction(inclination, azimuth);
  const Vector3 high{std::cos(inclination) * std::cos(azimuth),
                     std::cos(inclination) * std::sin(azimuth), -std::sin(inclination)};
  const Vector3 curvature =
      settings.buildRate * high + settings.turnRate * std::sin(inclination) * tangent.cross(high);
  const double turn = curvature.norm() * length;
  if (!(turn < constants::pi / 2.0))
    throw DeckError("The hole of " + here + "/Inclination turns by " +
                    formatNumber(std::round(turn / constants::degree)) + " deg over the " +
                    formatNumber(length) +
                    " m modelled above the bit, more than 90 deg. Give smaller rates, or a smaller "
                    "Length.");
  const Vector3 start =
      turn > 0.0 ? Vector3(std::cos(turn) * tangent - std::sin(turn) * curvature.normalized())
                 : tangent;
  auto chain = std::make_shared<well::ArcChain>(start);
  if (turn > 0.0)
    chain->addArc(length, tangent);
  else
    chain->addStraight(length);
  return chain;
}

/// Weight on bit and torque of the deck; loads with their own position or time dependence are
/// omitted.
loads::Loads loadsWith(const Scene& scene, double weight) {
  Teuchos::ParameterList list = scene.list().sublist("Loads");
  list.set("Weight On Bit", weight);
  list.remove("Unbalance", false);
  return loads::readLoads(list);
}

std::shared_ptr<const mud::MudModel> mudAtRest(const Scene& scene) {
  if (!scene.mud) return nullptr;
  Teuchos::ParameterList list = scene.list().sublist("Mud");
  list.set("Flow Rate", 0.0);
  return mud::readMud(list);
}

void refuse(const Scene& scene, const std::string& path, const std::string& sentence) {
  throw DeckError(scene.deck.error(path, sentence));
}

void requireWithin(const Scene& scene, const std::string& name, std::optional<double> length,
                   double whole) {
  if (length && *length > whole)
    refuse(scene, here + "/" + name,
           "is " + deck::printed(*length, "m", 8) + " above the bit, but the string is " +
               deck::printed(whole, "m", 8) + " long. Give a distance on the string.");
}

/// Checks of the list alone.
void requireSense(const Scene& scene, const BottomHoleSettings& settings, double whole) {
  requireWithin(scene, "Length", settings.length, whole);
  requireWithin(scene, "Survey Tool", settings.surveyTool, whole);
  if (settings.length && settings.surveyTool && *settings.surveyTool > *settings.length)
    refuse(scene, here + "/Survey Tool",
           "is " + formatNumber(*settings.surveyTool) + " m above the bit, beyond the Length of " +
               formatNumber(*settings.length) + " m that is modelled. Give a larger Length.");
  for (const char* rate : {"Build Rate", "Turn Rate"})
    if (settings.inclinations.empty() && scene.deck.gives(here + "/" + rate))
      refuse(scene, here + "/" + rate,
             "applies to the holes of Inclination, which is not given: the hole is that of the "
             "list Well. Give Inclination, or leave it out.");
}

void check(const Scene& scene) {
  if (!scene.contact)
    throw DeckError(
        scene.deck.file() +
        ": a bottom-hole assembly needs contact with the wall of the hole. Add the list Contact.");
  if (!scene.list().isSublist("Loads"))
    throw DeckError(scene.deck.file() +
                    ": a bottom-hole assembly needs its weight. Add the list Loads, with Gravity "
                    "above 0.");
  if (!(loads::acceleration(scene.loads).norm() > 0.0))
    refuse(scene, "Loads/Gravity",
           "is 0, but a bottom-hole assembly needs its weight. Give 9.81 m/s2.");
  if (!scene.supports.lateral || !scene.supports.axial)
    refuse(scene, "Supports/Dofs",
           "leaves out dofs that a bottom-hole assembly needs: lateral and axial. Add them.");
  if (!scene.supports.named.empty())
    refuse(scene, "Supports",
           "holds node " + std::to_string(scene.supports.named.front().node) +
               ", which `tooljoint bha` does not support: it remeshes the string and models its "
               "lower part only. Hold Top and Bit only.");
  if (scene.list().sublist("Loads").isSublist("Forces"))
    refuse(scene, "Loads/Forces",
           "acts at numbered nodes, and `tooljoint bha` renumbers the nodes. Give a component a "
           "Pad instead.");
}

}  // namespace

BottomHoleSettings bottomHoleSettings(const Scene& scene) {
  const auto spec = bottomHoleParameters();
  BottomHoleSettings settings;
  const bool given = scene.list().isSublist(spec.name());
  deck::withDefaults(spec, given ? scene.list().sublist(spec.name()) : Teuchos::ParameterList(),
                     [&](const auto& list) { settings = readBottomHole(list); });
  if (settings.weights.empty()) settings.weights = {scene.weightOnBit()};
  if (settings.toolFaces.empty()) settings.toolFaces = {scene.string.toolFace};
  requireSense(scene, settings, scene.string.length());
  return settings;
}

BottomHole::BottomHole(const Scene& scene, const BottomHoleSettings& settings)
    : scene_(scene), settings_(settings) {
  check(scene);
  string_ = divided(scene, settings.elementLength);
}

int BottomHole::topNode(double length) const {
  const auto depths = string_.depths();
  constexpr double samePlace = 1e-6;  // [m]
  const auto below =
      std::upper_bound(depths.begin(), depths.end(), depths.back() - length + samePlace);
  return std::max(0, static_cast<int>(below - depths.begin()) - 1);
}

bool BottomHole::turns(double length) const {
  const auto inside = [top = topNode(length)](const SidedNode& one) { return one.node > top; };
  return std::any_of(string_.bends.begin(), string_.bends.end(), inside) ||
         std::any_of(string_.eccentricGauges.begin(), string_.eccentricGauges.end(), inside);
}

Scene BottomHole::lowerPart(const BottomHolePoint& point, double length, double turned) const {
  const int first = topNode(length);
  const double top = string_.nodes[at(first)].s;
  Scene part = scene_;
  part.string = lowerString(string_, first, turned);
  part.string.toolFace = point.toolFace;
  const Vector3 bit = scene_.well.at(string_.length()).tangent;
  part.well = point.inclination
                  ? scene_.well.below(top, arcTo(*point.inclination, std::atan2(bit.y(), bit.x()),
                                                 settings_, part.string.length()))
                  : scene_.well.below(top);
  part.supports.top = heldAtCut;
  part.held = heldDofs(part.supports, part.string);
  for (auto& interval : part.contact->intervals) interval.from -= top, interval.to -= top;
  part.contactPoints = contactPoints(*part.contact, part.string, part.held);
  part.loads = loads::below(loadsWith(scene_, point.weight), top);
  part.mud = mudAtRest(scene_);
  part.rotary = {};
  part.damping = {};
  part.statics.friction = equilibrium::FrictionRule::None;
  part.path.mode = path::Mode::CentreLine;
  part.coupling.reset();
  part.bit.reset();
  part.topDrive = {};
  return part;
}

BottomHoleState BottomHole::solve(const BottomHolePoint& point, double length,
                                  double turned) const {
  const Scene part = lowerPart(point, length, turned);
  return bottomHoleState(part, findEquilibrium(part), settings_.surveyTool);
}

BottomHoleState BottomHole::rotating(const BottomHolePoint& point, double length) const {
  const int count = settings_.rotatingToolFaces;
  BottomHoleState sum;
  for (int i = 0; i < count; ++i) {
    const auto one = solve(point, length, constants::twoPi * i / count);
    if (i == 0)
      sum = one;
    else
      addState(one, sum);
  }
  divideState(count, sum);
  return sum;
}

}  // namespace tooljoint::drillstring
