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

/// Part of the integral of a law of time that steps may miss without a warning.
constexpr double unresolved = 0.01;
/// Part above which the run is refused: the error of a motion that is always refused.
constexpr double lostLaw = 0.5;
/// Intervals of a step in which LawWatch evaluates laws.
constexpr int pieces = 16;

void say(const model::ScalarLaw& law, double missed, const std::string& steps,
         const Integrator& run, double stepErrorLimit) {
  if (missed <= unresolved) return;
  const std::string text = steps + " too large for the law \"" + law.name +
                           "\". The steps do not resolve " +
                           formatNumber(std::round(1e3 * missed) / 10.0) +
                           " % of its integral over time. " + run.advice() + ".";
  if (missed > lostLaw && stepErrorLimit < 1) throw ConvergenceError(text);
  log::warn(text);
}

/// Simpson's rule over the intervals.
double integralOf(const model::ScalarLaw& law, double begin, double end) {
  const double h = (end - begin) / pieces;
  double sum = law.value(begin) + law.value(end);
  for (int k = 1; k < pieces; ++k) sum += (k % 2 == 1 ? 4 : 2) * law.value(begin + k * h);
  return sum * h / 3;
}

}  // namespace

LawWatch::LawWatch(const model::SecondOrderModel& model) {
  for (std::size_t i = 1; i < model.laws.size(); ++i) laws_.push_back({&model.laws[i]});
}

void LawWatch::look(double begin, double end) {
  for (auto& one : laws_) {
    if (hasCorner(*one.law, begin, end)) {  // steps end there
      one.sum += std::abs(momentsOf(*one.law, begin, end).mean) * (end - begin);
      continue;
    }
    const double seen = momentsOf(*one.law, begin, end).mean * (end - begin),
                 ends = 0.5 * (one.law->value(begin) + one.law->value(end)) * (end - begin),
                 fine = integralOf(*one.law, begin, end);
    one.missed += std::abs(fine - seen);
    one.lost += std::abs(fine - ends);
    one.sum += std::abs(fine);
  }
}

void LawWatch::judge(const Integrator& run, double stepErrorLimit) const {
  for (const auto& one : laws_)
    if (one.sum > 0)
      say(*one.law, (one.lost > lostLaw * one.sum ? one.lost : one.missed) / one.sum,
          "The steps of " + formatNumber(run.counters().maxStep) + " s at most are", run,
          stepErrorLimit);
}

void judgeLaws(const model::SecondOrderModel& model, const Integrator& run,
               const JudgedSpan& span) {
  const Counters& c = run.counters();
  const double equal = run.equalStep(), h = equal > 0 ? equal : c.maxStep;
  if (!(equal > 0) && c.minStep < 0.5 * c.maxStep) return;  // steps with error control
  for (std::size_t i = 0; i < model.laws.size(); ++i) {
    const auto& law = model.laws[i];
    const auto follows = [i](const auto& term) {
      return term.law == static_cast<int>(i) && !linalg::isZero(term.matrix);
    };
    const bool ofMatrix = std::any_of(model.damping.begin(), model.damping.end(), follows) ||
                          std::any_of(model.stiffness.begin(), model.stiffness.end(), follows);
    const double missed =
        missedPart(law, span.start, span.end, h,
                   ofMatrix ? run.followsCornersOfMatrices() : run.followsCorners());
    say(law, missed, "The time step (" + formatNumber(h) + " s) is", run, span.stepErrorLimit);
  }
}

}  // namespace tooljoint::transient
