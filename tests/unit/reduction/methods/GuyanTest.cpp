// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Static condensation and its automatic masters.
#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <gtest/gtest.h>

#include "coupling/assembly/Assembler.hpp"
#include "linalg/trilinos/EigenSolver.hpp"
#include "reduction/Reduce.hpp"
#include "reduction/part/MasterDofs.hpp"
#include "tests/support/BasisFamilies.hpp"

namespace GuyanTest {

using namespace tooljoint;
using namespace tooljoint::reduction;
using samples::modes;

std::unique_ptr<ReductionMethod> guyan(const std::string& masters = "Automatic") {
  Teuchos::ParameterList list;
  list.sublist("Guyan").set("Masters", masters);
  return makeBasis("Guyan", list);
}

Vector eigenvalues(const model::SecondOrderModel& m) {
  return linalg::symmetricModes(Matrix(symmetricPart(m.stiffnessAt(0))), Matrix(m.mass)).values;
}

TEST(Guyan, OfABarIsOneLongElement) {
  auto part = samples::bar("bar", 1, 8, 3.0, 2.0);
  samples::classify(part, {1, 9});
  for (const auto& masters : {"Automatic", "None"}) {
    const auto small = reduce(part, guyan(masters)->build(part, modes(0)), ReductionOptions(), 0);
    EXPECT_EQ(small.modes, 0);
    EXPECT_LT((Matrix(small.model.stiffness.front().matrix) -
               3.0 / 8 * (Matrix(2, 2) << 1, -1, -1, 1).finished())
                  .norm(),
              1e-14);
    EXPECT_LT(
        (Matrix(small.model.mass) - 16.0 / 6 * (Matrix(2, 2) << 2, 1, 1, 2).finished()).norm(),
        1e-13);
    EXPECT_LT(small.report.staticDefect, 1e-13);
    EXPECT_EQ(small.report.zeroEnergyReduced, 1);
  }
}

// A cantilever of eight elements: rotations have very little inertia, so the masters are
// displacements, spread over the length.
TEST(Guyan, MastersOfACantileverAreDisplacements) {
  samples::Frame frame;
  frame.corners = {{1, {0, 0}}, {9, {4, 0}}};
  frame.clamped = {1};
  frame.EA = 1e12;  // axial motion far above
  auto part = samples::framePart("cantilever", frame, {{1, 9, {2, 3, 4, 5, 6, 7, 8}}});
  const auto ranking = rankMasters(part);
  ASSERT_EQ(ranking.positions.size(), 24u);
  EXPECT_EQ(part.model.dofs[static_cast<std::size_t>(ranking.positions[0])],
            model::DofLabel::physical(9, 1))
      << "the tip";
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_EQ(part.model.dofs[static_cast<std::size_t>(ranking.positions[i])].component, 1);
  for (Eigen::Index i = 1; i < ranking.ratios.size(); ++i)
    EXPECT_LE(ranking.ratios[i - 1], ranking.ratios[i]);
  // Guyan: frequencies converge from above with every master. The first frequency of the continuum
  // is 3.516015 sqrt(EI / mu l^4).
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
  // One element's worth of static shape with the tip as master: 3 / (33/140) = 12.727, sqrt
  // = 3.5675, 1.47 % above 3.5160.
  const auto one = reduce(part, guyan()->build(part, modes(1)), ReductionOptions(), 0);
  EXPECT_NEAR(std::sqrt(eigenvalues(one.model)[0] * 20 * 256 / 3e5), std::sqrt(3.0 * 140 / 33),
              1e-4);
}

/// Springs between neighbours in a box, each node with one dof and its own mass.
model::Substructure box(int nx, int ny, int nz) {
  model::Substructure part;
  part.name = "box";
  const int n = nx * ny * nz;
  Triplets k, m;
  const auto number = [&](int i, int j, int l) { return i + nx * (j + ny * l); };
  const auto spring = [&](int a, int b, double stiffness) {
    k.emplace_back(a, a, stiffness);
    k.emplace_back(b, b, stiffness);
    k.emplace_back(a, b, -stiffness);
    k.emplace_back(b, a, -stiffness);
    m.emplace_back(a, b, 0.05);
    m.emplace_back(b, a, 0.05);
  };
  for (int l = 0; l < nz; ++l)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) {
        const int a = number(i, j, l);
        m.emplace_back(a, a, 1.0 + 0.3 * std::sin(1.7 * a));
        k.emplace_back(a, a, 1.0);
        if (i + 1 < nx) spring(a, number(i + 1, j, l), 100.0 + std::cos(2.9 * a));
        if (j + 1 < ny) spring(a, number(i, j + 1, l), 90.0 + std::cos(3.1 * a));
        if (l + 1 < nz) spring(a, number(i, j, l + 1), 80.0 + std::cos(1.3 * a));
        part.model.dofs.push_back(model::DofLabel::physical(a + 1, 0));
      }
  Sparse K(n, n), M(n, n);
  K.setFromTriplets(k.begin(), k.end());
  M.setFromTriplets(m.begin(), m.end());
  part.model.componentNames = std::vector<std::string>{"u"};
  part.model.mass = M;
  part.model.stiffness = {{"springs", K, 0}};
  part.model.initialDisplacement = part.model.initialVelocity = Vector::Zero(n);
  part.interface = {0, n - 1};
  return part;
}

