// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Vibration modes of a free part, with its rigid-body modes detected.
#pragma once

#include "reduction/part/PartView.hpp"
#include "reduction/vectors/InteriorVectors.hpp"

namespace tooljoint::reduction {

/// omega^2 M phi = sym(K) phi without fixed dofs, M-normalised: the modes are real; skew parts of K
/// and the damping act on them through the projection. Groups are the sets of dofs coupled by mass
/// and stiffness. A mode is rigid when |phi' K phi| <= 1e-12 |phi|' |K| |phi| and K phi and K' phi
/// are rounding (1e-7 of |K| |phi|); all rigid-body modes are kept whatever the request. Throws
/// ModelError (mass not positive definite) or ConvergenceError of the eigensolver, with the part.
InteriorVectors freeInterfaceModes(const PartView& part, const ModeRequest& request);

}  // namespace tooljoint::reduction
