// SPDX-License-Identifier: BSD-3-Clause
#include "common/report/Log.hpp"

#include <algorithm>
#include <iostream>

#include "common/Parallel.hpp"

namespace tooljoint::log {
namespace {

bool quiet_ = false;

std::vector<std::string>& collected() {
  static std::vector<std::string> lines;
  return lines;
}

}  // namespace

void setQuiet(bool quiet) { quiet_ = quiet; }
bool quiet() { return quiet_; }

void info(const std::string& line) {
  if (!quiet_ && parallel::rank() == 0) std::cout << line << std::endl;
}

void warn(const std::string& line) {
  auto& lines = collected();
  if (std::find(lines.begin(), lines.end(), line) != lines.end()) return;
  lines.push_back(line);
  if (parallel::rank() == 0) std::cerr << "warning: " << line << std::endl;
}

const std::vector<std::string>& warnings() { return collected(); }
void clearWarnings() { collected().clear(); }

}  // namespace tooljoint::log
