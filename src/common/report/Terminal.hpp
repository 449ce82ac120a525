// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Colours on terminals, and nothing but the text elsewhere.
#pragma once

#include <string>

namespace tooljoint::terminal {

enum class Colour { Bold, Red, Green, Yellow };

/// Whether text on this descriptor (1: standard output, 2: standard error) may be coloured: it is a
/// terminal, TERM is not "dumb", and NO_COLOR (https://no-color.org) is absent or empty.
bool hasColours(int descriptor);

/// The text in a colour where the descriptor has colours, else as it is.
std::string coloured(const std::string& text, Colour colour, int descriptor);

}  // namespace tooljoint::terminal
