// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drillstring/analyses/TorqueDrag.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "common/Index.hpp"
#include "common/Interrupt.hpp"
#include "common/Text.hpp"
#include "common/report/Log.hpp"
#include "deck/Defaults.hpp"
#include "deck/PrintedUnits.hpp"
#include "substructures/beam/VonMises.hpp"
#include "substructures/mud/MudModel.hpp"
#include "substructures/softstring/Buckling.hpp"
#include "substructures/softstring/Pieces.hpp"

namespace tooljoint::drillstring {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double none = std::numeric_limits<double>::quiet_NaN();
/// A depth in other units may exceed the length of the string by this fraction, due to rounding.
constexpr double roundedDepth = 1e-6;
/// Speed of operations that turn when neither list gives one [rad/s].
constexpr double usualSpeed = 120.0 * constants::rpm;
/// Time after which the start of the rotation is over [s].
constexpr double started = 1e4;
/// Relative difference between a settled speed and its mean that counts as rounding.
constexpr double steady = 1e-9;

double mudDensity(const Scene& scene) {
  return scene.list().isSublist("Mud") ? mud::readProperties(scene.list().sublist("Mud")).density
                                       : 0.0;
}

double gravityOf(const Scene& scene) { return loads::acceleration(scene.loads).z(); }

/// Largest integral of the side force over a length of the string. Points go up from the bit; the
/// force is linear between them.
Margin largestJoint(const softstring::Loads& loads, double length) {
  const std::size_t n = loads.depth.size();
  std::vector<double> sum(n, 0.0);  // from the bit up
  for (std::size_t i = 1; i < n; ++i)
    sum[i] = sum[i - 1] + 0.5 * (loads.sideForce[i - 1] + loads.sideForce[i]) *
                              (loads.depth[i - 1] - loads.depth[i]);
  Margin largest;
  std::size_t top = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double end = std::max(loads.depth[i] - length, loads.depth.back());
    while (top + 1 < n && loads.depth[top] > end) ++top;
    if (top == 0) continue;
    const double part = (loads.depth[top - 1] - end) / (loads.depth[top - 1] - loads.depth[top]);
    const double force = sum[top - 1] + part * (sum[top] - sum[top - 1]) - sum[i];
    if (force > largest.factor) largest = {force, 0.5 * (loads.depth[i] + end)};
  }
  return largest;
}

/// A depth [m] just inside the piece of the hole to which point i belongs. Curvature and radius of
/// the hole jump where two pieces meet, and both pieces have a point there.
double within(const softstring::Loads& loads, std::size_t i) {
  const bool below = i + 1 < loads.depth.size() && loads.depth[i + 1] < loads.depth[i];
  return loads.depth[i] + (below ? -softstring::inside : softstring::inside);
}

/// Depth [m] at which the compression of point i ends going up, with the tension linear to the next
/// point.
double neutralAbove(const softstring::Loads& loads, std::size_t i) {
  if (i + 1 == loads.depth.size() || loads.tension[i + 1] < 0.0) return loads.depth[i];
  const double part = loads.tension[i] / (loads.tension[i] - loads.tension[i + 1]);
  return loads.depth[i] + part * (loads.depth[i + 1] - loads.depth[i]);
}

void keepLeast(Margin& margin, double factor, double depth) {
  if (factor < margin.factor) margin = {factor, depth};
}

/// Updates the margin to yield by a section under a stress [Pa], if its strength is known.
void keepLeastYield(Margin& margin, const beam::Section& section,
                    const softstring::TorqueDragSettings& settings, double stress, double depth) {
  const auto& own = section.material().yieldStrength;
  const auto& strength = own ? own : settings.yieldStrength;
  if (strength && stress > 0.0) keepLeast(margin, *strength / stress, depth);
}

/// Longest piece over which a pipe shares the weight and contact of its tool joints [m]: a stand of
/// three pipes.
constexpr double longestStand = 30.0;

double lengthOf(const DrillString& string, const Instance& one) {
  return string.nodes[at(one.lastElement + 1)].s - string.nodes[at(one.firstElement)].s;
}

