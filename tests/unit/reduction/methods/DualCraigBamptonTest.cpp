// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The dual Craig-Bampton basis: matrices, static state in the forces, motion, refusals.
#include <Eigen/Dense>
#include <Teuchos_ParameterList.hpp>
#include <cmath>
#include <gtest/gtest.h>

#include "common/Error.hpp"
#include "linalg/trilinos/DirectSolver.hpp"
#include "tests/support/BasisFamilies.hpp"
#include "tests/support/SampleParts.hpp"
#include "transient/Transient.hpp"

namespace DualCraigBamptonTest {

using namespace tooljoint;
using namespace tooljoint::reduction;
using samples::modes;

const samples::Family dual{"Dual Craig-Bampton", "", ""};
const samples::Family dualWithMass{"Dual Craig-Bampton", "Residual Mass", "", true};

TEST(DualCraigBampton, MatricesOfAPartAreBlocks) {
  const auto part = samples::loopFrame(6, false)[2];  // floats on 2 x 3 interface dofs
  for (const auto& family : {dual, dualWithMass}) {
    const auto small = reduce(part, family.make()->build(part, modes(7)), ReductionOptions(), 0);
    EXPECT_EQ(small.interface, 0);
    ASSERT_TRUE(small.derivedInterface.has_value());
    EXPECT_EQ(small.derivedInterface->forces, 6);
    ASSERT_EQ(small.size(), 7 + 6);
    const Matrix k = small.model.stiffness.front().matrix, m = small.model.mass;
    const double size = k.bottomRightCorner(6, 6).cwiseAbs().maxCoeff();
    EXPECT_LT(k.topRightCorner(7, 6).cwiseAbs().maxCoeff(),
              1e-9 * std::sqrt(size * k.topLeftCorner(7, 7).cwiseAbs().maxCoeff()));
    EXPECT_LT((m.topLeftCorner(7, 7) - Matrix::Identity(7, 7)).norm(), 1e-10);
    EXPECT_LT((Matrix(small.derivedInterface->rows).rightCols(6) - k.bottomRightCorner(6, 6))
                  .cwiseAbs()
                  .maxCoeff(),
              1e-9 * size)
        << "Psi_b = Psi' K Psi";
    EXPECT_EQ(m.bottomRightCorner(6, 6).isZero(0.0), family.parameter.empty());
    EXPECT_LT(small.report.staticDefect, 1e-9);
    EXPECT_EQ(small.report.zeroEnergyReduced, 3);
  }
}

TEST(DualCraigBampton, BringsANegativeEigenvalueForEveryForceWithMass) {
  const auto parts = samples::loopFrame(6, false);
  const auto negative = [&](const samples::Family& family) {
    const Vector values =
        samples::eigenvalues(samples::synthesised(parts, family, 6).coupled.model);
    return static_cast<int>((values.array() < -1e-6 * values.cwiseAbs().maxCoeff()).count());
  };
  EXPECT_EQ(negative(dual), 0);
  EXPECT_EQ(negative(dualWithMass), 9) << "three parts meet in node 3, two in node 4";
}

/// The frame under weight, started in its static state, and a force applied suddenly.
std::vector<model::Substructure> loadedFrame(bool push) {
  auto parts = samples::loopFrame(6, true, true);
  for (auto& part : parts) {
    Vector gravity = Vector::Zero(part.model.size());
    for (int i = 0; i < part.model.size(); ++i)
      gravity[i] = part.model.dofs[static_cast<std::size_t>(i)].component == 1 ? -200.0 : 0.0;
    part.model.loads.push_back({"weight", part.model.mass * gravity, 0});
  }
  const auto full = coupling::coupleWithPositions(parts);
  const Vector rest =
      linalg::DirectSolver(full.model.stiffnessAt(0.0)).solve(full.model.loadAt(0.0));
  for (std::size_t p = 0; p < parts.size(); ++p)
    parts[p].reference = parts[p].model.initialDisplacement = full.maps[p] * rest;
  if (push) {
    Vector force = Vector::Zero(parts[2].model.size());
    force[samples::find(parts[2].model, model::DofLabel::physical(303, 1))] = 5e3;
    const int law = parts[2].model.lawIndex({"push", [](double t) { return std::sin(300 * t); }});
    parts[2].model.loads.push_back({"push", force, law});
  }
  return parts;
}

class Recorder : public transient::SampleSink {
 public:
  explicit Recorder(const model::SecondOrderModel& m) : model_(m) {}
  void sample(double, const Vector& q, const Vector&, const Vector&) override {
    states.push_back(model_.recoveryOffset + model_.recovery * q);
  }
  std::vector<Vector> states;

 private:
  const model::SecondOrderModel& model_;
};

std::vector<Vector> motion(const model::SecondOrderModel& m) {
  transient::TransientOptions options;
  options.integrator = "Generalized-alpha";
  options.end = 0.1;
  options.step = 2e-4;
  options.sampling = 2e-3;
  options.progress = false;
  Recorder recorder(m);
  transient::integrate(m, options, recorder);
  return recorder.states;
}

double largestDifference(const std::vector<Vector>& a, const std::vector<Vector>& b) {
  double error = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    error = std::max(error, (a[i] - b[i]).cwiseAbs().maxCoeff());
  return error;
}

TEST(DualCraigBampton, KeepsTheStaticState) {
  const auto parts = loadedFrame(false);
  double size = 0;
  for (const auto& part : parts) size = std::max(size, part.reference.cwiseAbs().maxCoeff());
  for (const int count : {3, 8}) {
    const auto coupled = samples::synthesised(parts, dual, count);
    for (std::size_t p = 0; p < parts.size(); ++p) {
      const auto& small = coupled.parts[p];
      const Vector q =
          coupled.coupled.local(static_cast<int>(p), coupled.coupled.model.initialDisplacement);
      EXPECT_LT(
          (small.offset + small.basis->vectors * q - parts[p].reference).cwiseAbs().maxCoeff(),
          1e-10 * size)
          << small.name;
    }
    const auto states = motion(coupled.coupled.model);
    EXPECT_LT(largestDifference(states, std::vector<Vector>(states.size(), states.front())),
              1e-7 * size)
        << "nothing moves";
  }
}

// Without residual mass the dual model is MacNeal's in other coordinates: the same motion, with
// gyroscopics, torque and damping.
TEST(DualCraigBampton, MovesAsMacNeal) {
  const auto parts = loadedFrame(true);
  const auto primal = samples::synthesised(parts, {"MacNeal", "", ""}, 8).coupled.model,
             forces = samples::synthesised(parts, dual, 8).coupled.model;
  const auto a = motion(primal), b = motion(forces);
  const double amplitude = largestDifference(a, std::vector<Vector>(a.size(), a.front()));
  EXPECT_GT(amplitude, 0.0);
  std::printf("dual against MacNeal: %.2e of the motion\n", largestDifference(a, b) / amplitude);
  EXPECT_LT(largestDifference(a, b), 0.02 * amplitude);
}

TEST(DualCraigBampton, MotionWithResidualMassIsRefused) {
  const auto coupled = samples::synthesised(loadedFrame(true), dualWithMass, 6).coupled.model;
  try {
    motion(coupled);
    FAIL();
  } catch (const ModelError& error) {
    EXPECT_NE(std::string(error.what()).find("Residual Mass"), std::string::npos) << error.what();
  }
}

}  // namespace DualCraigBamptonTest
