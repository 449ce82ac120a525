// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Colours on terminals, and nothing but the text elsewhere; lines of a limited width everywhere.
#pragma once

#include <cstddef>
#include <string>

namespace tooljoint::terminal {

enum class Colour { Bold, Red, Green, Yellow };

/// Whether text on this descriptor (1: standard output, 2: standard error) may be coloured: it is a
/// terminal, TERM is not "dumb", and NO_COLOR (https://no-color.org) is absent or empty.
bool hasColours(int descriptor);

/// The text in a colour where the descriptor has colours, else as it is.
std::string coloured(const std::string& text, Colour colour, int descriptor);

/// Lines have at most so many columns.
constexpr std::size_t columns = 100;

/// The text with every line that is wider than `columns` broken at blanks. What is left of a line
/// stands below the text behind its label (which ends with two blanks), or `hanging` columns
/// further in than the line. A word longer than a line stays whole.
std::string wrapped(const std::string& text, std::size_t hanging = 2);

/// "LABEL text" for standard error, the label in a colour, wrapped.
std::string labelled(const std::string& label, Colour colour, const std::string& text);

}  // namespace tooljoint::terminal
