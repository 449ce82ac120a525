// SPDX-License-Identifier: BSD-3-Clause
#include "cases/ReducedCase.hpp"

#include <algorithm>
#include <limits>

#include "common/Constants.hpp"
#include "reduction/selection/ModeSelection.hpp"

namespace tooljoint::cases {

namespace {

/// A motion that is faster than its samples is looked at up to so many times as often; more often
/// than its steps it cannot be looked at.
constexpr double mostSamples = 1024;

estimate::MotionOptions motionOptions(const RestingCase& rest) {
  estimate::MotionOptions options;
  options.components = rest.measures().vibration();
  return options;
}

}  // namespace

std::vector<double> ReducedCase::cutOffs() const {
  std::vector<double> ends;
  for (const auto& part : parts()) {
    const auto& basis = part.report;
    const bool whole = basis.modes >= basis.interior;
    ends.push_back(whole ? std::numeric_limits<double>::infinity()
                         : constants::twoPi * basis.cutOffHz());
  }
  return ends;
}

double ReducedCase::watchInterval(const Case& one) const {
  return sampling > 0.0 ? sampling : one.transient().get<double>("Sampling Interval");
}

ReducedCase reduce(const Case& one, const RestingCase& rest, bool progress) {
  ReducedCase out{rest.parts(), {}};
  const auto& parts = out.unreduced.parts;
  double& sampling = out.sampling;
  const auto probe = [&](const coupling::Synthesis& synthesis, const estimate::MotionLimit& limit) {
    auto options = transient::readOptions(one.transient());
    options.progress = options.progress && progress;
    const double finest = std::max(options.step, options.sampling / mostSamples);
    if (sampling > 0) options.sampling = sampling;
    for (;; options.sampling *= 0.5) {
      sampling = options.sampling;
      estimate::MotionEstimator estimator(parts, synthesis, rest.rest(), motionOptions(rest));
      const auto found = estimate::watchMotion(estimator, synthesis.coupled.model, options, limit);
      if (found.reached < 1.0 || !found.isTooFast() || sampling <= finest) return found;
      if (found.roughness > estimate::MotionEstimate::roughest) options.sampling *= 0.5;
    }
  };
  out.outcome = estimate::synthesise(parts, one.reduction(), probe, out.unreduced.options);
  return out;
}

bool estimatesMotion(const Case& one) {
  return estimate::readEstimateOptions(one.reduction()).motion ||
         reduction::selectsModesBy(one.reduction(), "Motion Tolerance");
}

std::unique_ptr<estimate::MotionEstimator> motionEstimator(const RestingCase& rest,
                                                           const ReducedCase& reduced) {
  return std::make_unique<estimate::MotionEstimator>(
      reduced.unreduced.parts, reduced.outcome.synthesis, rest.rest(), motionOptions(rest));
}

}  // namespace tooljoint::cases
