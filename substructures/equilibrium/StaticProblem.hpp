// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Static equilibrium of the bent string in contact with the well as a nonlinear problem (Nguyen et
/// al. 2020, eq. 19).
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "model/NonlinearProblem.hpp"
#include "substructures/beam/Element.hpp"
#include "substructures/beam/SparseAssembler.hpp"
#include "substructures/contact/StaticContact.hpp"

namespace tooljoint::equilibrium {

/// Element e joins nodes e and e + 1.
struct StaticElement {
  std::shared_ptr<const beam::Element> formulation;
  beam::Matrix12 stiffness;  ///< everything linear, K_pa of the element, in nodal frames
  beam::Matrix12 rotation;   ///< nodal dofs to the element frame (beam::rotation12)
  /// Axial force of the undeformed element [N]: 0 where the nodes stand as an unloaded string has
  /// them.
  double pretension = 0.0;
  double bendingMoment = 0.0;  ///< E I kappa of the well [N m], the scale of the torque balance
};

/// Input of the static problem; 6 dofs per node in nodal frames, relative to the path
/// state.
struct StaticInput {
  int nodes = 0;
  std::vector<StaticElement> elements;
  /// What elements have turned by against their nodes without stress (bends of the string), added
  /// to D of each element [rad]; empty means none.
  std::vector<beam::Vector12> kinks;
  Vector load;             ///< F_s: weight, mud, WOB, TOB [N, N m]
  Vector pathReaction;     ///< R_ipa; empty means zero
  std::vector<char> held;  ///< 1 where a support (or the choice of dof families) holds the dof
  std::shared_ptr<const contact::StaticContact> contact;  ///< null: no contact in this scene
  contact::Sliding sliding{0.0, 1.0};  ///< of the string on the wall; none: no friction
  bool geometricStiffness = true;      ///< K_gpo(D)
  /// K_gpo takes its slopes from all rotations in the element frame, spin included, as the source
  /// does. False: from the change of the nodal tangents (beam::slopeRotation), so that a section
  /// that spins about its own axis meets no geometric stiffness.
  bool chordSlopes = false;
};

/// Forces of the pretension of all elements on their nodes, 6 per node [N].
Vector pretensionForces(const StaticInput& input);

/// Active terms of the equation, and the form of the Jacobian.
struct StaticSwitches {
  bool geometricStiffness = true;
  bool pathReaction = true;
  bool contact = true;
  bool exactJacobian = true;      ///< false: without dK_gpo/dD, equation (25)
  double lambda = 0.0;            ///< regularisation of all contacts [1/m]; 0: each point's own
  double frictionScale = 1.0;     ///< factor on mu_s
  double stiffnessScale = 1.0;    ///< on the stiffness of the wall
  double pull = 1.0;              ///< fraction of the attraction of open points by contact laws
  double lateralStepLimit = 0.0;  ///< largest change of u or v in a step [m]; 0: none
  bool slideAlongWall =
      false;  ///< steps take points that touch along the wall, not along its tangent
};

/// r(D) = (K_pa + K_gpo(D)) D - F_s - F_cs(D) - R_ipa on the free dofs.
class StaticProblem : public model::ChainProblem {
 public:
  /// Throws ModelError when sizes do not fit or no dof is free. `input` must outlive the problem.
  explicit StaticProblem(const StaticInput& input);

  void set(const StaticSwitches& switches) { switches_ = switches; }
  const StaticSwitches& switches() const { return switches_; }

  int size() const override { return unknowns_; }
  void residual(const Vector& x, Vector& r) const override;
  void jacobian(const Vector& x, Sparse& jacobian) const override;
  std::vector<int> firstOfNodes() const override;
  void residualRows(const Vector& x, RowRange rows, Vector& r) const override;
  void jacobianRows(const Vector& x, RowRange rows, Sparse& jacobian) const override;
  Vector residualScale() const override;
  double stepLimit(const Vector& x, const Vector& dx) const override;
  /// With slideAlongWall a point that the step leaves outside its clearance keeps the distance from
  /// the axis that the step has along the normal: moving on by t along a wall of radius r would
  /// press it in by t^2/2r, far more than a stiff wall yields.
  Vector moved(const Vector& x, const Vector& dx, double s) const override;
  std::string unknownName(int i) const override;
  /// The unknowns that are u or v.
  std::vector<int> lateralUnknowns() const;

  /// All dofs from the free ones (held dofs are zero), and the free ones of a full vector.
  Vector expand(const Vector& x) const;
  Vector restrict(const Vector& full) const;

  /// (K_pa + K_gpo(D)) D - F_s - F_cs(D) - R_ipa at every dof of a full vector D; at a held dof it
  /// is the reaction of its support on the string [N, N m].
  Vector unbalanced(const Vector& full) const;

  /// F_apo = F_0 + k_ww (w2 - w1), F_0 the pretension, and T_apo = k_theta (theta_z2 - theta_z1) in
  /// the element frame; for a beam k_ww = E S/l and k_theta = G J/l, equation (20) [N, N m].
  double axialForce(int element, const Vector& full) const;
  double torque(int element, const Vector& full) const;
  /// F_apo K_gF + T_apo K_gT of an element in nodal frames.
  beam::Matrix12 geometricStiffness(int element, const Vector& full) const;

  /// The largest entry of the loads, moments over a mean element length [N].
  double largestLoad() const { return forceScale_; }

  /// Contact forces of the batch at D: StaticContact::kForces per point, and the normal force per
  /// point.
  void contactForces(const Vector& full, Vector& forces, Vector& normal) const;

 private:
  /// Nodes begin ... end - 1.
  struct Nodes {
    int begin, end;
  };
  Nodes allNodes() const { return {0, input_.nodes}; }
  /// Those of some rows, with their elements: those that join them and those to the next nodes.
  Nodes nodesOf(RowRange rows) const;
  int firstElement(Nodes nodes) const { return std::max(0, nodes.begin - 1); }
  int endElement(Nodes nodes) const {
    return std::min(nodes.end, static_cast<int>(input_.elements.size()));
  }
  /// What unbalanced() and jacobian() have at some nodes.
  Vector unbalancedAt(Nodes nodes, const Vector& full) const;
  void jacobianAt(Nodes nodes, const Vector& x, Sparse& jacobian) const;
  /// With the points at some nodes asked for.
  contact::StaticContact::Options contactOptions(Nodes nodes) const;
  contact::StaticContact::Options contactOptions() const;
  /// D of the ends of an element, kinks included.
  beam::Vector12 motion(int element, const Vector& full) const;
  Vector lateral(const Vector& full) const;  ///< u, v of the contact points
  bool touches() const { return switches_.contact && input_.contact != nullptr; }

  const StaticInput& input_;
  Vector pretension_;  ///< forces on the nodes
  StaticSwitches switches_;
  int unknowns_ = 0;
  std::vector<int> index_;              ///< unknown of each dof, -1 when held
  std::vector<int> nodeOf_;             ///< of each unknown
  std::vector<int> pointsBefore_;       ///< contact points at nodes before each; empty: not sorted
  beam::SparseAssembler assembler_;     ///< elements first, then contact points (u, v, w, theta_z)
  std::vector<double> axialStiffness_;  ///< k_ww per element [N/m]
  std::vector<double> torsionalStiffness_;  ///< k_theta per element [N m]
  std::vector<beam::Matrix12> unitAxial_;   ///< K_gF per unit F in nodal frames
  std::vector<beam::Matrix12> unitTorque_;  ///< K_gT per unit T in nodal frames
  double forceScale_ = 1.0;
  double momentScale_ = 1.0;
};

}  // namespace tooljoint::equilibrium
