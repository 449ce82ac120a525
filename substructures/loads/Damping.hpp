// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Rayleigh damping of the string. Deck list `Damping`.
#pragma once

#include <Teuchos_ParameterList.hpp>

#include "deck/ListSpec.hpp"

namespace tooljoint::loads {

/// Rayleigh damping c_M M_a + c_K (K_a + K_gpa + K_gpo), (28) of Nguyen et al. 2020. Both 0 without
/// the deck list.
struct RayleighDamping {
  double massCoefficient = 0.0;       ///< c_M [1/s]
  double stiffnessCoefficient = 0.0;  ///< c_K [s]
  bool present() const { return massCoefficient != 0.0 || stiffnessCoefficient != 0.0; }
};

/// The deck list `Damping`.
deck::ListSpec dampingParameters();
/// From the validated deck list `Damping`.
RayleighDamping readDamping(const Teuchos::ParameterList& list);

}  // namespace tooljoint::loads
