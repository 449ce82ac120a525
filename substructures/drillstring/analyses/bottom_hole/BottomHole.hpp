// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// `tooljoint bha`: the lower part of a string at rest in its hole. Sides of the hole at a depth
/// are its local high side h and its right side t x h (t down the hole).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cases/run/ResumedRows.hpp"
#include "substructures/drillstring/case/DrillstringCase.hpp"
#include "substructures/drillstring/scene/BottomHoleParameters.hpp"
#include "substructures/drillstring/scene/Scene.hpp"

namespace tooljoint::drillstring {

/// Components to the high side and to the right side.
using Sides = Eigen::Vector2d;

/// The varied quantities.
struct BottomHolePoint {
  std::optional<double> inclination;  ///< at the bit [rad]; none: the deck's hole
  double weight = 0.0;                ///< on bit [N]
  double toolFace = 0.0;              ///< [rad]
};

/// A gauge above the bit.
struct GaugeContact {
  std::string component;
  double fromBit = 0.0;         ///< [m]
  Sides force = Sides::Zero();  ///< of the wall on the gauge [N]

  template <class Archive>
  void serialize(Archive& archive) {
    archive(component, fromBit, force);
  }
};

/// A node of the string, from the bit up.
struct BottomHoleStation {
  double fromBit = 0.0;              ///< [m]
  Sides deflection = Sides::Zero();  ///< from the axis of the hole [m]
  double clearance = 0.0;            ///< radial [m]
  Sides wallForce = Sides::Zero();   ///< of the wall on the string [N]
  Sides moment = Sides::Zero();      ///< E I times the curvature towards the sides [N m]
  double axialForce = 0.0;           ///< effective tension [N]
  double torque = 0.0;               ///< [N m]
  double vonMises = 0.0;             ///< [Pa]

  template <class Archive>
  void serialize(Archive& archive) {
    archive(fromBit, deflection, clearance, wallForce, moment, axialForce, torque, vonMises);
  }
};

/// One static state, or the average of a string that turns.
struct BottomHoleState {
  Sides sideForce = Sides::Zero();  ///< of the bit on the rock [N]
  Sides tilt = Sides::Zero();       ///< of the bit against the axis of the hole [rad]
  Sides sag = Sides::Zero();        ///< of the string against the hole at the survey tool [rad]
  std::vector<GaugeContact> gauges;
  std::vector<BottomHoleStation> stations;
  /// Tangency point: distance from the bit of the lowest contact of the body above all gauges in
  /// contact; negative: none [m].
  double tangency = -1.0;
  /// Imbalance of forces, relative to the buoyed weight and the weight on bit. Imbalance of
  /// moments, relative to the sum of the moments of all lateral forces about the bit.
  double forceDefect = 0.0, momentDefect = 0.0;
  bool stable = true;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(sideForce, tilt, sag, gauges, stations, tangency, forceDefect, momentDefect, stable);
  }
};

/// The computed lower part of the string.
class BottomHole {
 public:
  /// DeckError: no weight or no wall, supports or forces at separate nodes, lengths beyond the
  /// string. The scene must outlive the object. Collective.
  BottomHole(const Scene& scene, const BottomHoleSettings& settings);

  /// The static state of this length of string above the bit, with bends and eccentric gauges
  /// turned by `turned` [rad] from the tool face. ConvergenceError, ModelError.
  BottomHoleState solve(const BottomHolePoint& point, double length, double turned = 0.0) const;
  /// The average over evenly spaced angles; stresses and defects are the largest values.
  BottomHoleState rotating(const BottomHolePoint& point, double length) const;

  /// True if a feature in this length turns with the string.
  bool turns(double length) const;
  double wholeLength() const { return string_.length(); }  ///< [m]

 private:
  /// The node (0-based) at the top of this length above the bit.
  int topNode(double length) const;
  Scene lowerPart(const BottomHolePoint& point, double length, double turned) const;

  const Scene& scene_;
  BottomHoleSettings settings_;
  DrillString string_;  ///< whole, with divided elements
};

/// The modelled length and its accuracy.
struct ModelledLength {
  double length = 0.0;          ///< above the bit [m]
  double checkedAgainst = 0.0;  ///< another length [m]
  double change = 0.0;  ///< between the two: of the force on the bit over the largest force on a
                        ///< wall, or of the tilt over the largest slope of the string
};

/// A row of the sweep.
struct BottomHoleRow {
  BottomHolePoint point;
  bool rotating = false;
  BottomHoleState state;
};

/// A combination without an equilibrium.
struct MissingRow {
  BottomHolePoint point;
  bool rotating = false;
  std::string reason;
};

struct BottomHoleSweep {
  ModelledLength length;
  std::vector<BottomHoleRow> rows;
  std::vector<MissingRow> missing;
};

/// The deck's list `Bottom-Hole Assembly`, or its defaults if the deck has none. DeckError if it
/// does not fit this string.
BottomHoleSettings bottomHoleSettings(const Scene& scene);

/// Every combination of the settings, distributed to the ranks one by one; at the end all ranks
/// have all of them. States that are stored for the same deck and program are not solved again. A
/// string without turning features has no separate rows for rotating. Combinations without an
/// equilibrium are listed as missing; ConvergenceError when none has one; InterruptedError after a
/// signal. Collective.
BottomHoleSweep bottomHoleSweep(const Scene& scene, const BottomHoleSettings& settings,
                                const cases::RowFolder& store);

/// Prints the sweep and writes bha.csv, bha_contacts.csv, bha_profile.csv, bha.h5 and summary.json.
/// Collective.
void reportBottomHole(const DrillstringCase& one, const std::string& folder, bool fresh);

}  // namespace tooljoint::drillstring
