// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The model for all solvers, full or reduced:
///
///     M q'' + (sum_i c_i(t) C_i) q' + (sum_i k_i(t) K_i) q = sum_j f_j(t) F_j + sum_p R_p'
///     f_p(d_p, d_p', t), d_p = offset_p + R_p q
///
/// with constant matrices, named scalar laws of time and batches of point laws.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "common/Types.hpp"
#include "model/DofLabel.hpp"
#include "model/ScalarLaw.hpp"
#include "model/SharedList.hpp"
#include "model/SharedSparse.hpp"
#include "model/laws/PointLaw.hpp"

namespace tooljoint::model {

/// A constant matrix times a scalar law of time.
struct MatrixTerm {
  std::string name;     ///< modelled effect: "gyroscopic", "mud drag", ...
  SharedSparse matrix;  ///< dofs x dofs
  int law = 0;          ///< index into SecondOrderModel::laws
};

/// A constant load vector times a scalar law of time.
struct LoadTerm {
  std::string name;
  Vector vector;  ///< dofs [N, N m]
  int law = 0;
};

/// A batch of points of the model with the same law.
struct PointSet {
  std::string name;  ///< "contact"
  std::shared_ptr<const PointLaw> law;
  std::vector<std::int64_t>
      entities;   ///< node number (1-based) of each point, for messages and output
  Sparse rows;    ///< (size*width) x dofs: d = offset + rows q
  Vector offset;  ///< size*width
};

/// Second-order model in coordinates q. A plain value: solvers compile it into their own kernels.
/// Copies share its matrices, their terms and its laws until one of them is changed.
struct SecondOrderModel {
  std::vector<DofLabel> dofs;
  ComponentNames componentNames;
  NodeNamer nodeName;  ///< for messages
  SharedList<ScalarLaw> laws = ScalarLaw::constant();
  SharedSparse mass;                 ///< M; symmetric positive (semi-)definite
  SharedList<MatrixTerm> damping;    ///< C_i, may be unsymmetric (gyroscopics)
  SharedList<MatrixTerm> stiffness;  ///< K_i, may be unsymmetric (torque)
  std::vector<LoadTerm> loads;
  std::vector<PointSet> points;
  Vector initialDisplacement;  ///< q(0)
  Vector initialVelocity;      ///< q'(0)

  /// Recovery of physical output dofs: D = recoveryOffset + recovery q (rows: node-major, all
  /// components, held ones too).
  SharedSparse recovery;
  Vector recoveryOffset;
  SharedList<std::int64_t>
      recoveryNodes;  ///< node numbers of the output rows, componentNames.size() rows each

  int size() const { return static_cast<int>(mass.rows()); }
  /// Index of the law with this name, added if new.
  int lawIndex(const ScalarLaw& law);
  /// sum_i c_i(t) C_i, sum_i k_i(t) K_i, sum_j f_j(t) F_j as new matrices (set-up code and tests,
  /// not the step loop).
  Sparse dampingAt(double t) const;
  Sparse stiffnessAt(double t) const;
  Vector loadAt(double t) const;
  /// Point forces R' f(d, d', t) (set-up code and tests).
  Vector pointForce(double t, const Vector& q, const Vector& qDot) const;
  /// -sum R' (df/dd) R: stiffness of the point laws about a state (set-up code and tests).
  Sparse pointStiffness(double t, const Vector& q, const Vector& qDot) const;
  /// Dofs with a load but without an entry in M, C_i, K_i and the rows of points: their motion is
  /// not determined.
  std::vector<int> loadsOnNothing() const;
  /// Throws ModelError with the inconsistency (sizes, non-finite entries, law indices).
  void validate() const;
};

}  // namespace tooljoint::model
