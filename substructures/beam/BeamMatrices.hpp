// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Matrices of the two-node, twelve-dof beam element in its own frame: u, v, w, theta_x, theta_y,
/// theta_z of node 1, then of node 2; z along the element, u' = +theta_y, v' = -theta_x. Nguyen et
/// al. 2020, section 2.1.
#pragma once

#include <Eigen/Core>

#include "common/Types.hpp"
#include "substructures/beam/Section.hpp"

namespace tooljoint::beam {

using Matrix12 = Eigen::Matrix<double, 12, 12>;
using Vector12 = Eigen::Matrix<double, 12, 1>;

/// K_a: axial E S/l, torsion G J/l, Timoshenko bending E I/(l^3 (1+phi)) in both planes [N/m, N, N
/// m].
Matrix12 stiffness(const Section& section, double length);

/// M_a: consistent (cubic Hermite) with rotary inertia rho I; linear in the axial and torsional
/// dofs [kg, kg m, kg m2].
Matrix12 mass(const Section& section, double length);

/// C_ac of the kinetic energy Omega D' C_ac D' with density rho I_p theta_y dtheta_x/dt [kg m2].
/// The left-hand side of the equation of motion has Omega (C_ac' - C_ac) dD/dt and dOmega/dt C_ac'
/// D.
Matrix12 gyroscopic(const Section& section, double length);

/// F_thetaz: rho I_p l/2 at theta_z of either end [kg m2]; the load is -dOmega/dt F_thetaz.
Vector12 spinLoad(const Section& section, double length);

/// Geometric stiffness of a unit axial force (tension positive), int (u' du' + v' dv') dz, equation
/// (4) [1/m, 1, m].
Matrix12 geometricAxial(double length);

/// Geometric stiffness of a unit torque (right-handed about z), int (v' du'' - u' dv'') dz on the
/// left-hand side, equation (5); not symmetric.
Matrix12 geometricTorque(double length);

/// Lateral integrals over both planes with the Hermite shape functions N of u and v.
Matrix12 lateralMass(double length);        ///< int N' N dz [m]
Matrix12 lateralSlope(double length);       ///< int N' dN/dz dz [1]
Matrix12 lateralSlopeSlope(double length);  ///< int dN/dz' dN/dz dz [1/m]; equals geometricAxial

/// int N' N dz of the axial displacement w (linear shape functions) [m].
Matrix12 axialMass(double length);

/// Consistent load [N, N m] of a constant distributed force q [N/m] in element axes: q l/2 at the
/// ends with end moments of magnitude q l^2/12.
Vector12 distributedLoad(const Vector3& q, double length);

/// blkdiag(E'Q1, E'Q1, E'Q2, E'Q2): turns dofs in the nodal frames Q1, Q2 into dofs in the element
/// frame E (columns are axes), so that K_nodal = R' K_element R.
Matrix12 rotation12(const Matrix3& element, const Matrix3& node1, const Matrix3& node2);

/// The same for terms that depend on slopes only (geometric stiffness, loads along the element).
/// The axis a of a cross section changes by theta x a, and the spin about a does not contribute:
/// rotation12(...) of theta - (theta.a) a. With rotation12 itself, the spin of a node would tilt
/// the chord of a curved element by theta_z kappa l/2. \param axis1, axis2  a of both ends in their
/// nodal frames
Matrix12 slopeRotation(const Matrix12& rotation, const Vector3& axis1, const Vector3& axis2);

/// Element triad from its end points and nodal triads: z on the chord, x and y from the mean of the
/// nodal y axes. ModelError if the points coincide or the mean y axis lies on the chord.
Matrix3 elementTriad(const Vector3& x1, const Vector3& x2, const Matrix3& node1,
                     const Matrix3& node2);

}  // namespace tooljoint::beam
