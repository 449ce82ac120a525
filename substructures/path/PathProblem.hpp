// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The bent string as a nonlinear problem: corotational elements whose nodes move along a curve or
/// in space.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "model/NonlinearProblem.hpp"
#include "substructures/beam/FreeDofs.hpp"
#include "substructures/beam/SparseAssembler.hpp"
#include "substructures/path/Path.hpp"

namespace tooljoint::path {

/// Position and orientation of a node.
struct NodePose {
  Vector3 position;
  Matrix3 triad;  ///< material axes, z normal to the cross section
};

/// Equilibrium of the unloaded string with prescribed translations. Unknowns of a node: its
/// translations (one along a curve, or three in space), then the rotation vector theta in the axes
/// of its reference triad, Q = Q_ref exp(theta^). Residual rows: the internal forces conjugate to
/// the translations, and the internal moments in reference axes.
class PathProblem : public model::ChainProblem {
 public:
  int size() const override { return free_.size(); }
  void residual(const Vector& x, Vector& r) const override;
  void jacobian(const Vector& x, Sparse& jacobian) const override;
  std::vector<int> firstOfNodes() const override { return free_.firstOfNodes(); }
  void residualRows(const Vector& x, RowRange rows, Vector& r) const override;
  void jacobianRows(const Vector& x, RowRange rows, Sparse& jacobian) const override;
  Vector residualScale() const override;
  std::string unknownName(int i) const override;

  int nodes() const { return static_cast<int>(reference_.size()); }
  /// Unknowns of the initial state, or of the state accepted last.
  Vector start() const { return free_.restrict(state_); }
  std::vector<NodePose> poses(const Vector& x) const;
  std::vector<beam::CorotationalResponse> responses(const Vector& x, bool withTangent) const;
  /// Internal forces and moments of all nodes in global axes, 6 x nodes [N, N m].
  Matrix nodalForces(const Vector& x) const;

 protected:
  /// `translations` per node: 1 or 3. `state` holds translations and rotation vector (zero) of all
  /// nodes. The dofs in `held` (positions in `state`) and the rotations (along a curve also depths)
  /// that no element has keep their values.
  PathProblem(const PathInput& input, int translations, Vector state,
              std::vector<Matrix3> reference, const std::vector<int>& held);

  int dofsPerNode() const { return translations_ + 3; }
  int unknownOf(int node, int dof) const { return free_.unknown(node * dofsPerNode() + dof); }
  /// All dofs of all nodes, including the held ones.
  Vector expand(const Vector& x) const;
  /// Makes the state x the new reference: its triads become the reference triads, the rotation
  /// vectors zero.
  void moveReference(const Vector& x);

  /// Position of a node and its derivative, 3 x translations, from the node's translations.
  virtual Vector3 position(const double* translations) const = 0;
  virtual Matrix positionDerivative(const double* translations) const = 0;
  /// Second derivative by the only translation; zero if the positions themselves are the unknowns.
  virtual Vector3 positionCurvature(const double* translations) const;
  /// Changes the assembled equations for prescribed motions.
  virtual void constrain(const Vector& /*state*/, Vector& /*r*/) const {}
  virtual void constrain(Sparse& /*jacobian*/) const {}
  virtual void constrainScale(Vector& /*scale*/) const {}

 private:
  NodePose pose(int node, const Vector& state) const;
  /// Virtual motions (test) and actual motions (trial) of a node per unit of its dofs, 6 x
  /// dofsPerNode.
  Matrix testMotion(int node, const Vector& state) const;
  Matrix trialMotion(int node, const Vector& state) const;
  /// Elements begin ... end - 1, the numbers of their first nodes.
  struct Elements {
    int begin, end;
  };
  Elements allElements() const { return {0, static_cast<int>(elements_.size())}; }
  /// All elements at the nodes of some rows.
  Elements elementsOf(RowRange rows) const;
  std::vector<beam::CorotationalResponse> evaluate(const Vector& state, bool withTangent,
                                                   Elements which) const;
  /// Contributions of some elements to residual() and jacobian().
  void residualOf(Elements which, const Vector& x, Vector& r) const;
  void jacobianOf(Elements which, const Vector& x, Sparse& jacobian) const;

  int translations_;
  Vector state_;
  std::vector<Matrix3> reference_;
  std::vector<std::shared_ptr<const beam::Element>> elements_;
  beam::FreeDofs free_;
  beam::SparseAssembler assembler_;
  double forceScale_ = 1.0;
  double momentScale_ = 1.0;
};

/// `Centre line`: every node stays on the axis of the well, free to slide along it and to rotate.
/// The depth of the first node and its rotation about the tangent are fixed. Starts from
/// unstretched depths and the given nodal frames.
class CentreLineProblem : public PathProblem {
 public:
  CentreLineProblem(const PathInput& input, const std::vector<double>& depths,
                    const std::vector<Matrix3>& frames);
  /// Depth of each node along the well at x [m].
  std::vector<double> depths(const Vector& x) const;

 protected:
  Vector3 position(const double* translations) const override;
  Matrix positionDerivative(const double* translations) const override;
  Vector3 positionCurvature(const double* translations) const override;

 private:
  const well::Trajectory* trajectory_;
};

/// `Imposed nodes`: X and Y of some nodes have prescribed values. The translations of the first
/// node and its rotation about its own axis are fixed. Starts straight down from the wellhead; each
/// load step starts from the state accepted last.
class ImposedNodesProblem : public PathProblem {
 public:
  /// `imposed`: 0-based nodes, without the first one.
  ImposedNodesProblem(const PathInput& input, std::vector<int> imposed);

  /// Prescribes X and Y (columns of 2 x imposed nodes) of the imposed nodes for the next solve [m].
  void prescribe(const Matrix& target);
  /// Takes x as the start of the next load step.
  void accept(const Vector& x);
  const std::vector<int>& imposedNodes() const { return imposed_; }

 protected:
  Vector3 position(const double* translations) const override;
  Matrix positionDerivative(const double* translations) const override;
  void constrain(const Vector& state, Vector& r) const override;
  void constrain(Sparse& jacobian) const override;
  void constrainScale(Vector& scale) const override;

 private:
  std::vector<int> imposed_;
  Matrix target_;
};

}  // namespace tooljoint::path
