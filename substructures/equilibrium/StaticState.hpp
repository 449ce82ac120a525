// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The static state of the string in the well: displacements, contact, element forces, and the
/// torque balance.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "common/Types.hpp"
#include "substructures/beam/BeamMatrices.hpp"

namespace tooljoint::equilibrium {

/// One stage of the recipe.
struct StageReport {
  std::string name;
  int iterations = 0;
  double residual = 0.0;
};

struct StaticReport {
  bool converged = false;
  int iterations = 0;     ///< Newton iterations of all stages
  double residual = 0.0;  ///< scaled residual norm of the last stage
  std::vector<StageReport> stages;
};

/// Solution of (K_pa + K_gpo(D)) D = F_s + F_cs(D) + R_ipa (Nguyen et al. 2020, equation 19).
struct StaticState {
  Vector displacement;  ///< D_s, 6 per node, nodal frames [m, rad]
  Vector normalForce;  ///< K_c(G) G per node, positive in contact, 0 where there is no contact node
                       ///< [N]
  Vector tangentialForce;  ///< friction force along the direction of rotation per node, negative
                           ///< against Omega > 0 [N]
  Vector frictionTorque;   ///< per node about z [N m]
  Vector axialFriction;    ///< friction force along the hole per node, downwards positive [N]
  Vector gap;  ///< G per node, positive in contact; NaN-free: -infinity where there is no contact
               ///< node [m]
  Matrix contactForce;  ///< of the wall on the string along u and v, 2 x nodes [N]
  Vector reaction;      ///< of the supports on the string, 6 per node; 0 at free dofs [N, N m]
  Vector axialForce;    ///< F_apo per element, element frames, equation (20) [N]
  Vector torque;        ///< T_apo per element [N m]
  /// K_gpo(D_s) of each element in nodal frames; zero matrices when geometric stiffness is off.
  std::vector<beam::Matrix12> geometricStiffness;

  int contactNodes = 0;        ///< laterally free nodes with G > 0
  int compressedElements = 0;  ///< elements with F_apo < 0
  double topAxialForce = 0.0;  ///< F_apo of the first element, the tension in its middle [N]
  double hookLoad = 0.0;  ///< axial force of the support of the first node on the string; 0 if no
                          ///< node moves along it [N]
  double lastElementAxialForce = 0.0;
  double lastElementTorque = 0.0;
  double maxNormalForce = 0.0;
  int maxNormalForceNode = 0;  ///< 1-based, 0 when nothing touches
  double totalNormalForce = 0.0;
  double topTorque = 0.0;      ///< T_apo of the first element, from displacements [N m]
  double appliedTorque = 0.0;  ///< theta_z entries of F_s and of the support reactions below the
                               ///< first node (TOB, usually), summed [N m]
  double totalFrictionTorque = 0.0;  ///< [N m]
  double torqueScale = 0.0;  ///< the largest of |appliedTorque| + sum |friction torque|, E I
                             ///< kappa_max of the well and the largest axial force at 1 um [N m]
  /// Top torque that balances loads, friction and the supports below [N m].
  double topTorqueEquilibrium() const { return appliedTorque + totalFrictionTorque; }
  /// topTorque - topTorqueEquilibrium [N m]: zero for a shaft that turns freely about its curved
  /// axis.
  double torqueBalanceDefect() const { return topTorque - topTorqueEquilibrium(); }
  /// |torqueBalanceDefect| / torqueScale; 0 for a string without torque in a straight well.
  double relativeTorqueDefect() const {
    return torqueScale > 0.0 ? std::abs(torqueBalanceDefect()) / torqueScale : 0.0;
  }
  StaticReport report;
};

}  // namespace tooljoint::equilibrium
