// SPDX-License-Identifier: BSD-3-Clause
#include "common/report/EvaluationCounters.hpp"

namespace tooljoint {
namespace {

std::map<std::string, long>& counters() {
  static std::map<std::string, long> values;
  return values;
}

}  // namespace

void count(const std::string& what, long n) { counter(what) += n; }

long& counter(const std::string& what) { return counters()[what]; }

long counted(const std::string& what) {
  const auto it = counters().find(what);
  return it == counters().end() ? 0 : it->second;
}

std::map<std::string, long> evaluationCounters() {
  std::map<std::string, long> result;
  for (const auto& [name, value] : counters()) {
    if (value != 0) result.emplace(name, value);
  }
  return result;
}

void resetEvaluationCounters() {
  for (auto& [name, value] : counters()) value = 0;
}

}  // namespace tooljoint
