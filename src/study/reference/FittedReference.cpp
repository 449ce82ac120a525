// SPDX-License-Identifier: BSD-3-Clause
#include "study/reference/FittedReference.hpp"

#include <fmt/format.h>

#include "common/Text.hpp"

namespace tooljoint::study {
namespace {

/// Removes the tolerances of the deck, which do not apply to the reference. This override also
/// marks a fitted reference, since no deck uses it for that purpose.
constexpr const char* usualTolerances = "!Transient/Generalized-alpha";

}  // namespace

std::vector<std::string> explicitReference() {
  return {"!Transient/Step", "Transient/Integrator=RK4", "Transient/RK4/Safety=0.5"};
}

void fitReference(StudySettings& settings, double shortest) {
  if (!settings.reference.empty() || !settings.check.empty()) return;
  if (shortest <= 0.0) {
    settings.reference = explicitReference();
    settings.check = {"Transient/RK4/Safety=0.25"};
    return;
  }
  const double step = shortest / referenceRefinement;
  settings.reference = {usualTolerances, "Transient/Integrator=Generalized-alpha",
                        "Transient/Step=" + formatNumber(step)};
  settings.check = {"Transient/Step=" + formatNumber(step / 2.0)};
}

bool hasFittedSteps(const StudySettings& settings) {
  return !settings.reference.empty() && settings.reference.front() == usualTolerances;
}

std::string describeReference(const StudySettings& settings,
                              const Teuchos::ParameterList& transient) {
  const auto text = transient.get<std::string>("Integrator");
  if (!transient.isType<double>("Step")) return text;
  return text + fmt::format(", steps of {:.4g} ms", 1e3 * transient.get<double>("Step")) +
         (hasFittedSteps(settings) ? ", a quarter of the shortest" : "");
}

}  // namespace tooljoint::study
