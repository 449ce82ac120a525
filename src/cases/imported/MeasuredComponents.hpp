// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What errors of a motion of imported parts are measured in.
#pragma once

#include <vector>

#include "model/DofLabel.hpp"

namespace tooljoint::cases {

/// Positions of the translations among the components of a node, or of everything where there are
/// none.
std::vector<int> measuredComponents(const model::ComponentNames& names);

}  // namespace tooljoint::cases
