// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Frequencies of a held bar in closed form: cut-off frequencies and printed frequencies are in Hz.
#include <Teuchos_ParameterList.hpp>
#include <cmath>
#include <gtest/gtest.h>

#include "common/Constants.hpp"
#include "reduction/Reduce.hpp"
#include "tests/support/SampleParts.hpp"

namespace CutOffTest {

using namespace tooljoint;

constexpr int elements = 8;
constexpr double stiffness = 3e4, mass = 0.2;

/// Bar of linear elements with consistent mass, held at both ends: omega_j^2 = 6 k (1 - c)/(m (2 +
/// c)), c = cos(j pi/n).
double hertz(int j) {
  const double pi = constants::pi, c = std::cos(j * pi / elements);
  return std::sqrt(6.0 * stiffness * (1.0 - c) / (mass * (2.0 + c))) / (2.0 * pi);
}

reduction::ReducedSubstructure reducedBelow(double cutOffHz) {
  auto part = samples::bar("bar", 1, elements, stiffness, mass);
  samples::classify(part, {1, elements + 1});
  reduction::ReductionOptions options;
  options.modes.kind = reduction::ModeRule::Kind::CutOff;
  options.modes.cutOffHz = cutOffHz;
  return reduction::reduceAll(
             {part}, *reduction::makeBasis("Craig-Bampton", Teuchos::ParameterList()), options)
      .front();
}

TEST(CutOff, KeepsTheModesBelowAFrequencyInHertz) {
  for (int j = 1; j <= 4; ++j) {
    EXPECT_EQ(reducedBelow(1.01 * hertz(j)).report.modes, j);
    EXPECT_EQ(reducedBelow(0.99 * hertz(j)).report.modes, j - 1);
  }
}

TEST(CutOff, IsReportedInHertz) {
  const auto part = reducedBelow(1.01 * hertz(3));
  EXPECT_NEAR(part.report.cutOffHz(), hertz(3), 1e-9 * hertz(3));
  for (int j = 1; j <= 3; ++j)
    EXPECT_NEAR(part.basis->eigenvalues[j - 1], std::pow(constants::twoPi * hertz(j), 2),
                1e-8 * part.basis->eigenvalues[2]);
}

}  // namespace CutOffTest
