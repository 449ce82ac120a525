// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// `--set PATH=VALUE`: values of the command line that replace those of the deck. Internal to
/// src/deck.
#pragma once

#include <string>
#include <vector>

#include "deck/ListSpec.hpp"
#include "deck/reading/Tree.hpp"

namespace tooljoint::deck {

/// Applies each override to `scene` and creates declared lists that do not exist yet. Its type is
/// that of `spec` (in lists passed through to Trilinos: the type of the replaced parameter,
/// otherwise that suggested by its text). PATH may begin with the name of the scene and "/".
/// "!PATH" removes the list or parameter PATH (`--without PATH`). Faults are added to `findings`;
/// an override without "=" or path is a UsageError.
void applyOverrides(RawList& scene, const ListSpec& spec, const std::vector<std::string>& overrides,
                    std::vector<Finding>& findings);

}  // namespace tooljoint::deck
