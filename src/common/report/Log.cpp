// SPDX-License-Identifier: BSD-3-Clause
#include "common/report/Log.hpp"

#include <algorithm>
#include <iostream>
#include <map>
#include <optional>

#include "common/Parallel.hpp"
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

/// Warnings that were not printed: their kind (withoutNumbers), and their number. Empty without a
/// WarnOnce.
std::optional<std::map<std::string, int>> likewise_;
std::vector<std::string>* hearing_ = nullptr;  ///< of a Hearing

void print(const std::string& warning) {
  if (parallel::rank() == 0)
    std::cerr << terminal::labelled("warning:", terminal::Colour::Yellow, warning) << std::endl;
}

}  // namespace

void setQuiet(bool quiet) { quiet_ = quiet; }
bool quiet() { return quiet_; }

void info(const std::string& line) {
  if (quiet_ || parallel::rank() != 0) return;
  std::cout << terminal::wrapped(line) << std::endl;
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
