// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/loads/Loads.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "common/Text.hpp"
#include "common/report/EvaluationCounters.hpp"
#include "common/report/Log.hpp"

namespace tooljoint::loads {
namespace {

using Teuchos::ParameterList;

using constants::twoPi;
constexpr double nodeTolerance = 1e-6;  // m

const std::vector<std::string>& componentNames() {
  static const std::vector<std::string> names{"u", "v", "w", "theta_x", "theta_y", "theta_z"};
  return names;
}

deck::ListSpec unbalanceParameters() {
  using deck::Range;
  deck::ListSpec entry("Unbalance", "One mass off the axis; the name is free.");
  entry
      .integer("Node", deck::Optional{}, Range::atLeast(1),
               "Node that carries it, counted from 1 at the surface; give this or Position.")
      .real("Position", "m", deck::Optional{}, Range::nonNegative(),
            "Measured depth of the node that carries it; give this or Node.")
      .real("Mass", "kg", deck::Optional{}, Range::positive(),
            "Mass off the axis; together with Eccentricity.")
      .real("Eccentricity", "m", deck::Optional{}, Range::nonNegative(),
            "Distance of the mass from the axis; together with Mass.")
      .real("Moment", "kg m", deck::Optional{}, Range::nonNegative(),
            "Mass times eccentricity; give this, or Mass and Eccentricity.")
      .real("Phase", "rad", 0.0, Range::any(), "Angle of the mass from local x at time 0.");
  return deck::ListSpec("Unbalance",
                        "Mass unbalances that turn with the rotary speed, one list each.")
      .namedLists(entry);
}

deck::ListSpec forceParameters() {
  using deck::Range;
  deck::ListSpec entry("Force", "One force or torque at a node; the name is free.");
  entry
      .integer("Node", deck::Optional{}, Range::atLeast(1),
               "Node it acts on, counted from 1 at the surface; give this or Position.")
      .real("Position", "m", deck::Optional{}, Range::nonNegative(),
            "Measured depth of the node it acts on; give this or Node.")
      .choice("Component", deck::Required{}, componentNames(),
              "Direction in the nodal frame: z along the well, positive down the hole.")
      .real("Value", "N or N m", deck::Required{}, Range::any(),
            "Force, or torque about a rotation component.")
      .unitBy("Component",
              [](const std::string& component) {
                return component.rfind("theta", 0) == 0 ? "N m" : "N";
              })
      .real("Frequency", "Hz", 0.0, Range::nonNegative(),
            "Frequency of a harmonic load Value cos(2 pi Frequency t + Phase); 0 for a steady one.")
      .real("Phase", "rad", 0.0, Range::any(),
            "Phase of a harmonic load; has no effect on a steady one.")
      .real("Start Time", "s", 0.0, Range::nonNegative(),
            "Time from which it acts; one that acts from 0 on and is steady acts in the static "
            "state too.")
      .real("End Time", "s", deck::Optional{}, Range::positive(),
            "Time from which it acts no more; never when not given.");
  return deck::ListSpec("Forces", "Forces and torques at nodes, one list each.").namedLists(entry);
}

Place readPlace(const ParameterList& list, const std::string& who) {
  Place place;
  if (list.isParameter("Node")) place.node = list.get<int>("Node");
  if (list.isParameter("Position")) place.position = list.get<double>("Position");
  if (place.node.has_value() == place.position.has_value()) {
    throw DeckError(who + " needs either Node or Position, not " +
                    (place.node ? "both." : "none of them."));
  }
  return place;
}

Unbalance readUnbalance(const ParameterList& list, const std::string& name) {
  const std::string who = "Loads/Unbalance/" + name;
  const bool moment = list.isParameter("Moment");
  const bool mass = list.isParameter("Mass");
  const bool eccentricity = list.isParameter("Eccentricity");
  if (mass != eccentricity || moment == mass) {
    throw DeckError(who + " needs either Moment, or both Mass and Eccentricity.");
  }
  Unbalance u;
  u.name = name;
  u.place = readPlace(list, who);
  u.moment = moment ? list.get<double>("Moment")
                    : list.get<double>("Mass") * list.get<double>("Eccentricity");
  u.phase = list.get<double>("Phase");
  return u;
}

NodalForce readForce(const ParameterList& list, const std::string& name) {
  const std::string who = "Loads/Forces/" + name;
  NodalForce f;
  f.name = name;
  f.place = readPlace(list, who);
  const auto& names = componentNames();
  f.component = static_cast<int>(
      std::find(names.begin(), names.end(), list.get<std::string>("Component")) - names.begin());
  f.value = list.get<double>("Value");
  f.frequency = list.get<double>("Frequency");
  f.phase = list.get<double>("Phase");
  f.startTime = list.get<double>("Start Time");
  f.endTime = list.isParameter("End Time") ? list.get<double>("End Time")
                                           : std::numeric_limits<double>::infinity();
  if (!(f.endTime > f.startTime))
    throw DeckError(who + " ends (End Time) before it starts (Start Time).");
  return f;
}

/// The law of a nodal force. Equal numbers give equal names, so that equal laws are one law.
model::ScalarLaw lawOf(const NodalForce& force) {
  const bool windowed = force.startTime > 0.0 || std::isfinite(force.endTime);
  if (force.frequency == 0.0 && !windowed) return model::ScalarLaw::one();
  std::string name = "1";
  if (force.frequency != 0.0)
    name = "cos(2 pi " + formatNumber(force.frequency) + " t + " + formatNumber(force.phase) + ")";
  if (windowed)
    name +=
        " from " + formatNumber(force.startTime) + " s to " + formatNumber(force.endTime) + " s";
  const double pulsation = twoPi * force.frequency;
  const double phase = force.frequency == 0.0 ? 0.0 : force.phase;
  return {name, [pulsation, phase, start = force.startTime, end = force.endTime](double t) {
            return t >= start && t < end ? std::cos(pulsation * t + phase) : 0.0;
          }};
}

void addUnbalances(std::vector<PointLoad>& out, const LoadsData& loads, const RotarySpeed& rotary,
                   const std::vector<double>& arcLength) {
  if (loads.unbalances.empty()) return;
  if (!rotary.present()) {
    log::warn(
        "The deck has mass unbalances but no list \"Rotary Speed\": nothing turns, so they load "
        "nothing and are left out.");
    return;
  }
  // With A = Omega^2 cos Phi + dOmega/dt sin Phi, B = Omega^2 sin Phi - dOmega/dt cos Phi and phi =
  // Phi + phi_0: F_x = m e (A cos phi_0 - B sin phi_0), F_y = m e (A sin phi_0 + B cos phi_0)
  const model::ScalarLaw a = rotary.scalar(unbalanceCosine);
  const model::ScalarLaw b = rotary.scalar(unbalanceSine);
  for (const auto& u : loads.unbalances) {
    const int node = nodeOf(u.place, arcLength, "Loads/Unbalance/" + u.name);
    const double c = u.moment * std::cos(u.phase);
    const double s = u.moment * std::sin(u.phase);
    out.push_back({"unbalance", node, 0, c, a});
    out.push_back({"unbalance", node, 0, -s, b});
    out.push_back({"unbalance", node, 1, s, a});
    out.push_back({"unbalance", node, 1, c, b});
    count("unbalance loads");
  }
}

}  // namespace

deck::ListSpec parameters() {
  using deck::Range;
  return deck::ListSpec("Loads",
                        "Weight, bit loads, unbalances and nodal forces; without this list nothing "
                        "loads the string.")
      .real("Gravity", "m/s2", 9.81, Range::nonNegative(),
            "Gravity, straight down; 0 models no weight.")
      .real("Weight On Bit", "N", 0.0, Range::nonNegative(),
            "Force of the rock on the bit, up the hole: compresses the string above the bit.")
      .real("Torque On Bit", "N m", 0.0, Range::any(),
            "Torque of the rock on the bit; positive resists a positive rotary speed.")
      .list(unbalanceParameters())
      .list(forceParameters());
}

deck::ListSpec dampingParameters() {
  using deck::Range;
  return deck::ListSpec("Damping",
                        "Rayleigh damping of the string; without this list it has none of its own.")
      .real("Mass Coefficient", "1/s", 0.0, Range::nonNegative(),
            "Factor of the string's mass matrix in the damping matrix.")
      .real("Stiffness Coefficient", "s", 0.0, Range::nonNegative(),
            "Factor of the string's stiffness, pre-stress included, in the damping matrix.");
}

LoadsData readLoads(const ParameterList& list) {
  LoadsData loads;
  loads.gravity = list.get<double>("Gravity");
  loads.weightOnBit = list.get<double>("Weight On Bit");
  loads.torqueOnBit = list.get<double>("Torque On Bit");
  const auto each = [&list](const char* name, const auto& read) {
    if (!list.isSublist(name)) return;
    const ParameterList& entries = list.sublist(name);
    for (auto it = entries.begin(); it != entries.end(); ++it)
      read(entries.sublist(entries.name(it)), entries.name(it));
  };
  each("Unbalance", [&](const ParameterList& entry, const std::string& name) {
    loads.unbalances.push_back(readUnbalance(entry, name));
  });
  each("Forces", [&](const ParameterList& entry, const std::string& name) {
    loads.forces.push_back(readForce(entry, name));
  });
  return loads;
}

RayleighDamping readDamping(const ParameterList& list) {
  return {list.get<double>("Mass Coefficient"), list.get<double>("Stiffness Coefficient")};
}

int nodeOf(const Place& place, const std::vector<double>& arcLength, const std::string& who) {
  const int nodes = static_cast<int>(arcLength.size());
  if (place.node) {
    if (*place.node >= 1 && *place.node <= nodes) return *place.node;
    throw DeckError(who + " names node " + std::to_string(*place.node) +
                    ", but the string has nodes 1 to " + std::to_string(nodes) + ".");
  }
  const double wanted = place.position.value();
  const auto nearest = std::min_element(
      arcLength.begin(), arcLength.end(),
      [wanted](double a, double b) { return std::abs(a - wanted) < std::abs(b - wanted); });
  const int node = static_cast<int>(nearest - arcLength.begin()) + 1;
  if (nearest != arcLength.end() && std::abs(*nearest - wanted) <= nodeTolerance) return node;
  throw DeckError(who + " names the position " + formatNumber(wanted) +
                  " m, where no node is; the nearest is node " + std::to_string(node) + " at " +
                  formatNumber(*nearest) + " m.");
}

std::vector<PointLoad> pointLoads(const LoadsData& loads, const RotarySpeed& rotary,
                                  const std::vector<double>& arcLength) {
  std::vector<PointLoad> out;
  const int bit = static_cast<int>(arcLength.size());
  if (loads.weightOnBit != 0.0)
    out.push_back({"weight on bit", bit, 2, -loads.weightOnBit, model::ScalarLaw::one()});
  if (loads.torqueOnBit != 0.0)
    out.push_back({"torque on bit", bit, 5, -loads.torqueOnBit, model::ScalarLaw::one()});
  for (const auto& force : loads.forces) {
    const int node = nodeOf(force.place, arcLength, "Loads/Forces/" + force.name);
    out.push_back({"nodal force", node, force.component, force.value, lawOf(force)});
  }
  addUnbalances(out, loads, rotary, arcLength);
  return out;
}

void addTo(model::SecondOrderModel& model, const std::vector<PointLoad>& loads) {
  std::map<model::DofLabel, Eigen::Index> position;
  for (std::size_t i = 0; i < model.dofs.size(); ++i)
    position.emplace(model.dofs[i], static_cast<Eigen::Index>(i));
  std::map<std::pair<std::string, int>, std::size_t> terms;  // (name, law) -> LoadTerm
  for (const auto& load : loads) {
    const auto dof = position.find(model::DofLabel::physical(load.node, load.component));
    if (dof == position.end()) continue;
    const int law = model.lawIndex(load.law);
    const auto [it, isNew] = terms.emplace(std::make_pair(load.name, law), model.loads.size());
    if (isNew)
      model.loads.push_back(
          {load.name, Vector::Zero(static_cast<Eigen::Index>(model.dofs.size())), law});
    model.loads[it->second].vector[dof->second] += load.value;
  }
}

}  // namespace tooljoint::loads
