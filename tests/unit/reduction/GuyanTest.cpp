// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Static condensation and its automatic masters.
#include <Teuchos_ParameterList.hpp>
#include <gtest/gtest.h>

#include "coupling/Assembler.hpp"
#include "linalg/EigenSolver.hpp"
#include "reduction/MasterDofs.hpp"
#include "reduction/Reduce.hpp"
#include "tests/support/SampleParts.hpp"

namespace {

using namespace tooljoint;
using namespace tooljoint::reduction;

std::unique_ptr<Basis> guyan(const std::string& masters = "Automatic") {
  Teuchos::ParameterList list;
  list.sublist("Guyan").set("Masters", masters);
  return makeBasis("Guyan", list);
}

ModeRequest modes(int count) {
  ModeRequest request;
  request.kind = ModeRequest::Kind::Count;
  request.count = count;
  return request;
}

Vector eigenvalues(const model::SecondOrderModel& m) { return linalg::symmetricModes(Matrix(symmetricPart(m.stiffnessAt(0))), Matrix(m.mass)).values; }

TEST(Guyan, OfABarIsOneLongElement) {
  auto part = samples::bar("bar", 1, 8, 3.0, 2.0);
  samples::classify(part, {1, 9});
  for (const auto& masters : {"Automatic", "None"}) {
    const auto small = reduce(part, guyan(masters)->build(part, modes(0)), ReductionOptions(), 0);
    EXPECT_EQ(small.modes, 0);
    EXPECT_LT((Matrix(small.model.stiffness.front().matrix) - 3.0 / 8 * (Matrix(2, 2) << 1, -1, -1, 1).finished()).norm(), 1e-14);
    EXPECT_LT((Matrix(small.model.mass) - 16.0 / 6 * (Matrix(2, 2) << 2, 1, 1, 2).finished()).norm(), 1e-13);
    EXPECT_LT(small.report.staticDefect, 1e-13);
    EXPECT_EQ(small.report.zeroEnergyReduced, 1);
  }
}

// A cantilever of eight elements: rotations carry next to no mass, so the masters are displacements, spread over the length.
TEST(Guyan, MastersOfACantileverAreDisplacements) {
  samples::Frame frame;
  frame.corners = {{1, {0, 0}}, {9, {4, 0}}};
  frame.clamped = {1};
  frame.EA = 1e12;  // axial motion far above
  auto part = samples::framePart("cantilever", frame, {{1, 9, {2, 3, 4, 5, 6, 7, 8}}});
  const Partition p = partition(part);
  const auto ranking = rankMasters(part, p, symmetricPart(constantStiffness(part.model)));
  ASSERT_EQ(ranking.positions.size(), 24u);
  EXPECT_EQ(part.model.dofs[static_cast<std::size_t>(ranking.positions[0])], model::DofLabel::physical(9, 1)) << "the tip";
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(part.model.dofs[static_cast<std::size_t>(ranking.positions[i])].component, 1);
  for (Eigen::Index i = 1; i < ranking.ratios.size(); ++i) EXPECT_LE(ranking.ratios[i - 1], ranking.ratios[i]);
  // Guyan: from above, and better with every master. The first frequency of the continuum is 3.516015 sqrt(EI / mu l^4).
  const double exact = eigenvalues(part.model)[0];
  double before = 1;
  for (int count : {1, 2, 4, 8}) {
    const auto small = reduce(part, guyan()->build(part, modes(count)), ReductionOptions(), 0);
    EXPECT_EQ(small.retained, count);
    const double error = std::sqrt(eigenvalues(small.model)[0] / exact) - 1;
    std::printf("%d masters: first frequency %.3e above\n", count, error);
    EXPECT_GT(error, -1e-12);
    EXPECT_LT(error, before);
    before = error;
  }
  // One element's worth of static shape with the tip as master: 3 / (33/140) = 12.727, sqrt = 3.5675, 1.47 % above 3.5160.
  const auto one = reduce(part, guyan()->build(part, modes(1)), ReductionOptions(), 0);
  EXPECT_NEAR(std::sqrt(eigenvalues(one.model)[0] * 20 * 256 / 3e5), std::sqrt(3.0 * 140 / 33), 1e-4);
}

TEST(Guyan, AllMastersAreTheFullModel) {
  const auto parts = samples::loopFrame(6, false, true);
  ReductionOptions options;
  options.basis = "Guyan";
  const Vector full = eigenvalues(coupling::couple(parts)), small = eigenvalues(coupling::couple(reduceAll(parts, *guyan(), options)));
  ASSERT_EQ(full.size(), small.size());
  for (Eigen::Index i = 0; i < full.size(); ++i) EXPECT_LE(std::abs(full[i] - small[i]), 1e-9 * full[i] + 1e-15 * full[full.size() - 1]);
}

TEST(Guyan, CutOffAndTotalChooseMasters) {
  const auto parts = samples::loopFrame(6, false);
  ReductionOptions options;
  options.basis = "Guyan";
  options.modes.kind = ModeRule::Kind::Total;
  options.modes.total = 12;
  int total = 0;
  for (const auto& part : reduceAll(parts, *guyan(), options)) total += part.retained;
  EXPECT_GE(total, 12);
  EXPECT_LE(total, 20);
  options.modes.kind = ModeRule::Kind::CutOff;
  options.modes.cutOffHz = 0;
  for (const auto& part : reduceAll(parts, *guyan(), options)) EXPECT_EQ(part.retained, 0);
}

TEST(Guyan, SaysThatItHasNoModes) {
  const auto parts = samples::loopFrame(4, false);
  const auto basis = guyan("None")->build(parts[0], modes(5));
  ASSERT_EQ(basis.remarks.size(), 1u);
  EXPECT_NE(basis.remarks[0].find("is not used"), std::string::npos);
  EXPECT_EQ(basis.vectors.cols(), 3);
}

}  // namespace
