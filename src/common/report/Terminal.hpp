// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Colours on terminals, plain text elsewhere; lines of limited width everywhere.
#pragma once

#include <cstddef>
#include <string>

namespace tooljoint::terminal {

enum class Colour { Bold, Red, Green, Yellow };

/// True if text on this descriptor (1: standard output, 2: standard error) may be coloured: it is a
/// terminal, TERM is not "dumb", and NO_COLOR (https://no-color.org) is absent or empty.
bool hasColours(int descriptor);

/// The text in a colour if the descriptor has colours, otherwise unchanged.
std::string coloured(const std::string& text, Colour colour, int descriptor);

/// Largest width of a line.
constexpr std::size_t columns = 100;

/// Breaks every line of the text that is wider than `columns` at blanks. A continuation line begins
/// below the text after the label (which ends with two blanks), or `hanging` columns to the right
/// of the line. A word longer than a line is not broken.
std::string wrapped(const std::string& text, std::size_t hanging = 2);

/// "LABEL text" for standard error, the label in a colour, wrapped.
std::string labelled(const std::string& label, Colour colour, const std::string& text);

}  // namespace tooljoint::terminal
