// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Components in which errors of a motion of imported parts are measured.
#pragma once

#include <vector>

#include "model/DofLabel.hpp"

namespace tooljoint::cases {

/// Positions of the translations among the components of a node, or of all components if there are
/// no translations.
std::vector<int> measuredComponents(const model::ComponentNames& names);

}  // namespace tooljoint::cases
