// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Commented XML decks to start from, written from the descriptions the reader checks decks against.
#pragma once

#include <string>

#include "deck/ListSpec.hpp"

namespace tooljoint::deck {

/// A deck named `name` in the order of declaration: required parameters and lists stand with an example value, everything
/// optional is commented out line by line, each with its sentence above it (the list of a variant that is chosen and needs values
/// stands too). It reads without errors of the phases 1 and 2, as it is and with every commented line taken in.
std::string templateXml(const ListSpec& root, const std::string& name);

/// A template with every commented-out line taken in.
std::string uncommented(const std::string& templateText);

}  // namespace tooljoint::deck
