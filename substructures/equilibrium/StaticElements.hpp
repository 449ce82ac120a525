// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Elements of the static problem: forces and stiffness that depend on the displacement.
#pragma once

#include <vector>

#include "substructures/beam/SparseAssembler.hpp"
#include "substructures/equilibrium/StaticInput.hpp"

namespace tooljoint::equilibrium {

/// Forces of the pretension of all elements on their nodes, 6 per node [N].
Vector pretensionForces(const StaticInput& input);

/// Vectors D of the whole string have 6 dofs per node in nodal frames; vectors of an element have
/// its 12 dofs.
class StaticElements {
 public:
  /// `input` must outlive the object.
  explicit StaticElements(const StaticInput& input);

  int size() const { return sizeOf(input_.elements); }
  /// D of the ends of an element, kinks included.
  beam::Vector12 motion(int element, const Vector& full) const;
  /// F_apo = F_0 + k_ww (w2 - w1), F_0 the pretension, and T_apo = k_theta (theta_z2 - theta_z1) in
  /// the element frame; for a beam k_ww = E S/l and k_theta = G J/l, equation (20) [N, N m].
  double axialForce(int element, const Vector& full) const;
  double torque(int element, const Vector& full) const;
  /// F_apo K_gF + T_apo K_gT of an element in nodal frames.
  beam::Matrix12 geometricStiffness(int element, const Vector& full) const;
  /// dK_gpo/dD D: F_apo and T_apo change with D.
  beam::Matrix12 geometricTangent(int element, const Vector& full) const;
  /// Adds K_gpo and, if `exact`, dK_gpo/dD D to k, and K_gpo d to the force, at the motion d.
  void addGeometric(int element, const beam::Vector12& d, bool exact, beam::Matrix12& k,
                    beam::Vector12& force) const;

 private:
  struct Unit {
    beam::Vector12 stretch, twist;  ///< w2 - w1 and theta_z2 - theta_z1 per unit of each dof
    double axialStiffness;          ///< k_ww [N/m]
    double torsionalStiffness;      ///< k_theta [N m]
    beam::Matrix12 axial, torque;   ///< K_gF and K_gT
  };
  const StaticInput& input_;
  std::vector<Unit> units_;
};

}  // namespace tooljoint::equilibrium