/// The piece of each element: the outermost component that contains it and is no longer than a
/// stand, or the innermost one if all are longer.
std::vector<const Instance*> pieces(const DrillString& string) {
  std::vector<const Instance*> found(string.elements.size(), nullptr);
  for (const auto* instances : {&string.instances, &string.nested})
    for (const Instance& one : *instances) {
      const auto* before = found[at(one.firstElement)];
      if (before != nullptr && lengthOf(string, *before) <= longestStand) continue;
      std::fill(found.begin() + one.firstElement, found.begin() + one.lastElement + 1, &one);
    }
  return found;
}

/// The friction factor of the touching body of a piece: its widest gauge, otherwise its widest
/// body.
double touchingFactor(const DrillString& string, const Instance& piece) {
  double widest = 0.0, factor = 1.0;
  const auto keep = [&](double radius, double own) {
    if (radius > widest) widest = radius, factor = own;
  };
  for (int e = piece.firstElement; e <= piece.lastElement; ++e) {
    const Element& element = string.elements[at(e)];
    keep(element.section().outerRadius(), element.frictionFactor);
    for (const int n : {e, e + 1})
      if (const Node& node = string.nodes[at(n)];
          node.gauge && node.contactRadius <= piece.gaugeRadius)
        keep(node.contactRadius, node.frictionFactor);
  }
  return factor;
}

/// Each element with the mean weight and the largest radius of its piece: a joint heavier than its
/// pipe does not press on the opposite side of the hole, and a pipe touches with its joints. Pieces
/// longer than a stand keep the weight of each element.
std::vector<softstring::Stretch> stretches(const Scene& scene) {
  const double gravity = gravityOf(scene), mud = mudDensity(scene);
  if (!(gravity > 0.0))
    throw DeckError(scene.deck.file() +
                    ": torque and drag needs the weight of the string. Add the list Loads, with "
                    "Gravity above 0.");
  const auto& string = scene.string;
  const auto piece = pieces(string);
  std::vector<softstring::Stretch> found;
  for (int e = 0; e < string.elementCount();) {
    const Instance& one = *piece[at(e)];
    const std::size_t first = found.size();
    double carried = 0.0, length = 0.0, widest = one.gaugeRadius;
    const double factor = touchingFactor(string, one);
    for (; e < string.elementCount() && piece[at(e)] == &one; ++e) {
      const Element& element = string.elements[at(e)];
      const auto& section = element.section();
      const double weight = (section.massPerLength() - mud * section.area()) * gravity;
      carried += weight * element.length();
      length += element.length();
      widest = std::max(widest, section.outerRadius());
      found.push_back({element.length(), section, weight, 0.0});
    }
    const bool shared = lengthOf(string, one) <= longestStand;
    for (std::size_t i = first; i < found.size(); ++i) {
      found[i].frictionRadius = widest;
      found[i].frictionFactor = factor;
      if (shared) found[i].weight = carried / length;
    }
  }
  return found;
}

softstring::Hole holeOf(const Scene& scene) {
  if (!scene.contact || !scene.list().sublist("Contact").isSublist("Friction"))
    throw DeckError(scene.deck.file() +
                    ": torque and drag needs friction between string and wall. Add the list "
                    "Contact with a list Friction.");
  softstring::Hole hole;
  const auto* well = &scene.well;
  const auto* contact = &*scene.contact;
  hole.at = [well](double s) { return well->at(s); };
  hole.radius = [well](double s) { return well->boreRadius(s); };
  hole.friction = [contact](double s) { return contact->pointAt(s, 1, 0.0, 0.0).muDynamic; };
  if (scene.list().isSublist("Mud")) {
    const auto mud = mud::readProperties(scene.list().sublist("Mud"));
    hole.mud = {mud.density, mud.frictionCoefficient, mud.flowRate, mud.axialDrag,
                mud.annularThrust};
  }
  hole.breaks = scene.well.trajectory().breaks();
  for (const auto& interval : scene.well.intervals()) {
    hole.breaks.push_back(interval.from);
    hole.breaks.push_back(interval.to);
  }
  for (const auto& interval : scene.contact->intervals) {
    hole.breaks.push_back(interval.from);
    hole.breaks.push_back(interval.to);
  }
  return hole;
}

std::vector<double> depthsOfStiffString(const softstring::TorqueDragSettings& settings) {
  using softstring::StiffDepths;
  if (settings.stiff == StiffDepths::All) return settings.depths;
  if (settings.stiff == StiffDepths::None || settings.operations.empty()) return {};
  return {*std::max_element(settings.depths.begin(), settings.depths.end())};
}

