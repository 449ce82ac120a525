// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Changes of a part between its file and the model.
#pragma once

#include <string>
#include <vector>

#include "parts/file/PartFile.hpp"

namespace tooljoint::parts {

/// "u of node 3" or "mode 2".
std::string dofName(const model::SecondOrderModel& m, int position);

/// Relabels the part with `names`, which contain all of its own; recovery gets rows of zeros for
/// the new ones.
void widen(PartContent& content, const model::ComponentNames& names);

/// Removes fixed dofs with their rows and columns; their recovery is 0. `held` has one flag per
/// dof.
void hold(PartContent& content, const std::vector<char>& held);

/// Positions for a text of the deck: "5", "5 u v", "clamp", "clamp u". DeckError (without position)
/// if there are none.
std::vector<int> positionsOf(const PartContent& content, const std::string& text);

}  // namespace tooljoint::parts
