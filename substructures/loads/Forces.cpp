// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>

#include "common/Constants.hpp"
#include "common/Text.hpp"
#include "substructures/loads/Load.hpp"
#include "substructures/loads/Place.hpp"

namespace tooljoint::loads {
namespace {

using constants::twoPi;
using Teuchos::ParameterList;

/// Value cos(2 pi f t + phase) between start and end, in a nodal frame. Constant for f = 0.
struct NodalForce {
  std::string name;
  Place place;
  int component = 0;       ///< 0-based: u, v, w, theta_x, theta_y, theta_z
  double value = 0.0;      ///< [N] or [N m]
  double frequency = 0.0;  ///< [Hz]
  double phase = 0.0;      ///< [rad]
  double startTime = 0.0;  ///< [s]
  double endTime = 0.0;    ///< [s]; infinite when the deck gives none
};

const std::vector<std::string>& componentNames() {
  static const std::vector<std::string> names{"u", "v", "w", "theta_x", "theta_y", "theta_z"};
  return names;
}

deck::ListSpec forceParameters() {
  using deck::Range;
  deck::ListSpec entry("Force", "One force or torque at a node; the name is free.");
  declarePlace(entry, "it acts on");
  entry
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
            "Time from which it acts; one that is steady, acts from 0 on and has no End Time acts "
            "in the static state too.")
      .expert()
      .real("End Time", "s", deck::Optional{}, Range::positive(),
            "Time from which it acts no more; never when not given.");
  return deck::ListSpec("Forces", "Forces and torques at nodes, one list each.").namedLists(entry);
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

/// The law of a nodal force. Equal parameters give equal names, so that equal forces share one law.
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
  std::vector<double> corners;
  for (const double corner : {force.startTime, force.endTime})
    if (corner > 0.0 && std::isfinite(corner)) corners.push_back(corner);
  return {name,
          [pulsation, phase, start = force.startTime, end = force.endTime](double t) {
            return t >= start && t < end ? std::cos(pulsation * t + phase) : 0.0;
          },
          corners};
}

class Forces final : public Load {
 public:
  explicit Forces(const ParameterList& list) {
    for (auto it = list.begin(); it != list.end(); ++it)
      forces_.push_back(readForce(list.sublist(list.name(it)), list.name(it)));
  }

  std::vector<PointLoad> atNodes(const std::vector<double>& depths,
                                 const RotarySpeed&) const override {
    std::vector<PointLoad> out;
    for (const auto& force : forces_) {
      const int node = nodeOf(force.place, depths, "Loads/Forces/" + force.name);
      out.push_back({"nodal force", node, force.component, force.value, lawOf(force)});
    }
    return out;
  }

  std::vector<LoadRemark> describe(const RotarySpeed&) const override {
    return {{!forces_.empty(), "nodal forces", std::to_string(forces_.size()) + " in the list"}};
  }

  std::string list() const override { return "Loads/Forces"; }

 private:
  std::vector<NodalForce> forces_;
};

const bool forcesRegistered =
    addLoad<Forces>("Forces", "forces and torques at nodes.", forceParameters());

}  // namespace
}  // namespace tooljoint::loads
