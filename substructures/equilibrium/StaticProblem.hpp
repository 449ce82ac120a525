// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Static equilibrium of the bent string in contact with the well as a nonlinear problem (Nguyen et
/// al. 2020, eq. 19).
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "model/NonlinearProblem.hpp"
#include "substructures/beam/FreeDofs.hpp"
#include "substructures/beam/SparseAssembler.hpp"
#include "substructures/equilibrium/StaticElements.hpp"

namespace tooljoint::equilibrium {

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
      false;  ///< points in contact with the wall move along it, not along its tangent
};

/// r(D) = (K_pa + K_gpo(D)) D - F_s - F_cs(D) - R_ipa on the free dofs.
class StaticProblem : public model::ChainProblem {
 public:
  /// Throws ModelError when sizes do not fit or no dof is free. `input` must outlive the problem.
  explicit StaticProblem(const StaticInput& input);

  void set(const StaticSwitches& switches) { switches_ = switches; }
  const StaticSwitches& switches() const { return switches_; }

  int size() const override { return free_.size(); }
  void residual(const Vector& x, Vector& r) const override;
  void jacobian(const Vector& x, Sparse& jacobian) const override;
  /// Residual and Jacobian together, at half the cost.
  void linearise(const Vector& x, Vector& r, Sparse& jacobian) const;
  std::vector<int> firstOfNodes() const override { return free_.firstOfNodes(); }
  void residualRows(const Vector& x, RowRange rows, Vector& r) const override;
  void jacobianRows(const Vector& x, RowRange rows, Sparse& jacobian) const override;
  Vector residualScale() const override;
  double stepLimit(const Vector& x, const Vector& dx) const override;
  /// With slideAlongWall, a point that a step would move beyond its clearance keeps the distance
  /// from the axis that the step has along the normal. A tangential motion t along a wall of radius
  /// r would otherwise press the point in by t^2/2r, far more than a stiff wall yields.
  Vector moved(const Vector& x, const Vector& dx, double s) const override;
  std::string unknownName(int i) const override;
  /// Unknowns of u and v.
  std::vector<int> lateralUnknowns() const;

  /// expand(): all dofs from the free ones (held dofs are zero). restrict(): the free dofs of a
  /// full vector.
  Vector expand(const Vector& x) const;
  Vector restrict(const Vector& full) const { return free_.restrict(full); }

  /// (K_pa + K_gpo(D)) D - F_s - F_cs(D) - R_ipa at every dof of a full vector D; at a held dof it
  /// is the reaction of its support on the string [N, N m].
  Vector unbalanced(const Vector& full) const;

  const StaticElements& elements() const { return elements_; }
  /// K_gpo of an element in nodal frames; zero if the switches exclude it.
  beam::Matrix12 geometricStiffness(int element, const Vector& full) const;

  /// The largest entry of the loads; moments are divided by a mean element length [N].
  double largestLoad() const { return forceScale_; }

  /// Contact forces of the batch at D: StaticContact::kForces per point, and the normal force per
  /// point.
  void contactForces(const Vector& full, Vector& forces, Vector& normal) const;

 private:
  using Nodes = beam::FreeDofs::Nodes;
  Nodes allNodes() const { return {0, input_.nodes}; }
  /// Elements firstElement() ... endElement() - 1 have an end at one of the nodes.
  int firstElement(Nodes nodes) const { return std::max(0, nodes.begin - 1); }
  int endElement(Nodes nodes) const { return std::min(nodes.end, elements_.size()); }
  /// Contributions to unbalanced() and jacobian() at some nodes.
  Vector unbalancedAt(Nodes nodes, const Vector& full) const;
  void jacobianAt(Nodes nodes, const Vector& x, Sparse& jacobian) const;
  /// Forces (at every dof) and tangent of a point.
  void addForces(int point, const Vector& forces, Vector& r) const;
  void addTangent(int point, const Vector& tangents, Sparse& jacobian) const;
  /// -F_s - R_ipa and the pretension, at every dof.
  Vector constantForces() const;
  /// Options that select the points at some nodes.
  contact::StaticContact::Options contactOptions(Nodes nodes) const;
  Vector lateral(const Vector& full) const;  ///< u, v of the contact points
  bool touches() const { return switches_.contact && input_.contact != nullptr; }
  bool isForce(int unknown) const { return free_.component(unknown) < 3; }
  bool isLateral(int unknown) const { return free_.component(unknown) < 2; }

  const StaticInput& input_;
  StaticElements elements_;
  beam::FreeDofs free_;
  Vector pretension_;  ///< forces on the nodes
  StaticSwitches switches_;
  std::vector<int> pointsBefore_;    ///< number of contact points before each node; empty: points
                                     ///< are not sorted
  beam::SparseAssembler assembler_;  ///< elements first, then contact points (u, v, w, theta_z)
  double forceScale_ = 1.0;
  double momentScale_ = 1.0;
};

}  // namespace tooljoint::equilibrium
