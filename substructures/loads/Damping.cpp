// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/loads/Damping.hpp"

namespace tooljoint::loads {

deck::ListSpec dampingParameters() {
  using deck::Range;
  return deck::ListSpec(
             "Damping",
             "Rayleigh damping of the string; without this list the string itself has no damping.")
      .real("Mass Coefficient", "1/s", 0.0, Range::nonNegative(),
            "Factor of the string's mass matrix in the damping matrix.")
      .real("Stiffness Coefficient", "s", 0.0, Range::nonNegative(),
            "Factor of the string's stiffness, pre-stress included, in the damping matrix.");
}

RayleighDamping readDamping(const Teuchos::ParameterList& list) {
  return {list.get<double>("Mass Coefficient"), list.get<double>("Stiffness Coefficient")};
}

}  // namespace tooljoint::loads
