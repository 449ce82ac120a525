// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Damped modes of symmetric matrices with proportional damping.
#pragma once

#include <optional>

#include "linalg/trilinos/DampedPencil.hpp"

namespace tooljoint::linalg {

/// The modes of a pencil with symmetric K and proportional damping, C = alpha M + beta K: those of
/// the symmetric modes, which such damping does not couple. Of a mode with omega^2 >= lambda no |s|
/// is below sqrt(lambda) or, overdamped, lambda / (|alpha| + |beta| lambda): enough modes are
/// computed to know that the lowest `count` |s| are among them. Nothing when the pencil is another,
/// or when these are too many, where stiffness-proportional damping gathers the values of all high
/// modes at 1 / beta.
std::optional<DampedModes> proportionalModes(const ScaledPencil& pencil, int count,
                                             const DofNamer& name);

}  // namespace tooljoint::linalg
