// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Vibration modes of the interior with all boundary dofs fixed.
#pragma once

#include <string>
#include <vector>

#include "reduction/part/PartView.hpp"
#include "reduction/vectors/InteriorVectors.hpp"

namespace tooljoint::reduction {

/// omega^2 M_II phi = sym(K)_II phi (Nguyen et al. 2020, (35), with the symmetric part of K: the
/// modes are real; the skew part acts on them through the projection), M_II-normalised, by
/// increasing eigenvalue, then block. Groups are the interior blocks. Throws ModelError or
/// ConvergenceError of the eigensolver, with the part and `what`.
InteriorVectors fixedInterfaceModes(const PartView& part, const ModeRequest& request,
                                    const std::string& what = "fixed-interface modes");

/// The same for some interior blocks.
InteriorVectors fixedInterfaceModes(const PartView& part, const ModeRequest& request,
                                    const std::vector<int>& blocks, const std::string& what);

}  // namespace tooljoint::reduction
