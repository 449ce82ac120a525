// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Small text helpers: suggestions for misspelt names, numbers as text, splitting and joining.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace tooljoint {

/// Edit distance (insertions, deletions, substitutions, swaps of neighbours), case matters.
std::size_t editDistance(std::string_view a, std::string_view b);

/// The candidate most similar to `name`, or "" if none is similar enough. Differences of case,
/// blanks, "_" and "-" count little; among equal ones the first is returned.
std::string closest(std::string_view name, const std::vector<std::string>& candidates);

/// Shortest text that reads back as the same double ("0.1", "2.1e+11"); "inf", "-inf", "nan" for
/// the others.
std::string formatNumber(double value);
std::string formatNumber(int value);

/// A count with three digits, "1.2e+09"; below 1e6 with all digits.
std::string countText(double count);

/// Removes leading and trailing white space.
std::string trim(std::string_view text);
std::string lower(std::string_view text);
std::string upper(std::string_view text);
std::vector<std::string> split(std::string_view text, char separator);
std::string join(const std::vector<std::string>& parts, const std::string& separator);

/// The first `most` lines of a message; if there are more, "WHERE: 12 more errors follow." is
/// added.
std::string firstLines(std::vector<std::string> lines, std::size_t most, const std::string& where);

/// Largest number of characters of a value quoted in a message.
constexpr std::size_t longestQuote = 200;

/// Replaces every byte that is not part of a printable UTF-8 character by "\\x1b" and the like.
std::string printable(std::string_view text);

/// The printable text, cut to `most` bytes with "..." at its end where it is longer.
std::string excerpt(std::string_view text, std::size_t most = longestQuote);

/// `"text"`, shortened by excerpt().
std::string inQuotes(std::string_view text);

/// The text in shell syntax, in single quotes if needed.
std::string inShellQuotes(const std::string& text);

/// `"a", "b", "c"`, each shortened by excerpt().
std::string quotedList(const std::vector<std::string>& parts);

}  // namespace tooljoint
