// SPDX-License-Identifier: BSD-3-Clause
#include "common/report/Terminal.hpp"

#include <cstdlib>
#include <unistd.h>
#include <vector>

#include "common/Text.hpp"

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

/// Labels end before this column.
constexpr std::size_t labels = 40;

/// Column at which the continuation of a line begins: below the text after its label, which ends
/// with two blanks, or `hanging` columns to the right of the start of the line.
std::size_t hangingIndent(const std::string& line, std::size_t hanging) {
  const std::size_t gap = line.substr(0, labels).rfind("  ");
  const std::size_t first = line.find_first_not_of(' ');
  return gap == std::string::npos || gap < first ? first + hanging
                                                 : line.find_first_not_of(' ', gap);
}

std::string wrappedLine(std::string line, std::size_t hanging) {
  std::string text;
  const std::size_t indent = hangingIndent(line, hanging);
  while (line.size() > columns) {
    std::size_t end = line.rfind(' ', columns);
    if (end <= indent) end = line.find(' ', columns);
    if (end == std::string::npos) break;
    text += line.substr(0, line.find_last_not_of(' ', end) + 1) + "\n";
    const std::string rest = trim(line.substr(end));
    if (rest.empty()) return text.substr(0, text.size() - 1);
    line = std::string(indent, ' ') + rest;
  }
  return text + line;
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

std::string wrapped(const std::string& text, std::size_t hanging) {
  std::vector<std::string> lines = split(text, '\n');
  for (std::string& line : lines) line = wrappedLine(line, hanging);
  return join(lines, "\n");
}

std::string labelled(const std::string& label, Colour colour, const std::string& text) {
  return coloured(label, colour, STDERR_FILENO) + wrapped(label + " " + text).substr(label.size());
}

}  // namespace tooljoint::terminal
