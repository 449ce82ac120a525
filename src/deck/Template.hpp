// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Commented XML decks to start from, written from the descriptions that the reader checks decks
/// against.
#pragma once

#include <map>
#include <string>

#include "deck/ListSpec.hpp"

namespace tooljoint::deck {

/// Values by their path below the root, lists separated by "/": {"Well/Bore Radius", "0.108"}, for
/// values that do not follow from types and ranges.
using Examples = std::map<std::string, std::string>;

/// A deck named `name` in the order of declaration. Required parameters and lists have an example
/// value; everything optional is commented out, except the list of a chosen variant that requires
/// values. Each element has its sentence above it. Elements in `examples` have the value given
/// there, and the lists that contain them are active; for lists with user-defined names they define
/// one list. The deck passes phases 1 and 2 as it is and, without examples, with every commented
/// element activated. `most`: Level::Basic omits optional parameters for experts.
std::string templateXml(const ListSpec& root, const std::string& name,
                        const Examples& examples = {}, Level most = Level::Expert);

/// A template with every commented element activated.
std::string uncommented(const std::string& templateText);

}  // namespace tooljoint::deck
