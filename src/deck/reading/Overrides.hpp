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

/// Put each override into `scene`, creating declared lists that are not there yet; its type is the
/// one `spec` declares (in lists that pass through to Trilinos: the type of the parameter it
/// replaces, else the one its text looks like). The scene's own name and a "/" may stand in front
/// of PATH. "!PATH" takes the list or parameter PATH out of the deck (`--without PATH`). Faults are
/// added to `findings`; an override without "=" or path is a UsageError.
void applyOverrides(RawList& scene, const ListSpec& spec, const std::vector<std::string>& overrides,
                    std::vector<Finding>& findings);

}  // namespace tooljoint::deck
