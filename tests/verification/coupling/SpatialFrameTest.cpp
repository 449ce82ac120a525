// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A frame of five members in space with a loop, coupled in several ways, against the same frame as
/// one piece.
#include <Teuchos_ParameterList.hpp>
#include <gtest/gtest.h>

#include "coupling/CoupledModes.hpp"
#include "reduction/Reduce.hpp"
#include "tests/support/SpaceFrame.hpp"

namespace SpatialFrameTest {

using namespace tooljoint;
using namespace tooljoint::coupling;

std::vector<reduction::ReducedSubstructure> reduced(const std::vector<model::Substructure>& parts,
                                                    int modes) {
  reduction::ReductionOptions options;
  options.modes.kind =
      modes < 0 ? reduction::ModeRule::Kind::All : reduction::ModeRule::Kind::PerPart;
  options.modes.counts = {modes};
  return reduction::reduceAll(
      parts, *reduction::makeBasis("Craig-Bampton", Teuchos::ParameterList()), options);
}

Vector eigenvalues(const model::SecondOrderModel& m, int count) {
  return coupling::lowestModes(m, count).values;
}

/// |lambda - exact| <= 1e-9 lambda + 1e-15 lambda_max
void expectEqual(const Vector& found, const Vector& exact, double largest) {
  ASSERT_EQ(found.size(), exact.size());
  for (Eigen::Index i = 0; i < found.size(); ++i)
    EXPECT_LE(std::abs(found[i] - exact[i]), 1e-9 * std::abs(exact[i]) + 1e-15 * largest)
        << "mode " << i + 1;
}

class SpatialFrame : public testing::Test {
 protected:
  samples::FiveMembers frame{6};
  model::Substructure whole = frame.whole();
  Vector exact = eigenvalues(whole.model, whole.model.size());
  double largest = exact[exact.size() - 1];

  CouplingOptions options(Assembly assembly, const std::vector<int>& own = {}) const {
    CouplingOptions chosen;
    chosen.assembly = assembly;
    chosen.connections.frames = frame.frames(own);
    return chosen;
  }
};

TEST_F(SpatialFrame, AllModesGiveTheWholeSpectrumPrimal) {
  const auto coupled = couple(reduced(frame.parts(), -1));
  expectEqual(eigenvalues(coupled, coupled.size()), exact, largest);
}

TEST_F(SpatialFrame, PartsInTheirOwnAxes) {
  const std::vector<int> own{0, 1, 2, 3, 4};
  const auto parts = frame.parts(own);
  const auto coupled = couple(reduced(parts, -1), options(Assembly::Primal, own));
  expectEqual(eigenvalues(coupled, coupled.size()), exact, largest);
  const auto unreduced = couple(parts, options(Assembly::Primal, own));
  expectEqual(eigenvalues(unreduced, unreduced.size()), exact, largest);
}

TEST_F(SpatialFrame, DualIsPrimal) {
  const std::vector<int> own{1, 3};
  const auto parts = reduced(frame.parts(own), 8);
  const auto primal = coupleWithPositions(parts, options(Assembly::Primal, own));
  const auto dual = coupleWithPositions(parts, options(Assembly::Dual, own));
  EXPECT_EQ(dual.multipliers.size(), 30u) << "nodes 3 and 4 join three parts, node 5 two";
  EXPECT_EQ(dual.model.size(), primal.model.size() + 90);
  const int count = 30;
  const Vector a = eigenvalues(primal.model, count), b = eigenvalues(dual.model, count);
  for (int i = 0; i < count; ++i) EXPECT_NEAR(b[i] / a[i], 1.0, 1e-10) << "mode " << i + 1;
}

TEST_F(SpatialFrame, DualHasTheWholeSpectrum) {
  const auto dual = couple(reduced(frame.parts(), -1), options(Assembly::Dual));
  expectEqual(eigenvalues(dual, 60), exact.head(60), largest);
}

}  // namespace SpatialFrameTest
