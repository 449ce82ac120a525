// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Mud that flows down the string and up the annulus: contributions to the matrices and loads of
/// one beam element.
///
/// The inner flow U_i = Q/A_i goes down the string, the annular flow U_o = Q/A_ch comes back up.
/// With
///
///     A_i = pi R_i^2,  A_o = pi R_e^2,  A_ch = pi (R_w^2 - R_e^2),  gamma = R_e/R_w,
///     chi = (R_w^2 + R_e^2)/(R_w^2 - R_e^2),  m_i = rho_f A_i,  m_a = chi rho_f A_o
///
/// the left-hand side of an element gains, laterally (N: lateral shape functions, N_z = dN/dz),
///
///     mass       (m_i + m_a) int N'N
///     damping    (c_ax + c_rot sqrt|Omega|) int N'N + (m_i U_i - m_a U_o) (int N'N_z - int N_z'N)
///     stiffness  -(m_i U_i^2 + m_a U_o^2) int N_z'N_z
///
/// and the right-hand side the load (rho_f A_i - rho_f A_o) g (buoyancy in effective-tension form,
/// without a pressure term) and the axial drag of the returning flow. The drag is the shear tau =
/// C_f rho_f U_o^2/(2 pi) on the string. The same tau on both walls causes the pressure loss dp/ds
/// = 2 tau/(R_w - R_e), which pushes a body of area A_o up by A_o dp/ds = R_e/(R_w - R_e) times the
/// drag (with `annularThrust`). Sources: Ritto, Soize and Sampaio (2009) for the axial flow, Chen
/// (1981) and Fritz (1970) for the confined added mass and viscous damping, as cited in section 2.3
/// of Nguyen et al. 2020.
#pragma once

#include "substructures/mud/MudModel.hpp"

namespace tooljoint::mud {

/// Values per length of one section in one bore; symbols as at the top of the file.
struct SectionFlow {
  double innerMass = 0.0;         ///< m_i [kg/m]
  double annulusMass = 0.0;       ///< m_a [kg/m]
  double confinement = 0.0;       ///< chi [-]
  double innerSpeed = 0.0;        ///< U_i, down the hole [m/s]
  double annulusSpeed = 0.0;      ///< U_o, up the hole [m/s]
  double axialFlowDamping = 0.0;  ///< c_ax = C_f rho_f D_o |U_o| / 2 [N s/m2]
  double rotationDamping = 0.0;   ///< c_rot = 2 sqrt(2) pi rho_f R_e sqrt(nu_f)
                                  ///< (1+gamma^3)/(1-gamma^2)^2 [N s/m2 per sqrt(rad/s)]
  double axialDrag = 0.0;         ///< -C_f rho_f D_o U_o |U_o| / 2, positive down the hole [N/m];
                                  ///< with the annular thrust over 1 - gamma
  double buoyantMass = 0.0;       ///< rho_f (A_i - A_o), to be added to rho S in the weight [kg/m]
};

class AnnularFlow : public MudModel {
 public:
  explicit AnnularFlow(const MudProperties& properties);

  /// Flow values for body radii R_i, R_e (never a gauge radius) in a bore of radius R_w [m]. R_w
  /// may be infinite. Throws ModelError when the body does not fit the bore, or when mud is pumped
  /// through a solid section.
  SectionFlow flow(double innerRadius, double outerRadius, double boreRadius) const;

  /// Counted as "mud matrices" (EvaluationCounters.hpp). Errors as flow(), and ModelError for a
  /// section without radii.
  ElementContribution element(const beam::Section& section, double boreRadius, double length,
                              const Vector3& gravity) const override;

 private:
  MudProperties properties_;
};

}  // namespace tooljoint::mud
