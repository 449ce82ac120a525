// SPDX-License-Identifier: BSD-3-Clause
#include "common/report/Log.hpp"

#include <algorithm>
#include <iostream>
#include <map>
#include <optional>
#include <unistd.h>

#include "common/Parallel.hpp"
#include "common/Text.hpp"
#include "common/report/Likewise.hpp"
#include "common/report/Terminal.hpp"
#include "common/report/WarnOnce.hpp"

namespace tooljoint::log {
namespace {

bool quiet_ = false;

std::vector<std::string>& collected() {
  static std::vector<std::string> lines;
  return lines;
}

/// Warnings that were not printed: their kind (withoutNumbers), and how many. Empty without a
/// WarnOnce.
std::optional<std::map<std::string, int>> likewise_;
std::vector<std::string>* hearing_ = nullptr;  ///< of a Hearing

void print(const std::string& warning) {
  if (parallel::rank() == 0)
    std::cerr << terminal::coloured("warning:", terminal::Colour::Yellow, STDERR_FILENO) << " "
              << warning << std::endl;
}

/// Lines of the log have at most so many columns.
constexpr std::size_t columns = 100;
/// Labels end before this column.
constexpr std::size_t labels = 40;

/// Column at which the text of a line begins: behind its label, which ends with two blanks, or two
/// columns further in than the line.
std::size_t hangingIndent(const std::string& line) {
  const std::size_t gap = line.substr(0, labels).rfind("  ");
  const std::size_t first = line.find_first_not_of(' ');
  return gap == std::string::npos || gap < first ? first + 2 : line.find_first_not_of(' ', gap);
}

/// The line broken at blanks; a word longer than a line stays whole.
std::string wrapped(std::string line) {
  std::string text;
  const std::size_t indent = hangingIndent(line);
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

void setQuiet(bool quiet) { quiet_ = quiet; }
bool quiet() { return quiet_; }

void info(const std::string& line) {
  if (quiet_ || parallel::rank() != 0) return;
  std::vector<std::string> lines = split(line, '\n');
  for (std::string& one : lines) one = wrapped(one);
  std::cout << join(lines, "\n") << std::endl;
}

Hearing::Hearing() { hearing_ = &lines_; }
Hearing::~Hearing() { hearing_ = nullptr; }

void warn(const std::string& line) {
  auto& lines = collected();
  if (hearing_ != nullptr && std::find(hearing_->begin(), hearing_->end(), line) == hearing_->end())
    hearing_->push_back(line);
  if (std::find(lines.begin(), lines.end(), line) != lines.end()) return;
  const auto kind = withoutNumbers(line);
  if (likewise_ && std::any_of(lines.begin(), lines.end(), [&](const std::string& known) {
        return withoutNumbers(known) == kind;
      })) {
    ++(*likewise_)[kind];
    return;
  }
  lines.push_back(line);
  print(line);
}

WarnOnce::WarnOnce() { likewise_.emplace(); }

WarnOnce::~WarnOnce() {
  for (auto& line : collected()) {
    const auto counted = likewise_->find(withoutNumbers(line));
    if (counted == likewise_->end()) continue;
    line += " (" + std::to_string(counted->second) + " further likewise)";
    print(line);
  }
  likewise_.reset();
}

const std::vector<std::string>& warnings() { return collected(); }
void clearWarnings() { collected().clear(); }

}  // namespace tooljoint::log
