// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Phase 1: XML text -> tree of lists and parameters with line numbers. Internal to src/deck.
#pragma once

#include <string>

#include "deck/reading/Tree.hpp"

namespace tooljoint::deck {

/// Largest deck that is read; anything longer is no deck.
constexpr std::size_t largestDeck = 64UL * 1024UL * 1024UL;

/// The whole text of a file. Throws FileError when it is missing, no regular file, not readable or
/// longer than largestDeck.
std::string readTextFile(const std::string& file);

/// Lexical reading of a deck; all faults are collected in one DeckError. Document type definitions
/// and entities are refused, nothing is loaded from anywhere else.
RawList readXml(const std::string& text, const std::string& file);

}  // namespace tooljoint::deck
