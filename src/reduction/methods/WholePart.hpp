// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A part that is not reduced.
#pragma once

#include "reduction/ReductionMethod.hpp"

namespace tooljoint::reduction {

/// The basis Phi = I (up to order): interior dofs are kept like retained dofs, so the part is exact
/// and its matrices stay sparse. With all n modes of its interior it would be exact too, but with
/// n^2 entries instead of a multiple of n.
Basis wholePart(const PartView& part);

/// True for such a basis.
bool isWhole(const Basis& basis);

}  // namespace tooljoint::reduction
