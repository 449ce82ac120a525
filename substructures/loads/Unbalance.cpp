// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "common/Text.hpp"
#include "common/report/EvaluationCounters.hpp"
#include "common/report/Log.hpp"
#include "substructures/loads/Load.hpp"
#include "substructures/loads/Place.hpp"

namespace tooljoint::loads {
namespace {

using Teuchos::ParameterList;

/// An eccentric mass: m e at an angle from the local x axis that turns with the string.
struct OffAxisMass {
  std::string name;
  Place place;
  double moment = 0.0;  ///< m e [kg m]
  double phase = 0.0;   ///< phi_0 [rad]
};

deck::ListSpec unbalanceParameters() {
  using deck::Range;
  deck::ListSpec entry("Unbalance", "One mass off the axis; the name is free.");
  declarePlace(entry, "that carries it");
  entry
      .real("Mass", "kg", deck::Optional{}, Range::positive(),
            "Mass off the axis; together with Eccentricity.")
      .expert()
      .real("Eccentricity", "m", deck::Optional{}, Range::nonNegative(),
            "Distance of the mass from the axis; together with Mass.")
      .expert()
      .real("Moment", "kg m", deck::Optional{}, Range::nonNegative(),
            "Mass times eccentricity; give this, or Mass and Eccentricity.")
      .real("Phase", "rad", 0.0, Range::any(), "Angle of the mass from local x at time 0.");
  return deck::ListSpec("Unbalance",
                        "Mass unbalances that turn with the rotary speed, one list each.")
      .namedLists(entry);
}

OffAxisMass readUnbalance(const ParameterList& list, const std::string& name) {
  const std::string who = "Loads/Unbalance/" + name;
  const bool moment = list.isParameter("Moment");
  const bool mass = list.isParameter("Mass");
  const bool eccentricity = list.isParameter("Eccentricity");
  if (mass != eccentricity || moment == mass) {
    throw DeckError(who + " needs either Moment, or both Mass and Eccentricity.");
  }
  OffAxisMass u;
  u.name = name;
  u.place = readPlace(list, who);
  u.moment = moment ? list.get<double>("Moment")
                    : list.get<double>("Mass") * list.get<double>("Eccentricity");
  u.phase = list.get<double>("Phase");
  return u;
}

/// A mass unbalance m e with phi = int Omega dt + phi_0 loads its node with
///     m e (phi'^2 cos phi + phi'' sin phi, phi'^2 sin phi - phi'' cos phi)
/// in local x and y; phi_0 goes into the vectors, so all unbalances share two scalar laws. Each one
/// built counts as "unbalance loads" (EvaluationCounters.hpp).
class Unbalance final : public Load {
 public:
  explicit Unbalance(const ParameterList& list) {
    for (auto it = list.begin(); it != list.end(); ++it)
      masses_.push_back(readUnbalance(list.sublist(list.name(it)), list.name(it)));
  }

  std::vector<PointLoad> atNodes(const std::vector<double>& depths,
                                 const RotarySpeed& rotary) const override {
    std::vector<PointLoad> out;
    if (masses_.empty()) return out;
    if (!rotary.present()) {
      log::warn(
          "The deck has mass unbalances but no list \"Rotary Speed\": the string does not turn, so "
          "they have no effect.");
      return out;
    }
    // With A = Omega^2 cos Phi + dOmega/dt sin Phi, B = Omega^2 sin Phi - dOmega/dt cos Phi and phi
    // = Phi + phi_0: F_x = m e (A cos phi_0 - B sin phi_0), F_y = m e (A sin phi_0 + B cos phi_0)
    const model::ScalarLaw a = rotary.scalar(unbalanceCosine);
    const model::ScalarLaw b = rotary.scalar(unbalanceSine);
    for (const auto& u : masses_) {
      const int node = nodeOf(u.place, depths, "Loads/Unbalance/" + u.name);
      const double c = u.moment * std::cos(u.phase);
      const double s = u.moment * std::sin(u.phase);
      out.push_back({"unbalance", node, 0, c, a});
      out.push_back({"unbalance", node, 0, -s, b});
      out.push_back({"unbalance", node, 1, s, a});
      out.push_back({"unbalance", node, 1, c, b});
      count("unbalance loads");
    }
    return out;
  }

  std::vector<LoadRemark> describe(const RotarySpeed& rotary) const override {
    const bool turns = rotary.present();
    return {
        {!masses_.empty() && turns, "mass unbalance",
         std::to_string(masses_.size()) + " in the list" + (turns ? "" : ", but nothing turns")}};
  }

 private:
  std::vector<OffAxisMass> masses_;
};

const bool unbalanceRegistered = addLoad<Unbalance>(
    "Unbalance", "mass unbalances that turn with the rotary speed.", unbalanceParameters());

}  // namespace
}  // namespace tooljoint::loads