/// The first value that occurs a second time in a list; its end if there is none.
template <class T>
typename std::vector<T>::const_iterator repeated(const std::vector<T>& values) {
  return std::find_if(values.begin(), values.end(), [&](const T& value) {
    return std::count(values.begin(), values.end(), value) > 1;
  });
}

}  // namespace

Margin largestOver(double length, const std::vector<double>& depth,
                   const std::vector<double>& force) {
  Margin largest;
  double sum = 0.0;
  std::size_t end = 0;
  for (std::size_t i = 0; i < depth.size(); ++i) {
    for (; end < depth.size() && depth[end] < depth[i] + length * (1.0 - roundedDepth); ++end)
      sum += force[end];
    if (sum > largest.factor) largest = {sum, 0.5 * (depth[i] + depth[end - 1])};
    sum -= force[i];
  }
  return largest;
}

softstring::TorqueDragSettings torqueDragList(const Scene& scene) {
  const auto spec = softstring::torqueDragParameters();
  softstring::TorqueDragSettings settings;
  const bool given = scene.list().isSublist(spec.name());
  deck::withDefaults(spec, given ? scene.list().sublist(spec.name()) : Teuchos::ParameterList(),
                     [&](const auto& list) { settings = softstring::readTorqueDrag(list); });
  return settings;
}

softstring::TorqueDragSettings torqueDragSettings(const Scene& scene) {
  auto settings = torqueDragList(scene);
  if (settings.depths.empty())
    for (int i = 1; i <= settings.count; ++i)
      settings.depths.push_back(scene.string.length() * i / settings.count);
  const std::string depths = scene.deck.error("Torque and Drag/Depths", "holds");
  for (double& depth : settings.depths) depth = withinReach(scene, depth, depths);
  if (const auto twice = repeated(settings.depths); twice != settings.depths.end())
    throw DeckError(depths + " " + deck::printed(*twice, "m", 8) + " twice. Leave one out.");
  for (const char* name : {"Hook Load Uncertainty", "Torque Uncertainty"})
    if (const std::string path = std::string("Torque and Drag/") + name;
        !settings.measured && scene.deck.gives(path))
      throw DeckError(scene.deck.error(path,
                                       "is that of measurements, which are not given. Give "
                                       "Measured, or leave it out."));
  if (const auto twice = repeated(settings.operations); twice != settings.operations.end())
    throw DeckError(scene.deck.error("Torque and Drag/Operations", "holds") + " " +
                    inQuotes(*twice) + " twice. Leave one out.");
  return settings;
}

double withinReach(const Scene& scene, double bit, const std::string& where) {
  const double deepest = scene.string.length();
  if (bit > deepest * (1.0 + roundedDepth))
    throw DeckError(where + " " + deck::printed(bit, "m", 8) +
                    ", but the string of the deck ends at " + deck::printed(deepest, "m", 8) +
                    ". Give depths down to there, or a longer string.");
  return std::min(bit, deepest);
}

SoftModel softModel(const Scene& scene) { return {stretches(scene), holeOf(scene)}; }

namespace {

/// Speed of the deck's list Rotary Speed after its start, with sign; the mean if it keeps changing;
/// 0 if the list is missing or the rotation stops.
double deckSpeed(const Scene& scene) {
  if (!scene.rotary.present()) return 0.0;
  const double last = scene.rotary.speed(2.0 * started);
  if (scene.rotary.speed(started) == last && scene.rotary.acceleration(started) == 0.0) return last;
  const double mean = (scene.rotary.angle(2.0 * started) - scene.rotary.angle(started)) / started;
  return std::abs(mean - last) > steady * std::abs(last) ? mean : last;
}

}  // namespace

double turningSpeed(const Scene& scene, const softstring::TorqueDragSettings& settings) {
  const double own = std::abs(deckSpeed(scene));
  return settings.rotarySpeed.value_or(own > 0.0 ? own : usualSpeed);
}

