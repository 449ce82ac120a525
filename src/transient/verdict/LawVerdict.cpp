// SPDX-License-Identifier: BSD-3-Clause
#include "transient/verdict/LawVerdict.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "common/Error.hpp"
#include "common/Text.hpp"
#include "common/report/Log.hpp"
#include "linalg/SparseProducts.hpp"
#include "transient/accuracy/LawResolution.hpp"

namespace tooljoint::transient {
namespace {

/// Part of the integral of a law of time that fixed steps may miss without a warning.
constexpr double unresolved = 0.01;
/// And without a refusal: as much as an error of the motion that none passes.
constexpr double lostLaw = 0.5;

}  // namespace

void judgeLaws(const model::SecondOrderModel& model, const Integrator& run,
               const JudgedSpan& span) {
  const Counters& c = run.counters();
  const double equal = run.equalStep(), h = equal > 0 ? equal : c.maxStep;
  if (!(equal > 0) && c.minStep < 0.5 * c.maxStep) return;  // steps that follow their error
  for (std::size_t i = 0; i < model.laws.size(); ++i) {
    const auto& law = model.laws[i];
    const auto follows = [i](const auto& term) {
      return term.law == static_cast<int>(i) && !linalg::isZero(term.matrix);
    };
    const bool ofMatrix = std::any_of(model.damping.begin(), model.damping.end(), follows) ||
                          std::any_of(model.stiffness.begin(), model.stiffness.end(), follows);
    const double missed =
        missedPart(law, span.start, span.end, h, run.followsCorners() && !ofMatrix);
    if (missed <= unresolved) continue;
    const std::string text =
        "The time step (" + formatNumber(h) + " s) is too large for the law \"" + law.name +
        "\". The steps do not resolve " + formatNumber(std::round(1e3 * missed) / 10.0) +
        " % of its integral over time. " + run.advice() + ".";
    if (missed > lostLaw && span.stepErrorLimit < 1) throw ConvergenceError(text);
    log::warn(text);
  }
}

}  // namespace tooljoint::transient
