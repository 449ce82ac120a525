// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Checks made on every basis: rank, static exactness, zero-energy modes, largest frequency.
#pragma once

#include "reduction/ReductionMethod.hpp"
#include "reduction/project/Projection.hpp"

namespace tooljoint::reduction {

/// Stability limit of RK4: omega dt <= 2.78 (2.83 without damping, Hairer and Wanner 1996, with a
/// margin).
constexpr double rk4StabilityLimit = 2.78;

/// Fills the checked part of `report`. Throws ModelError when the reduced mass is not positive
/// definite.
void checkBasis(const PartView& part, const Basis& basis, const ProjectedMatrices& reduced,
                BasisReport& report);

}  // namespace tooljoint::reduction
