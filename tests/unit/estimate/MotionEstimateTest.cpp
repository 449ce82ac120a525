// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The estimated error of a motion against the true one, where what the basis leaves out follows
/// statically.
#include "estimate/MotionEstimate.hpp"

#include <Teuchos_ParameterList.hpp>
#include <cmath>
#include <gtest/gtest.h>

#include "coupling/assembly/Assembler.hpp"
#include "tests/support/SampleParts.hpp"

namespace {

using namespace tooljoint;

/// Recovered displacements at the samples, handed on to an estimator where there is one.
class Motion : public transient::SampleSink {
 public:
  explicit Motion(const model::SecondOrderModel& m, estimate::MotionEstimator* estimator = nullptr)
      : model_(m), estimator_(estimator) {}
  void sample(double t, const Vector& q, const Vector& v, const Vector& a) override {
    displacement.push_back(model_.recoveryOffset + model_.recovery * q);
    if (estimator_ != nullptr) estimator_->sample(t, q, v, a);
  }
  std::vector<Vector> displacement;

 private:
  const model::SecondOrderModel& model_;
  estimate::MotionEstimator* estimator_;
};

transient::TransientOptions steps() {
  transient::TransientOptions options;
  options.integrator = "Generalized-alpha";
  options.end = 4.0;
  options.step = 2e-3;
  options.sampling = 4e-3;
  options.progress = false;
  return options;
}

/// Two clamped bars with light damping, shaken inside the left one far below the modes that a basis
/// with one mode of each leaves out.
std::vector<model::Substructure> shakenBars() {
  std::vector<model::Substructure> parts{samples::bar("left", 1, 6, 600.0, 0.05, {1}),
                                         samples::bar("right", 7, 6, 900.0, 0.05, {13})};
  for (auto& part : parts) {
    samples::classify(part, {7});
    part.model.damping.push_back(
        {"damping", Sparse(2e-3 * part.model.stiffness.front().matrix), 0});
  }
  auto& left = parts[0].model;
  Vector push = Vector::Zero(left.size());
  push[samples::find(left, model::DofLabel::physical(4, 0))] = 1.0;
  left.loads.push_back(
      {"push", push, left.lawIndex({"shake", [](double t) { return std::sin(8.0 * t); }})});
  return parts;
}

struct Errors {
  double estimated, truth;
};

Errors errors(const std::vector<model::Substructure>& parts, int modes) {
  reduction::ReductionOptions options;
  options.modes.kind = reduction::ModeRule::Kind::PerPart;
  options.modes.counts = {modes};
  const auto synthesis = coupling::synthesise(
      parts, *reduction::makeBasis("Craig-Bampton", Teuchos::ParameterList()), options);
  const auto& coupled = synthesis.coupled.model;
  estimate::MotionEstimator estimator(parts, synthesis, Vector::Zero(coupled.recoveryOffset.size()),
                                      {{0}, 0.5});
  Motion reduced(coupled, &estimator);
  transient::integrate(coupled, steps(), reduced);
  const auto full = coupling::couple(parts);
  Motion reference(full);
  transient::integrate(full, steps(), reference);
  double error = 0, size = 0;
  for (std::size_t i = 0; i < reference.displacement.size(); ++i) {
    error += (reduced.displacement[i] - reference.displacement[i]).squaredNorm();
    size += reference.displacement[i].squaredNorm();
  }
  return {estimator.result().error, std::sqrt(error / size)};
}

TEST(MotionEstimate, IsTheTrueErrorOfASlowMotion) {
  for (const int modes : {1, 2, 3}) {
    const Errors e = errors(shakenBars(), modes);
    std::printf("%d modes: estimated %.3e, true %.3e\n", modes, e.estimated, e.truth);
    EXPECT_GT(e.truth, 1e-3);
    EXPECT_NEAR(e.estimated, e.truth, 0.02 * e.truth) << modes;
  }
}

/// The bars at rest but for one node.
std::vector<model::Substructure> struckBars(int node) {
  std::vector<model::Substructure> parts{samples::bar("left", 1, 12, 600.0, 0.05, {1}),
                                         samples::bar("right", 13, 12, 900.0, 0.05)};
  for (auto& part : parts) {
    samples::classify(part, {13});
    for (int i = 0; i < part.model.size(); ++i)
      if (part.model.dofs[static_cast<std::size_t>(i)].entity == node)
        part.model.initialVelocity[i] = 1.0;
  }
  return parts;
}

/// A motion that starts outside the basis: what is missing at the start vibrates on its own, and
/// the estimate knows it. It takes no note of how the error of the coupled coordinates drives the
/// interiors, so that it is too large where the vibration is fast beside them: by 3.5 here.
TEST(MotionEstimate, CountsAStartOutsideTheBasis) {
  for (const int node : {13, 25, 20})
    for (const int modes : {1, 3}) {
      const Errors e = errors(struckBars(node), modes);
      std::printf("node %d, %d modes: estimated %.3f, true %.3f\n", node, modes, e.estimated,
                  e.truth);
      EXPECT_GT(e.truth, 0.1);
      EXPECT_GT(e.estimated, 0.7 * e.truth);
      EXPECT_LT(e.estimated, 4.0 * e.truth);
    }
}

}  // namespace