std::vector<softstring::Operation> softOperations(const Scene& scene,
                                                  const softstring::TorqueDragSettings& settings) {
  const auto& loads = scene.list().sublist("Loads");
  // operations turn in the positive sense, so the torque of a deck that turns backward changes its
  // sign
  const double sense = deckSpeed(scene) < 0.0 ? -1.0 : 1.0;
  drilling::BitLoad bit{loads.get<double>("Weight On Bit"),
                        sense * loads.get<double>("Torque On Bit")};
  const double speed = turningSpeed(scene, settings);
  if (scene.bit) {
    const Scene drilled = turningAt(scene, speed);
    const auto steady = drilling::steadyLoad(
        drilling::bitOnString(*scene.bit, scene.string.nodeCount() - 1, drilled.rotary,
                              drilled.topDrive.blockSpeed, bit.weight),
        started);
    if (scene.bit->law->givesWeight()) bit.weight = steady.weight;
    bit.torque = steady.torque;
  }
  return softstring::operations(settings, speed, bit.weight, bit.torque);
}

TorqueDragProfile torqueDragAt(const SoftModel& model,
                               const softstring::TorqueDragSettings& settings,
                               const softstring::Operation& operation, double bit, bool allLimits) {
  const auto& hole = model.hole;
  TorqueDragProfile profile;
  profile.loads = softstring::march(model.string, hole, bit, operation, settings.helix);
  const auto& loads = profile.loads;
  const softstring::PressureDifference pressure(model.string, hole, bit, settings.pumpPressure);
  TorqueDragRow& row = profile.row;
  row.bit = bit;
  row.operation = operation.name;
  row.lockUpDepth = loads.lockUpDepth;
  const bool locked = loads.lockUpDepth >= 0.0;
  row.hookLoad = locked ? none : loads.tension.back() + settings.blockWeight;
  row.surfaceTorque = locked ? none : -loads.torque.back();
  row.twist = locked ? none : -loads.twist;
  row.stretch = locked ? none : loads.stretching;
  row.yield = row.sinusoidal = row.helical = {infinite, bit};
  row.neutralDepth = bit;
  for (std::size_t i = 0; i < loads.depth.size(); ++i) {
    const double s = loads.depth[i];
    const auto& stretch = model.string[at(loads.stretch[i])];
    const double own = within(loads, i);
    const auto point = hole.at(own);
    const double bending = stretch.section.youngModulus() * stretch.section.inertiaX();
    softstring::BucklingLimits limits{none, none};
    if (allLimits || loads.tension[i] < 0.0)
      limits = softstring::bucklingLimits(point, stretch.weight, bending,
                                          hole.radius(own) - stretch.section.outerRadius());
    profile.sinusoidal.push_back(limits.sinusoidal);
    profile.helical.push_back(limits.helical);
    profile.vonMises.push_back(beam::vonMises(stretch.section, loads.tension[i], loads.torque[i],
                                              point.curvature.norm(), pressure.at(s)));
    keepLeastYield(row.yield, stretch.section, settings, profile.vonMises.back(), s);
    if (loads.tension[i] < 0.0) {
      keepLeast(row.sinusoidal, limits.sinusoidal / -loads.tension[i], s);
      keepLeast(row.helical, limits.helical / -loads.tension[i], s);
      row.neutralDepth = neutralAbove(loads, i);
    }
    if (loads.sideForce[i] > row.largestSideForce) {
      row.largestSideForce = loads.sideForce[i];
      row.sideForceDepth = s;
    }
  }
  row.joint = largestJoint(loads, settings.jointLength);
  if (locked) {  // loads at the point of lock-up are unbounded
    row.yield = row.sinusoidal = row.helical = {infinite, bit};
    row.neutralDepth = row.largestSideForce = row.sideForceDepth = none;
    row.joint = {none, none};
  }
  return profile;
}

