// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Commented XML decks to start from, written from the descriptions the reader checks decks
/// against.
#pragma once

#include <map>
#include <string>

#include "deck/ListSpec.hpp"

namespace tooljoint::deck {

/// Values by their path below the root, lists separated by "/": {"Well/Bore Radius", "0.108"}. They
/// say what types and ranges cannot.
using Examples = std::map<std::string, std::string>;

/// A deck named `name` in the order of declaration: required parameters and lists stand with an
/// example value, everything optional is commented out, each element with its sentence above it
/// (the list of a variant that is chosen and needs values stands too). What `examples` name
/// stands with the value there, and so do the lists it is in; among lists with names of one's own
/// they name one. It reads without errors of the phases 1 and 2, as it is and, without examples,
/// with every element that is commented out taken in. `most`: with Level::Basic optional parameters
/// for experts are left out.
std::string templateXml(const ListSpec& root, const std::string& name,
                        const Examples& examples = {}, Level most = Level::Expert);

/// A template with every element that is commented out taken in.
std::string uncommented(const std::string& templateText);

}  // namespace tooljoint::deck
