// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace tooljoint::transient {

/// Step of Generalized-alpha if the deck gives none [s].
constexpr double defaultAlphaStep = 1e-3;

}  // namespace tooljoint::transient