namespace {

/// Stresses of the elements of the stiff string, their margins to yield and to buckling, and the
/// largest force on a joint. The lower end of the stiff string is that of the soft one. A string
/// that winds on the wall beyond its helical limit has buckled.
void addStresses(const SoftModel& model, const softstring::TorqueDragSettings& settings, double bit,
                 StiffLoads& loads) {
  const softstring::PressureDifference pressure(model.string, model.hole, bit,
                                                settings.pumpPressure);
  const std::size_t count = loads.tension.size(), above = model.string.size() - count;
  loads.vonMises.clear();
  loads.yield = loads.sinusoidal = loads.helical = {infinite, 0.0};
  loads.joint = largestOver(settings.jointLength, loads.depth, loads.contactForce);
  for (std::size_t e = 0; e < count; ++e) {
    const auto& stretch = model.string[above + e];
    const auto& section = stretch.section;
    const double middle = 0.5 * (loads.depth[e] + loads.depth[e + 1]);
    loads.vonMises.push_back(
        beam::vonMises(section, loads.tension[e], loads.torque[e],
                       loads.moment[e] / (section.youngModulus() * section.inertiaX()),
                       pressure.at(std::min(bit, middle))));
    keepLeastYield(loads.yield, section, settings, loads.vonMises.back(), middle);
    if (!(loads.tension[e] < 0.0)) continue;
    const auto limits = softstring::bucklingLimits(
        model.hole.at(middle), stretch.weight, section.youngModulus() * section.inertiaX(),
        model.hole.radius(middle) - section.outerRadius());
    keepLeast(loads.sinusoidal, limits.sinusoidal / -loads.tension[e], middle);
    keepLeast(loads.helical, limits.helical / -loads.tension[e], middle);
  }
  loads.buckled = loads.buckled || (loads.turns >= 1.0 && loads.helical.factor < 1.0);
}

/// Warns of weights outside the range of the bit law.
void warnOfCalibration(const Scene& scene, const std::vector<softstring::Operation>& operations) {
  if (!scene.bit || !scene.bit->law->givesWeight()) return;
  double heaviest = 0.0;
  for (const auto& one : operations) heaviest = std::max(heaviest, one.weightOnBit);
  if (heaviest == 0.0) return;
  const auto warning =
      drilling::outsideCalibration(*scene.bit, "drilling ahead", heaviest, heaviest);
  if (!warning.empty()) log::warn(warning);
}

/// True if a registered load acts along the string in the static state.
bool actsBetween(const loads::Loads& one, const Scene& scene) {
  const auto depths = scene.string.depths();
  const auto points = loads::pointLoads(one, depths, scene.rotary);
  if (std::any_of(points.begin(), points.end(), [&](const auto& load) {
        return load.law.isOne() && load.value != 0.0 && load.node < static_cast<int>(depths.size());
      }))
    return true;
  for (std::size_t e = 0; e < scene.string.elements.size(); ++e) {
    const auto& section = scene.string.elements[e].section();
    const Matrix3 triad = Matrix3::Identity();
    const loads::LoadedElement element{section, triad, depths[e], depths[e + 1]};
    if (loads::steadyBesideWeight(one, element, scene.rotary).norm() >
        1e-9 * section.massPerLength())
      return true;
  }
  return false;
}

void warnOfForces(const Scene& scene) {
  const std::string without =
      "is not part of torque and drag, which considers the weight of the string, the bit and the "
      "wall.";
  for (const auto& load : scene.loads) {
    if (!load->list().empty()) {
      log::warn(scene.deck.error(load->list(), without));
      continue;
    }
    if (!actsBetween({load}, scene)) continue;
    const auto remarks = load->describe(scene.rotary);
    log::warn("The load \"" + (remarks.empty() ? "of a kind of its own" : remarks.front().load) +
              "\" " + without);
  }
}

}  // namespace

std::vector<TorqueDragProfile> torqueDrag(const Scene& scene, const cases::RowFolder& store) {
  const auto settings = torqueDragSettings(scene);
  const SoftModel model = softModel(scene);
  const auto operations = softOperations(scene, settings);
  warnOfCalibration(scene, operations);
  warnOfForces(scene);
  std::vector<TorqueDragProfile> profiles;
  const double deepest = *std::max_element(settings.depths.begin(), settings.depths.end());
  for (const double depth : settings.depths)
    for (const auto& operation : operations) {
      if (interruptRequested()) throw InterruptedError("Interrupted.");
      profiles.push_back(torqueDragAt(model, settings, operation, depth, depth == deepest));
    }

  const auto stiffDepths = depthsOfStiffString(settings);
  const auto rows = stiffRows(scene, stiffDepths, operations, store);
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t k = 0; k < operations.size(); ++k)
      for (auto& profile : profiles)
        if (profile.row.bit == stiffDepths[i] && profile.row.operation == operations[k].name) {
          profile.stiff = rows[i][k];
          addStresses(model, settings, stiffDepths[i], *profile.stiff);
        }
  return profiles;
}

}  // namespace tooljoint::drillstring
