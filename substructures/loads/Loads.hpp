// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Loads of a scene: gravity, weight and torque on bit, mass unbalances, forces at nodes, and
/// Rayleigh damping.
#pragma once

#include <Teuchos_ParameterList.hpp>
#include <optional>
#include <string>
#include <vector>

#include "common/Types.hpp"
#include "deck/ListSpec.hpp"
#include "model/SecondOrderModel.hpp"
#include "substructures/loads/RotarySpeed.hpp"

namespace tooljoint::loads {

/// A node as a deck names it: by number, or by the measured depth of a node.
struct Place {
  std::optional<int> node;         ///< 1-based
  std::optional<double> position;  ///< arc length from the surface [m]
};

/// A mass off the axis: m e at an angle from the local x axis that turns with the string.
struct Unbalance {
  std::string name;
  Place place;
  double moment = 0.0;  ///< m e [kg m]
  double phase = 0.0;   ///< phi_0 [rad]
};

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

/// What the deck list `Loads` says.
struct LoadsData {
  double gravity = 0.0;      ///< g [m/s2], along global +Z (down); 0 models no weight
  double weightOnBit = 0.0;  ///< [N], positive pushes the string up the hole: the force along w at
                             ///< the bit is its negative
  double torqueOnBit = 0.0;  ///< [N m], positive resists a positive rotary speed: the torque about
                             ///< z at the bit is its negative
  std::vector<Unbalance> unbalances;
  std::vector<NodalForce> forces;
};

/// Rayleigh damping c_M M_a + c_K (K_a + K_gpa + K_gpo), (28) of Nguyen et al. 2020. Both 0 without
/// the deck list.
struct RayleighDamping {
  double massCoefficient = 0.0;       ///< c_M [1/s]
  double stiffnessCoefficient = 0.0;  ///< c_K [s]
  bool present() const { return massCoefficient != 0.0 || stiffnessCoefficient != 0.0; }
};

/// The deck lists `Loads` and `Damping`.
deck::ListSpec parameters();
deck::ListSpec dampingParameters();

/// From the validated deck list `Loads`. DeckError when an entry names its place, or its unbalance,
/// twice or not at all.
LoadsData readLoads(const Teuchos::ParameterList& list);
/// From the validated deck list `Damping`.
RayleighDamping readDamping(const Teuchos::ParameterList& list);

/// Node number (1-based) of a place, given the arc length of every node [m]. DeckError when there
/// is no such node; a position must meet a node within 1e-6 m, and the message names the nearest.
int nodeOf(const Place& place, const std::vector<double>& arcLength, const std::string& who);

/// A load on one dof: value times a scalar law of time.
struct PointLoad {
  std::string name;
  int node = 0;       ///< 1-based
  int component = 0;  ///< 0-based
  double value = 0.0;
  model::ScalarLaw law;
};

/// All loads at nodes (weight and torque on bit at the last node, forces, unbalances), as loads on
/// dofs. Loads under the law "1" are the static ones. Unbalances are left out, with a warning, when
/// nothing rotates; each one built counts as "unbalance loads" in the census.
///
/// A mass unbalance m e with phi = int Omega dt + phi_0 loads its node with
///     m e (phi'^2 cos phi + phi'' sin phi, phi'^2 sin phi - phi'' cos phi)
/// in local x and y; phi_0 goes into the vectors, so all unbalances share two scalar laws.
std::vector<PointLoad> pointLoads(const LoadsData& loads, const RotarySpeed& rotary,
                                  const std::vector<double>& arcLength);

/// Add loads to a model with physical dofs, one LoadTerm per name and law. Loads on dofs the model
/// does not have (held ones) are left out.
void addTo(model::SecondOrderModel& model, const std::vector<PointLoad>& loads);

}  // namespace tooljoint::loads
