// SPDX-License-Identifier: BSD-3-Clause
#include "study/StepLimit.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <set>

namespace tooljoint::study {
namespace {

/// A reduced run has the error of the full run if its error is at most this multiple of it.
constexpr double sameError = 1.25;
/// Errors are alike if the largest is at most this multiple of the smallest.
constexpr double alike = 1.1;
/// An error is meaningful only if it exceeds this multiple of that of the reference.
constexpr double aboveReference = 3.0;

/// Runs that differ only in their model.
struct Group {
  const StudyRow* full = nullptr;  ///< with the smallest error
  std::vector<const StudyRow*> reduced;
};

double error(const StudyRow* row) { return row->errors->vibration; }

std::string percent(double value) { return fmt::format("{:.3g} %", 100.0 * value); }

/// "a vibration error of 0.8 to 0.85 %"
std::string errorsOf(double least, double largest) {
  const auto low = fmt::format("{:.3g}", 100.0 * least), high = percent(largest);
  return "a vibration error of " + (low + " %" == high ? high : low + " to " + high);
}

/// The sentence for a group; "" if the basis limits the runs, or if the cause is unknown.
std::string limitOf(const Group& group, double reference) {
  const auto& reduced = group.reduced;
  if (reduced.size() < 2) return "";
  const auto [least, largest] = std::minmax_element(
      reduced.begin(), reduced.end(), [](auto* a, auto* b) { return error(a) < error(b); });
  if (error(*least) < aboveReference * reference) return "";
  const auto rows =
      fmt::format("all {} reduced runs with steps of {:.3g} ms have {}", reduced.size(),
                  1e3 * (*least)->counters.maxStep, errorsOf(error(*least), error(*largest)));
  if (group.full != nullptr)
    return error(*largest) > sameError * error(group.full)
               ? ""
               : rows + ", the full model with these steps " + percent(error(group.full)) +
                     ": the step limits them, not the basis. Reduce Transient/Step.";
  std::set<long> sizes;
  for (const auto* row : reduced) sizes.insert(row->dofs);
  if (sizes.size() < 3 || error(*largest) > alike * error(*least)) return "";
  return rows + fmt::format(
                    ", with {} as with {} dofs: not the basis limits them, but most likely the "
                    "step. Reduce Transient/Step, or add the full model with this step.",
                    *sizes.begin(), *sizes.rbegin());
}

}  // namespace

std::vector<std::string> stepLimits(const std::vector<StudyRow>& rows,
                                    const std::vector<std::string>& transient) {
  double reference = 0.0;
  std::map<std::string, Group> groups;
  std::vector<std::string> order;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto& row = rows[i];
    if (!row.done() || !row.errors) continue;
    if (row.plan.kind == RunKind::Check) reference = row.errors->vibration;
    if (row.plan.kind != RunKind::Method || transient[i].empty()) continue;
    if (groups.count(transient[i]) == 0) order.push_back(transient[i]);
    auto& group = groups[transient[i]];
    if (row.plan.reduced)
      group.reduced.push_back(&row);
    else if (group.full == nullptr || error(&row) < error(group.full))
      group.full = &row;
  }
  std::vector<std::string> sentences;
  for (const auto& key : order) {
    const auto sentence = limitOf(groups[key], reference);
    if (!sentence.empty()) sentences.push_back(sentence);
  }
  return sentences;
}

}  // namespace tooljoint::study
