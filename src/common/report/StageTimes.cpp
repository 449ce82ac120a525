// SPDX-License-Identifier: BSD-3-Clause
#include "common/report/StageTimes.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <utility>
#include <vector>

#include "common/report/Log.hpp"

namespace tooljoint {

namespace {

std::map<std::string, double>& seconds() {
  static std::map<std::string, double> all;
  return all;
}

Stage*& innermost() {
  static Stage* stage = nullptr;
  return stage;
}

}  // namespace

Stage::Stage(std::string name)
    : name_(std::move(name)),
      outer_(std::exchange(innermost(), this)),
      start_(std::chrono::steady_clock::now()) {}

Stage::~Stage() {
  const double whole =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  seconds()[name_] += whole - inside_;
  if (outer_ != nullptr) outer_->inside_ += whole;
  innermost() = outer_;
}

std::string stageTimes(double least) {
  std::vector<std::pair<double, std::string>> all;
  for (const auto& [name, time] : seconds())
    if (time >= least) all.emplace_back(time, name);
  std::sort(all.rbegin(), all.rend());
  std::string text;
  for (const auto& [time, name] : all)
    text += fmt::format("{}{} {:.2f} s", text.empty() ? "" : ", ", name, time);
  return text;
}

void logStageTimes() {
  const auto times = stageTimes();
  if (!times.empty()) log::info("times       " + times);
}

}  // namespace tooljoint
