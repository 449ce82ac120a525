// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Geometrically exact kinematics around a small-strain element: the frame on the chord takes the
/// rigid motion, the remaining deformation is small. After Crisfield (1990) and Le, Battini, Hjiaj,
/// Comput. Methods Appl. Mech. Engrg. 201-204 (2012).
#pragma once

#include "common/Types.hpp"
#include "substructures/beam/BeamMatrices.hpp"

namespace tooljoint::beam {

/// Positions of the two nodes of an element and rotation matrices whose columns are the nodal axes.
/// An unstrained straight element has both triads equal to its own, z on the chord.
struct ElementPose {
  Vector3 position1;
  Vector3 position2;
  Matrix3 triad1;
  Matrix3 triad2;
};

/// Forces and tangent of the element in a pose.
struct CorotationalResponse {
  Matrix3 frame =
      Matrix3::Identity();  ///< E: z on the chord, x and y from the mean of the nodal y axes
  double length = 0.0;      ///< chord length [m]
  double axialForce = 0.0;  ///< N [N]
  double torque = 0.0;      ///< about the chord [N m]
  Vector3 rotation1;        ///< local rotations (logarithm) in element axes [rad]
  Vector3 rotation2;
  Vector12 force;    ///< internal forces and spatial moments at the nodes, global axes [N, N m]
  Matrix12 tangent;  ///< d force / d (positions, spatial spins), global axes; zero unless requested
};

/// Corotational element: a linear element in the frame of its chord.
class CorotationalElement {
 public:
  /// `stiffness` is that of the linear element in its own frame. Straight and unstrained at length
  /// l0 [m] when its nodal triads coincide with its own.
  CorotationalElement(const Matrix12& stiffness, double initialLength);

  /// For a mesh that is not straight at rest: the element triad E0 and the nodal triads at rest.
  CorotationalElement(const Matrix12& stiffness, double initialLength, const Matrix3& element0,
                      const Matrix3& node1, const Matrix3& node2);

  double initialLength() const { return initialLength_; }

  /// Internal force and, if requested, its exact derivative (not symmetric away from equilibrium,
  /// since moments work on spins). Throws ModelError when the nodes coincide. Local rotations must
  /// stay below pi.
  CorotationalResponse evaluate(const ElementPose& pose, bool withTangent) const;

 private:
  double initialLength_;
  double axialStiffness_;                   ///< E S/l0 of a beam
  double torsionalStiffness_;               ///< G J/l0 of a beam
  Eigen::Matrix<double, 6, 6> rotational_;  ///< local moments against local rotations of both ends
  Matrix3 attach1_ =
      Matrix3::Identity();  ///< turns the nodal triad into the element triad of the state at rest
  Matrix3 attach2_ = Matrix3::Identity();
};

}  // namespace tooljoint::beam
