// SPDX-License-Identifier: BSD-3-Clause
#include "cases/ReducedCase.hpp"

#include "reduction/selection/ModeSelection.hpp"

namespace tooljoint::cases {

namespace {

estimate::MotionOptions motionOptions(const RestingCase& rest) {
  estimate::MotionOptions options;
  options.components = rest.measures().vibration();
  return options;
}

}  // namespace

ReducedCase reduce(const Case& one, const RestingCase& rest, bool progress) {
  ReducedCase out{rest.parts(), {}};
  const auto& parts = out.unreduced.parts;
  const auto probe = [&](const coupling::Synthesis& synthesis, const estimate::MotionLimit& limit) {
    estimate::MotionEstimator estimator(parts, synthesis, rest.rest(), motionOptions(rest));
    auto options = transient::readOptions(one.transient());
    options.progress = options.progress && progress;
    return estimate::watchMotion(estimator, synthesis.coupled.model, options, limit);
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
