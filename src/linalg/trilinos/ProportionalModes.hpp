// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Damped modes of symmetric matrices with proportional damping.
#pragma once

#include <optional>

#include "linalg/trilinos/DampedPencil.hpp"

namespace tooljoint::linalg {

/// Modes of a pencil with symmetric K and proportional damping, C = alpha M + beta K, from the
/// symmetric modes, which such damping does not couple. A mode with omega^2 >= lambda has no |s|
/// below sqrt(lambda) or, if overdamped, below lambda / (|alpha| + |beta| lambda). Enough modes are
/// computed to ensure that the lowest `count` |s| are among them. Empty for other pencils, or if
/// too many modes would be needed, because stiffness-proportional damping accumulates the values of
/// all high modes at 1 / beta.
std::optional<DampedModes> proportionalModes(const ScaledPencil& pencil, int count,
                                             const DofNamer& name);

}  // namespace tooljoint::linalg
