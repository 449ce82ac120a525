// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The estimated error of a motion against the true one, for a static response of the modes outside
/// the basis.
#include "estimate/MotionEstimate.hpp"

#include <Teuchos_ParameterList.hpp>
#include <cmath>
#include <gtest/gtest.h>

#include "common/Constants.hpp"
#include "common/Index.hpp"
#include "coupling/assembly/Assembler.hpp"
#include "model/laws/DelayLine.hpp"
#include "model/laws/FormulaLaw.hpp"
#include "model/laws/PointLawRegistry.hpp"
#include "tests/support/SampleParts.hpp"

namespace MotionEstimateTest {

using namespace tooljoint;

/// Recovered displacements at the samples, passed on to an estimator if there is one.
class Motion : public transient::SampleSink {
 public:
  explicit Motion(const model::SecondOrderModel& m, estimate::MotionEstimator* estimator = nullptr)
      : model_(m), estimator_(estimator) {}
  void sample(double t, const Vector& q, const Vector& v, const Vector& a) override {
    displacement.push_back(model_.recoveryOffset + model_.recovery * q);
    if (estimator_ != nullptr) estimator_->sample(t, q, v, a);
  }
  void states(const Vector& x) override {
    if (estimator_ != nullptr) estimator_->states(x);
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

/// Two clamped bars with light damping, excited inside the left one far below the truncated modes
/// of a basis with one mode per bar.
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

/// A law of one coordinate on the displacement of a node.
void addLaw(model::Substructure& part, int node, std::shared_ptr<const model::PointLaw> law) {
  model::PointSet set;
  set.name = "law";
  set.law = std::move(law);
  set.rows.resize(1, part.model.size());
  set.rows.insert(0, samples::find(part.model, model::DofLabel::physical(node, 0))) = 1.0;
  set.offset = Vector::Zero(1);
  set.entities = {node};
  part.model.points.push_back(set);
}

/// A force on the displacement some time ago.
struct Echo : model::Formula<1> {
  double b = 60.0, tau = 0.15;
  model::DelayLine past{1, tau, 64};
  int held() const { return past.states(); }
  void initial(double t, const double* d, const double*, double* x) const { past.start(t, d, x); }
  void accept(double t, const double* d, const double* v, double* x) const {
    past.append(t, d, v, x);
  }
  template <class T>
  void operator()(const model::PointAt<T>& at, T* f, T*) const {
    double then = 0;
    past.at(at.t - tau, at.held, &then);
    f[0] = T(-b * then);
  }
  Power power(const model::PointAt<double>& at, const double*) const {
    double f = 0;
    (*this)(at, &f, static_cast<double*>(nullptr));
    Power p;
    p.drive = f * at.v[0];
    return p;
  }
};

std::shared_ptr<const model::PointLaw> registered(const std::string& name,
                                                  const Teuchos::ParameterList& own) {
  return model::PointLawRegistry::instance().make(name, own, {1, 1});
}

/// Errors of rated states (an overdamped link), of held states with a delay and of plastic slip act
/// on the error as the states act on the motion, in the middle of a part and at joints.
TEST(MotionEstimate, CarriesTheStatesOfPointLaws) {
  Teuchos::ParameterList maxwell, plastic;
  maxwell.set("Stiffness", 300.0).set("Damping", 30.0);
  plastic.set("Stiffness", 200.0).set("Yield Force", 0.05);
  const std::pair<const char*, std::shared_ptr<const model::PointLaw>> laws[] = {
      {"Maxwell", registered("Maxwell", maxwell)},
      {"Elastic-Plastic", registered("Elastic-Plastic", plastic)},
      {"delay", std::make_shared<model::FormulaLaw<Echo>>(Echo(), 1)}};
  for (const auto& [name, law] : laws)
    for (const int node : {3, 7})
      for (const int modes : {1, 3}) {
        auto parts = shakenBars();
        addLaw(parts[0], node, law);
        const Errors e = errors(parts, modes);
        std::printf("%s at node %d, %d modes: estimated %.3e, true %.3e\n", name, node, modes,
                    e.estimated, e.truth);
        EXPECT_GT(e.truth, 1e-3) << name;
        EXPECT_NEAR(e.estimated, e.truth, 0.1 * e.truth) << name << " at node " << node;
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

/// A motion that starts outside the basis: the missing part of the start vibrates separately, and
/// the estimate includes it. The estimate ignores the excitation of the interiors by the error of
/// the coupled coordinates, so it is too large if the vibration is fast compared with them: by 3.5
/// here.
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

/// The sixth mode of a bar between its ends, beside the first, with a basis of three. An estimate
/// from the residual alone contains 0.63 of the error.
TEST(MotionEstimate, CountsAModeOutsideTheBasisFromItsStart) {
  auto parts = struckBars(-1);
  auto& left = parts[0].model;
  for (int i = 0; i < left.size(); ++i) {
    const double x = constants::pi * (left.dofs[at(i)].entity - 1) / 12;
    left.initialVelocity[i] = std::sin(x) + 6.0 * std::sin(6 * x);
  }
  const Errors e = errors(parts, 3);
  EXPECT_GT(e.truth, 0.1);
  EXPECT_NEAR(e.estimated, e.truth, 0.2 * e.truth);
}

}  // namespace MotionEstimateTest
