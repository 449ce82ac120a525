// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Static responses of a part divided into substructures.
#pragma once

#include "reduction/multilevel/TreeFactor.hpp"
#include "reduction/part/PartView.hpp"

namespace tooljoint::reduction {

/// phi_C = -K_II^-1 K_IC with the symmetric K, without the shift of the factors: conjugate
/// gradients with the factors as preconditioner, in blocks of columns. Collective. ModelError if
/// the interior is a mechanism although the boundary dofs are held.
ConstraintModes treeConstraintModes(const PartView& part, const TreeFactor& factor);

}  // namespace tooljoint::reduction
