// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Modes chosen by their effect on the neighbours of a part: closed forms of a bar, choice by
/// share, and refused choices.
#include "reduction/selection/InterfaceCriteria.hpp"

#include <Teuchos_ParameterList.hpp>
#include <cmath>
#include <gtest/gtest.h>

#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "reduction/Reduce.hpp"
#include "tests/support/SampleParts.hpp"

namespace InterfaceCriteriaTest {

using namespace tooljoint;
using namespace tooljoint::reduction;

Basis craigBampton(const model::Substructure& part, int modes) {
  ModeRequest request;
  request.kind = ModeRequest::Kind::Count;
  request.count = modes;
  request.pairTolerance = 0;
  return makeBasis("Craig-Bampton", Teuchos::ParameterList())->build(part, request);
}

/// A uniform bar of 400 elements that is joined at one end and free at the other.
model::Substructure bar() {
  auto part = samples::bar("bar", 1, 400, 400.0, 1.0 / 400);
  samples::classify(part, {1});
  return part;
}

// Modes of the bar held at its end: sin((2k-1) pi x / 2), so L_k^2 is to the mass of the bar as 8 /
// ((2k-1) pi)^2 to 1.
TEST(InterfaceShares, OfABarAreItsEffectiveMasses) {
  const Vector shares =
      interfaceShares(bar(), craigBampton(bar(), 4), ModeRule::Kind::InterfaceMass);
  for (int k = 1; k <= 4; ++k)
    EXPECT_NEAR(shares[k - 1], 8.0 / std::pow((2 * k - 1) * constants::pi, 2), 4e-3 * shares[k - 1])
        << k;
}

// Divided by omega_k^2, which grows as (2k-1)^2: 96 / ((2k-1) pi)^4.
TEST(InterfaceShares, OfABarWeighLowFrequenciesMoreAsMoments) {
  const Vector shares =
      interfaceShares(bar(), craigBampton(bar(), 4), ModeRule::Kind::InterfaceMoment);
  for (int k = 1; k <= 4; ++k)
    EXPECT_NEAR(shares[k - 1], 96.0 / std::pow((2 * k - 1) * constants::pi, 4),
                4e-3 * shares[k - 1])
        << k;
}

TEST(InterfaceShares, OfAllModesAreOne) {
  for (const auto& part : samples::loopFrame(6, true, true))
    for (const auto kind : {ModeRule::Kind::InterfaceMass, ModeRule::Kind::InterfaceMoment})
      EXPECT_NEAR(interfaceShares(part, craigBampton(part, 1000), kind).sum(), 1.0, 1e-9)
          << part.name;
}

TEST(KeepByShare, TakesTheLargestFirstAndWholePairs) {
  const Vector shares = (Vector(5) << 0.1, 0.05, 0.5, 0.02, 0.3).finished();
  const Vector apart = (Vector(5) << 1, 4, 9, 16, 25).finished();
  EXPECT_EQ(keepByShare(shares, apart, 0.7, 0.01), (std::vector<char>{0, 0, 1, 0, 1}));
  EXPECT_EQ(keepByShare(shares, apart, 0.81, 0.01), (std::vector<char>{1, 0, 1, 0, 1}));
  const Vector pair = (Vector(5) << 1, 4, 4.001, 16, 25).finished();
  EXPECT_EQ(keepByShare(shares, pair, 0.7, 0.01), (std::vector<char>{0, 1, 1, 0, 1}));
  EXPECT_TRUE(keepByShare(shares, apart, 0.98, 0.01).empty()) << "more modes must be known";
  const Vector buckled = (Vector(5) << -1, 4, 9, 16, 25).finished();
  EXPECT_EQ(keepByShare(shares, buckled, 0.5, 0.01), (std::vector<char>{1, 0, 1, 0, 0}))
      << "a buckled mode is always kept";
}

ReductionOptions fraction(ModeRule::Kind kind, double value) {
  ReductionOptions options;
  options.modes.kind = kind;
  options.modes.fraction = value;
  return options;
}

TEST(InterfaceCriteria, ReducedPartsHoldTheFraction) {
  const auto basis = makeBasis("Craig-Bampton", Teuchos::ParameterList());
  for (const auto kind : {ModeRule::Kind::InterfaceMass, ModeRule::Kind::InterfaceMoment}) {
    int before = 0;
    for (double value : {0.5, 0.9, 0.99, 1.0}) {
      const auto parts = samples::loopFrame(20, false);
      const auto reduced = reduceAll(parts, *basis, fraction(kind, value));
      int modes = 0;
      for (std::size_t p = 0; p < parts.size(); ++p) {
        EXPECT_GE(interfaceShares(parts[p], *reduced[p].basis, kind).sum(), value - 1e-9);
        EXPECT_EQ(reduced[p].modes, reduced[p].basis->vectors.cols() -
                                        3 * static_cast<int>(parts[p].interface.size()) / 3);
        EXPECT_TRUE(reduced[p].report.structureEnforced);
        modes += reduced[p].modes;
      }
      EXPECT_GT(modes, before) << value;
      before = modes;
    }
  }
}

TEST(InterfaceCriteria, ASecondModeOfBendingMayComeBeforeAnAxialOne) {
  // Rows of the report stay in the order of frequency, kept or not.
  const auto reduced = reduceAll(samples::loopFrame(20, false),
                                 *makeBasis("Craig-Bampton", Teuchos::ParameterList()),
                                 fraction(ModeRule::Kind::InterfaceMass, 0.8));
  bool skipped = false;
  for (const auto& part : reduced) {
    bool dropped = false;
    double last = 0;
    for (const auto& row : part.basisRows()) {
      if (row.kind == "constraint") continue;
      EXPECT_GE(row.eigenvalue, last);
      last = row.eigenvalue;
      skipped = skipped || (dropped && row.kept);
      dropped = dropped || !row.kept;
    }
  }
  EXPECT_TRUE(skipped) << "a mode above a dropped one was kept";
}

}  // namespace InterfaceCriteriaTest
