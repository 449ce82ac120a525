// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Changes of a part from its file to the model.
#pragma once

#include <string>
#include <vector>

#include "parts/file/PartFile.hpp"

namespace tooljoint::parts {

/// "u of node 3" or "mode 2".
std::string dofName(const model::SecondOrderModel& m, int position);

/// The labels of the part in `names`, which hold all of its own; recovery gets rows of zeros for
/// the new ones.
void widen(PartContent& content, const model::ComponentNames& names);

/// Removes fixed dofs with their rows and columns; their recovery is 0. `held` has one flag per
/// dof.
void hold(PartContent& content, const std::vector<char>& held);

/// Positions that a text of the deck means: "5", "5 u v", "clamp", "clamp u". DeckError (without
/// place) when there are none.
std::vector<int> positionsOf(const PartContent& content, const std::string& text);

}  // namespace tooljoint::parts
