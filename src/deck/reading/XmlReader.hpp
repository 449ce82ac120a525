// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Phase 1: XML text -> tree of lists and parameters with line numbers. Internal to src/deck.
#pragma once

#include <string>

#include "deck/reading/Tree.hpp"

namespace tooljoint::deck {

/// Largest size of a deck; a larger file is rejected.
constexpr std::size_t largestDeck = 64UL * 1024UL * 1024UL;

/// The whole text of a file. Throws FileError if it is missing, not a regular file, unreadable or
/// longer than largestDeck.
std::string readTextFile(const std::string& file);

/// Lexical reading of a deck; all faults are collected in one DeckError. Document type definitions
/// and entities are rejected; no other source is loaded.
RawList readXml(const std::string& text, const std::string& file);

}  // namespace tooljoint::deck
