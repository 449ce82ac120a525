// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Full and coupled modes matched by shape; errors of damped modes estimated and true.
#include "estimate/ModeComparison.hpp"

#include <Teuchos_ParameterList.hpp>
#include <gtest/gtest.h>

#include "Reduced.hpp"
#include "common/Error.hpp"
#include "model/laws/Connectors.hpp"
#include "model/laws/PointLawRegistry.hpp"
#include "tests/support/SampleParts.hpp"

namespace ModeComparisonTest {

using namespace tooljoint;

using estimate::reduced;

TEST(ModeComparison, WithAllModesShapesAreTheSame) {
  for (bool spinning : {false, true}) {
    const auto parts = samples::loopFrame(8, spinning);
    const auto synthesis = reduced(parts, 1000);
    const auto full = coupling::couple(parts);
    for (const auto& mode : estimate::compareModes(full, parts, synthesis, 6)) {
      EXPECT_NEAR(mode.mac, 1.0, 1e-8);
      EXPECT_LT(std::abs(mode.error), 1e-8);
    }
    for (const auto& mode : estimate::compareDampedModes(full, parts, synthesis, 6, 0.5)) {
      EXPECT_NEAR(mode.mac, 1.0, 1e-6);
      EXPECT_LT(mode.error,
                1e-6);  // QR of the linearised problem: rounding of (omega_max / omega)^2
      EXPECT_LT(mode.estimate, 1e-6);
    }
  }
}

/// The request is the number of all values, more than are finite, because the forces between the
/// parts have infinite values. Infinite values, finite by rounding, are no modes, and must not
/// cause a refusal of the others.
TEST(ModeComparison, ForcesBetweenPartsAddNoDampedModes) {
  coupling::CouplingOptions dual;
  dual.assembly = coupling::Assembly::Dual;
  for (const bool spinning : {false, true}) {
    const auto parts = samples::loopFrame(3, spinning);
    const auto full = coupling::couple(parts);
    for (const char* basis : {"Craig-Bampton", "Rubin", "Dual Craig-Bampton"}) {
      const auto synthesis = reduced(parts, 1000, basis, dual);
      const auto modes = estimate::compareDampedModes(full, parts, synthesis, 2 * full.size(), 0.5);
      EXPECT_EQ(modes.size(), full.size());
      for (const auto& mode : modes) EXPECT_LT(mode.error, 1e-6) << basis << ", s " << mode.full;
    }
  }
}

/// A mass on a spring and a dashpot in series: x = F / (k i omega T/(1 + i omega T) - omega^2 m).
TEST(Linearise, FollowsTheStatesOfPointLawsInHarmonicMotions) {
  const double m = 2, k = 300, c = 20;
  model::SecondOrderModel mass;
  mass.componentNames = {"u"};
  mass.dofs = {model::DofLabel::physical(1, 0)};
  mass.mass = Sparse((m * Matrix::Identity(1, 1)).sparseView());
  mass.stiffness.push_back({"none", Sparse(1, 1), 0});
  mass.initialDisplacement = mass.initialVelocity = Vector::Zero(1);
  Teuchos::ParameterList own("Maxwell");
  own.set("Stiffness", k).set("Damping", c);
  const Sparse row = Sparse(Matrix::Identity(1, 1).sparseView());
  mass.points.push_back({"link",
                         model::PointLawRegistry::instance().make("Maxwell", own, {1, 1}),
                         {1},
                         row,
                         Vector::Zero(1)});
  const auto held = estimate::linearise(mass, 0.0);
  EXPECT_NEAR(held.stiffness.coeff(0, 0), k, 1e-12 * k);
  for (const double omega : {0.5, 12.0, 400.0}) {
    const auto moved = estimate::linearise(mass, 0.0, omega);
    const Complex lag(0, omega * c / k), i(0, 1);
    const Complex found = moved.stiffness.coeff(0, 0) + i * omega * moved.damping.coeff(0, 0);
    EXPECT_LT(std::abs(found - k * lag / (1.0 + lag)), 1e-12 * k) << omega;
  }
}

TEST(ModeComparison, EstimatesOfDampedModesAreWithinAFactorOfThree) {
  int counted = 0;
  for (int modes : {2, 4, 6}) {
    const auto parts = samples::loopFrame(10, true, modes == 4);
    const auto compared =
        estimate::compareDampedModes(coupling::couple(parts), parts, reduced(parts, modes), 6, 0.5);
    std::printf("%d modes of each part\n%s", modes,
                estimate::comparisonTable(compared, true).c_str());
    for (const auto& mode : compared) {
      if (mode.error < 1e-9 || mode.mac < 0.9) continue;
      EXPECT_GT(mode.estimate, mode.error / 3.0);
      EXPECT_LT(mode.estimate, mode.error * 3.0);
      ++counted;
    }
  }
  EXPECT_GT(counted, 12);
}

TEST(ModeComparison, ModalAssuranceIsOneForTheSameShapeAndZeroForOthers) {
  const Matrix shapes = (Matrix(3, 2) << 1, 0, 0, 2, 0, 0).finished();
  Sparse M(3, 3);
  M.setIdentity();
  const Eigen::MatrixXcd a = shapes.cast<std::complex<double>>();
  const Matrix mac = estimate::modalAssurance(M, a, std::complex<double>(0, 3) * a);
  EXPECT_NEAR((mac - Matrix::Identity(2, 2)).norm(), 0.0, 1e-14);
}

/// MAC = |a' M b|^2 / (a' M a b' M b): orthogonal shapes may have a large MAC, and similar ones a
/// small one, depending on the mass.
TEST(ModeComparison, ModalAssuranceWeighsWithTheMass) {
  Sparse M(2, 2);
  M.insert(0, 0) = 1.0;
  M.insert(1, 1) = 4.0;
  const Eigen::MatrixXcd a = (Matrix(2, 1) << 1.0, 1.0).finished().cast<std::complex<double>>();
  const Eigen::MatrixXcd b =
      (Matrix(2, 2) << 1.0, 4.0, -1.0, -1.0).finished().cast<std::complex<double>>();
  const Matrix mac = estimate::modalAssurance(M, a, b);
  EXPECT_NEAR(mac(0, 0), 9.0 / 25.0, 1e-15);  // (1 - 4)^2 / (5 * 5)
  EXPECT_NEAR(mac(0, 1), 0.0, 1e-15);         // 4 - 4
}

/// Lightly damped bars of one interior dof without modes, a heavy mass where they meet: the
/// truncated work is exact, so that the estimate lacks only terms of second order in the error.
TEST(ModeComparison, EstimateOfADampedModeIsTheErrorToFirstOrder) {
  std::vector<model::Substructure> parts{samples::bar("left", 1, 2, 100.0, 0.2, {1}),
                                         samples::bar("right", 3, 2, 140.0, 0.1, {5})};
  for (auto& part : parts) {
    samples::classify(part, {3});
    part.model.damping.push_back(
        {"damping", Sparse(1e-3 * part.model.stiffness.front().matrix), 0});
    const int joint = part.interface.front();
    part.model.mass.coeffRef(joint, joint) += 0.5;
  }
  const auto modes =
      estimate::compareDampedModes(coupling::couple(parts), parts, reduced(parts, 0), 1, 0.0);
  ASSERT_EQ(modes.size(), 1u);
  EXPECT_GT(modes[0].error, 1e-3);
  EXPECT_LT(modes[0].error, 0.03);
  EXPECT_NEAR(modes[0].estimate, modes[0].error, 10.0 * modes[0].error * modes[0].error);
}

/// K + k and C + c at the point, with the laws at the given time: a bar with a spring and dashpot
/// under its end.
TEST(ModeComparison, LinearisesPointLawsWithTheirDamping) {
  auto part = samples::bar("bar", 1, 1, 100.0, 0.6, {1});
  auto& m = part.model;
  m.damping.push_back({"growing", Sparse(m.stiffness.front().matrix),
                       m.lawIndex({"t", [](double t) { return t; }})});
  model::SpringParameters spring;
  spring.stiffness = 30.0;
  spring.damping = 4.0;
  model::PointSet set;
  set.name = "spring";
  set.law = model::springs({spring});
  set.entities = {2};
  set.rows = Matrix(Matrix::Ones(1, 1)).sparseView();
  set.offset = Vector::Zero(1);
  m.points.push_back(set);
  const auto linear = estimate::linearise(m, 0.5);
  EXPECT_NEAR(linear.mass.coeff(0, 0), 0.2, 1e-15);
  EXPECT_NEAR(linear.stiffness.coeff(0, 0), 130.0, 1e-12);
  EXPECT_NEAR(linear.damping.coeff(0, 0), 0.5 * 100.0 + 4.0, 1e-12);
}

TEST(ModeComparison, NamesADofThatIsInNoPart) {
  const auto parts = samples::loopFrame(6, false);
  auto full = coupling::couple(parts);
  full.dofs[0] = model::DofLabel::physical(9999, 1);
  try {
    estimate::compareModes(full, parts, reduced(parts, 2), 2);
    FAIL() << "no error";
  } catch (const ModelError& error) {
    EXPECT_NE(std::string(error.what()).find("v of node 9999"), std::string::npos) << error.what();
  }
}

}  // namespace ModeComparisonTest