// The ranking of Henshell and Ong, one dof after the other with dense matrices, as in their paper.
TEST(Guyan, MastersAreThoseOfTheEliminationOneByOne) {
  const auto part = box(7, 6, 5);
  const Partition p = partition(part);
  const auto ranking = rankMasters(part);
  Matrix K = constantStiffness(part.model), M = part.model.mass;
  std::vector<int> left = p.interior, order;
  while (!left.empty()) {
    const auto it = std::max_element(left.begin(), left.end(), [&](int a, int b) {
      return K(a, a) / M(a, a) < K(b, b) / M(b, b);
    });
    const int e = *it;
    left.erase(it);
    order.push_back(e);
    const Vector t = -K.col(e) / K(e, e), k = K.col(e), m = M.col(e);
    K += k * t.transpose();
    M += t * m.transpose() + m * t.transpose() + M(e, e) * t * t.transpose();
  }
  std::reverse(order.begin(), order.end());
  EXPECT_EQ(ranking.positions, order);
}

// Limit of the time: 3,700 dofs in space once took over a minute.
TEST(Guyan, MastersOfThousandsOfDofsTakeSeconds) {
  const auto part = box(16, 16, 15);
  const PartView view = part;
  const Partition p = view.partition();
  view.symmetricStiffness();
  const std::clock_t start = std::clock();
  const auto ranking = rankMasters(view);
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  std::printf("%zu dofs ranked in %.1f s of CPU time\n", ranking.positions.size(), seconds);
  EXPECT_EQ(ranking.positions.size(), p.interior.size());
  const char* factor = std::getenv("TOOLJOINT_TIME_FACTOR");  // programs with sanitizers
  EXPECT_LT(seconds, 20.0 * (factor != nullptr ? std::atof(factor) : 1.0));
}

TEST(Guyan, AllMastersAreTheFullModel) {
  const auto parts = samples::loopFrame(6, false, true);
  ReductionOptions options;
  options.basis = "Guyan";
  const Vector full = eigenvalues(coupling::couple(parts)),
               small = eigenvalues(coupling::couple(reduceAll(parts, *guyan(), options)));
  ASSERT_EQ(full.size(), small.size());
  for (Eigen::Index i = 0; i < full.size(); ++i)
    EXPECT_LE(std::abs(full[i] - small[i]), 1e-9 * full[i] + 1e-15 * full[full.size() - 1]);
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
  EXPECT_NE(basis.remarks[0].find("does not use the number of modes"), std::string::npos);
  EXPECT_EQ(basis.vectors.cols(), 3);
}

}  // namespace GuyanTest
