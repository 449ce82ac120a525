// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Builds the equations of motion of a meshed string in a well. Effects that the scene does not
/// have are not built.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "substructures/drillstring/DrillString.hpp"
#include "substructures/drillstring/StringModel.hpp"
#include "substructures/loads/Damping.hpp"
#include "substructures/loads/Load.hpp"
#include "substructures/mud/MudModel.hpp"
#include "substructures/path/PathState.hpp"
#include "substructures/well/Well.hpp"

namespace tooljoint::drillstring {

/// Input of buildEquations; the references must outlive only that call.
struct EquationInput {
  const DrillString& string;
  const well::Well& well;
  const path::PathState& path;
  const std::vector<char>& held;       ///< 6 nodes; 1 where a support holds the dof
  const mud::MudModel* mud = nullptr;  ///< null: no mud
  const loads::RotarySpeed& rotary;
  const loads::Loads& loads;
  const loads::RayleighDamping& damping;
};

/// The equations at the path state, and the terms that the static state balances.
struct PathEquations {
  /// M, C, K and all loads, without static geometric stiffness and contact; the state is zero.
  StringModel model;
  std::vector<beam::Matrix12> stiffness;  ///< K_pa: the stiffness of each element that is constant
                                          ///< in time, in nodal frames
  Vector load;          ///< F_s: the loads that are constant in time, without R_ipa [N, N m]
  Vector pathReaction;  ///< R_ipa; empty if zero [N, N m]
  std::optional<std::size_t> rayleigh;  ///< position of the Rayleigh damping in model.damping
};

/// M, C and K at the path state (K_pa = K_a + K_gpa + K_fe, or the corotational tangent if the path
/// state has one), the loads F_s, R_ipa, F_u and -dOmega/dt F_thetaz (Nguyen et al. 2020, equations
/// 19 and 27).
PathEquations buildEquations(const EquationInput& input);

/// The equations of motion about the static state D_s, from which the motion starts: with the
/// geometric stiffness K_gpo(D_s), its part of the Rayleigh damping, and contact.
StringModel linearise(PathEquations equations,
                      const std::vector<beam::Matrix12>& staticGeometricStiffness,
                      const Vector& state, const loads::RayleighDamping& damping,
                      ContactBatch contact = {});

}  // namespace tooljoint::drillstring
