// SPDX-License-Identifier: BSD-3-Clause
#include "study/Expansion.hpp"

#include <cctype>

#include "common/Text.hpp"

namespace tooljoint::study {
namespace {

const char* const referenceSource = "Study/Reference/Set";

void takeOut(const ReductionLists& lists, PlannedRun& run) {
  for (const auto& list : lists) run.overrides.push_back({"!" + list, run.source});
}

/// "Step 0.001", "Least squares": a number needs the name of its parameter.
std::string describe(const std::string& parameter, const std::string& value) {
  const bool numeric = !value.empty() && (std::isdigit(static_cast<unsigned char>(value[0])) != 0 ||
                                          value[0] == '.' || value[0] == '-');
  return numeric ? split(parameter, '/').back() + " " + value : value;
}

}  // namespace

std::string kindName(RunKind kind) {
  switch (kind) {
    case RunKind::Reference:
      return "reference";
    case RunKind::Check:
      return "check";
    case RunKind::Sensitivity:
      return "sensitivity";
    case RunKind::Method:
      break;
  }
  return "method";
}

std::vector<PlannedRun> product(const std::vector<Dimension>& dimensions, const PlannedRun& base,
                                const std::string& place) {
  std::vector<PlannedRun> runs;
  std::size_t count = 1;
  for (const auto& dimension : dimensions) count *= dimension.values.size();
  for (std::size_t i = 0; i < count; ++i) {
    PlannedRun run = base;
    std::size_t rest = count, index = i;
    for (const auto& dimension : dimensions) {
      rest /= dimension.values.size();
      const auto& value = dimension.values[index / rest];
      index %= rest;
      run.sweep.emplace_back(dimension.parameter, value);
      run.overrides.push_back({dimension.parameter + "=" + value, place + "/" + dimension.name});
      run.label += (run.label.empty() ? "" : ", ") + describe(dimension.parameter, value);
      if (&dimension != &dimensions.back()) run.line = run.label;
    }
    runs.push_back(std::move(run));
  }
  return runs;
}

std::vector<PlannedRun> expand(const StudySettings& settings, const ReductionLists& reduction) {
  std::vector<PlannedRun> runs;
  for (const auto& method : settings.methods) {
    PlannedRun base;
    base.source = "Study/Methods/" + method.name;
    base.method = base.line = base.label = method.label;
    base.reduced = method.reduced;
    if (!method.reduced) takeOut(reduction, base);
    for (const auto& text : method.set) base.overrides.push_back({text, base.source + "/Set"});
    for (auto& run : product(method.sweep, base, base.source + "/Sweep"))
      runs.push_back(std::move(run));
  }
  return runs;
}

std::vector<PlannedRun> references(const StudySettings& settings, const ReductionLists& reduction) {
  PlannedRun reference;
  reference.kind = RunKind::Reference;
  reference.source = "Study/Reference";
  reference.method = reference.line = reference.label = "reference";
  takeOut(reduction, reference);
  for (const auto& text : settings.reference)
    reference.overrides.push_back({text, referenceSource});
  std::vector<PlannedRun> runs{reference};

  PlannedRun check = reference;
  check.kind = RunKind::Check;
  check.source = "Study/Check";
  check.method = check.line = check.label = "reference, check";
  for (const auto& text : settings.check) check.overrides.push_back({text, "Study/Check/Set"});
  runs.push_back(check);

  if (settings.perturbation > 0.0) {
    PlannedRun perturbed = reference;
    perturbed.kind = RunKind::Sensitivity;
    perturbed.method = perturbed.line = perturbed.label = "reference, perturbed";
    runs.push_back(perturbed);
  }
  return runs;
}

}  // namespace tooljoint::study
