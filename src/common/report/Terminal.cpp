// SPDX-License-Identifier: BSD-3-Clause
#include "common/report/Terminal.hpp"

#include <cstdlib>
#include <unistd.h>

namespace tooljoint::terminal {

namespace {

/// Select Graphic Rendition of ECMA-48, section 8.3.117.
const char* code(Colour colour) {
  switch (colour) {
    case Colour::Bold:
      return "1";
    case Colour::Red:
      return "31";
    case Colour::Green:
      return "32";
    case Colour::Yellow:
      return "33";
  }
  return "0";
}

}  // namespace

bool hasColours(int descriptor) {
  const char* none = std::getenv("NO_COLOR");
  if (none != nullptr && *none != '\0') return false;
  const char* kind = std::getenv("TERM");
  if (kind == nullptr || std::string(kind) == "dumb") return false;
  return isatty(descriptor) == 1;
}

std::string coloured(const std::string& text, Colour colour, int descriptor) {
  if (!hasColours(descriptor)) return text;
  return std::string("\033[") + code(colour) + "m" + text + "\033[0m";
}

}  // namespace tooljoint::terminal
