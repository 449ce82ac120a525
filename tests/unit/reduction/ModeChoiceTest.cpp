// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// How many modes are kept.
#include "reduction/selection/ModeChoice.hpp"

#include <gtest/gtest.h>

namespace ModeChoiceTest {

using namespace tooljoint;
using namespace tooljoint::reduction;

/// omega^2 of the given signed frequencies.
Vector spectrum(std::initializer_list<double> omegas) {
  Vector values(static_cast<Eigen::Index>(omegas.size()));
  Eigen::Index k = 0;
  for (double omega : omegas) values[k++] = omega * std::abs(omega);
  return values;
}

TEST(RoundUp, KeepsTheNumberWhereFrequenciesAreApart) {
  const Vector values = spectrum({1, 2, 3, 4});
  for (int count = 0; count <= 4; ++count) EXPECT_EQ(roundUp(values, count, 0.01), count);
  EXPECT_EQ(roundUp(values, 9, 0.01), 4);
  EXPECT_EQ(roundUp(values, -1, 0.01), 0);
}

TEST(RoundUp, NeverCutsAPair) {
  const Vector values = spectrum({1.0, 1.002, 2.0, 2.003, 3.0});
  EXPECT_EQ(roundUp(values, 1, 0.01), 2);
  EXPECT_EQ(roundUp(values, 2, 0.01), 2);
  EXPECT_EQ(roundUp(values, 3, 0.01), 4);
  EXPECT_EQ(roundUp(values, 3, 0.001), 3) << "a smaller pair tolerance does not see this pair";
}

TEST(RoundUp, DoesNotChainThroughADenseSpectrum) {
  // Values 0.3 % apart in close pairs: the cut moves by at most one mode.
  Vector values(200);
  for (int k = 0; k < 200; ++k) {
    const double omega = 100.0 * std::pow(1.003, k) * (k % 2 == 1 ? 0.9995 : 1.0);
    values[k] = omega * omega;
  }
  for (int count = 1; count < 199; ++count)
    EXPECT_EQ(roundUp(values, count, 0.01), count + count % 2) << count;
}

TEST(RoundUp, KeepsEqualFrequenciesTogetherHoweverMany) {
  const Vector values = spectrum({0.0, 0.0, 0.0, 5.0, 5.0, 5.0000001, 9.0});
  EXPECT_EQ(roundUp(values, 1, 0.01), 3) << "rigid-body modes";
  EXPECT_EQ(roundUp(values, 4, 0.0), 6);
}

TEST(RoundUp, OrdersNegativeEigenvaluesBelowZero) {
  const Vector values = spectrum({-3.0, -2.999, 1.0});
  EXPECT_EQ(roundUp(values, 1, 0.01), 2);
  EXPECT_LT(signedOmega(-4.0), 0.0);
}

TEST(ShareTotal, TakesTheLowestOverAllParts) {
  const std::vector<Vector> spectra{spectrum({1, 5, 9}), spectrum({2, 3, 4})};
  const std::vector<bool> complete{true, true};
  EXPECT_EQ(shareTotal(spectra, complete, 0, 0.01), (std::vector<int>{0, 0}));
  EXPECT_EQ(shareTotal(spectra, complete, 1, 0.01), (std::vector<int>{1, 0}));
  EXPECT_EQ(shareTotal(spectra, complete, 4, 0.01), (std::vector<int>{1, 3}));
  EXPECT_EQ(shareTotal(spectra, complete, 5, 0.01), (std::vector<int>{2, 3}));
  EXPECT_EQ(shareTotal(spectra, complete, 50, 0.01), (std::vector<int>{3, 3}));
}

TEST(ShareTotal, AsksForMoreWhereAPartIsNotKnownFarEnough) {
  const std::vector<Vector> spectra{spectrum({1, 5, 9}), spectrum({2, 3, 4})};
  EXPECT_EQ(shareTotal(spectra, {true, false}, 4, 0.01), (std::vector<int>{1, -1}));
  EXPECT_EQ(shareTotal(spectra, {true, false}, 2, 0.01), (std::vector<int>{1, 1}));
}

TEST(ShareTotal, RoundsUpWithinEachPart) {
  const std::vector<Vector> spectra{spectrum({1.0, 1.001, 7.0}), spectrum({2.0, 2.001, 8.0})};
  EXPECT_EQ(shareTotal(spectra, {true, true}, 1, 0.01), (std::vector<int>{2, 0}));
  EXPECT_EQ(shareTotal(spectra, {true, true}, 3, 0.01), (std::vector<int>{2, 2}));
}

}  // namespace ModeChoiceTest
