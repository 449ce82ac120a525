// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Phase 2: names, types, ranges, choices and required parameters of a tree against its
/// description. Internal to src/deck.
#pragma once

#include <Teuchos_ParameterList.hpp>
#include <map>
#include <string>
#include <vector>

#include "deck/ListSpec.hpp"
#include "deck/reading/Tree.hpp"

namespace tooljoint::deck {

/// Position of each given list and parameter, by its path below the scene ("" the scene itself,
/// "Contact/Stiffness").
using Places = std::map<std::string, Place>;

/// The scene as a Teuchos list: quantities in SI, defaults filled into the existing lists. The
/// name() of every list is its full path ("/helical_170m/Contact"). Faults are added to `findings`;
/// the list is complete only if there are none.
Teuchos::ParameterList validate(const RawList& scene, const ListSpec& spec,
                                std::vector<Finding>& findings, Places& places);

/// `/scene/Contact/Stiffnes is not a parameter. Did you mean "Stiffness"? It is ...` with
/// suggestions from `list` (part of `root`).
std::string unknownParameter(const ListSpec& root, const ListSpec& list, const std::string& path,
                             const std::string& name);

/// The same for a list; `present` contains the user-defined lists if names are free.
std::string unknownList(const ListSpec& root, const ListSpec& list, const std::string& path,
                        const std::string& name, const RawList& present);

/// Puts a default into a list; nothing for Required and Optional.
void setDefault(Teuchos::ParameterList& list, const ParameterSpec& parameter);

}  // namespace tooljoint::deck
