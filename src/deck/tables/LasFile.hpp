// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Logs in the Log ASCII Standard, version 2.0 (Canadian Well Logging Society, 1992, updated 2014).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "deck/tables/ColumnHeading.hpp"
#include "deck/tables/DelimitedText.hpp"

namespace tooljoint::deck {

struct LasFile {
  std::vector<ColumnHeading> curves;  ///< of ~C, the index first
  int curveLine = 0;                  ///< line of ~C
  std::optional<double> null;         ///< value for "not measured" (NULL of ~W)
  std::vector<DelimitedRow> rows;     ///< of ~A, as many cells as curves; wrapped lines are joined
};

/// True for a text that begins, after comments and empty lines, with a section ("~").
bool looksLikeLas(const std::string& text);

/// Reads the sections ~V, ~C and ~A, and NULL of ~W; the others are ignored. Supports versions 1.2
/// and 2.0, which differ only in ignored texts. DeckError, a line for each fault, with `file`,
/// line, text found and text expected: no ~V at the beginning, another version, no WRAP, a line
/// without ".", no ~C or ~A, a row whose number of values differs from the number of curves.
LasFile parseLas(const std::string& text, const std::string& file);

}  // namespace tooljoint::deck
