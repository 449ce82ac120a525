// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Statistics of motions with known quantiles, duties, spreads and spectra.
#include "study/Statistics.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

#include "common/Constants.hpp"
#include "common/Error.hpp"

namespace StatisticsTest {

using namespace tooljoint;

using constants::pi;
constexpr double never = std::numeric_limits<double>::infinity();

/// Node 1 moves as a sine in u, node 2 stands still at v = 0.5; 4096 samples at 256 Hz.
struct Sine {
  explicit Sine(double amplitude, double frequency = 8.0) {
    for (int i = 0; i < 4096; ++i) {
      time.push_back(i / 256.0);
      const double u = amplitude * std::sin(2.0 * pi * frequency * time.back());
      displacement.insert(displacement.end(), {u, 0.0, 0.0, 0.0, 0.5, 0.0});
      speed.push_back(static_cast<double>(i));
    }
  }
  study::HistoryView view() const { return {time.data(), displacement.data(), time.size(), 2, 3}; }
  study::MotionStatistics statistics(const std::vector<double>& clearance = {never, never},
                                     const study::Window& window = {}) const {
    return study::statisticsOf(view(), speed, clearance, window);
  }
  std::vector<double> time, displacement, speed;
};

TEST(Quantile, IsLinearBetweenNeighbours) {
  EXPECT_DOUBLE_EQ(study::quantile({4.0, 1.0, 3.0, 2.0}, 0.5), 2.5);
  EXPECT_DOUBLE_EQ(study::quantile({4.0, 1.0, 3.0, 2.0}, 0.0), 1.0);
  EXPECT_DOUBLE_EQ(study::quantile({4.0, 1.0, 3.0, 2.0}, 1.0), 4.0);
  EXPECT_DOUBLE_EQ(study::quantile({7.0}, 0.3), 7.0);
  EXPECT_THROW(study::quantile({}, 0.5), Error);
}

TEST(Statistics, QuantilesOfTheBitSpeedInsideTheWindow) {
  const Sine sine(1.0);
  const auto s = sine.statistics({never, never}, {0.0, 100.0 / 256.0});  // speeds 0 ... 100
  EXPECT_EQ(s.samples, 101u);
  EXPECT_NEAR(s.bitSpeed[0], 5.0, 1e-12);
  EXPECT_NEAR(s.bitSpeed[2], 50.0, 1e-12);
  EXPECT_NEAR(s.bitSpeed[4], 95.0, 1e-12);
}

TEST(Statistics, WithoutABitThereIsNothingToSayOfItsSpeed) {
  const Sine sine(1.0);
  const auto s = study::statisticsOf(sine.view(), {}, {never, never}, {});
  EXPECT_TRUE(s.bitSpeed.empty());
  EXPECT_EQ(s.lateralRms, sine.statistics().lateralRms);
  EXPECT_EQ(study::difference(s, s).bitSpeed, 0.0);
  EXPECT_THROW(study::difference(s, sine.statistics()), Error);
}

TEST(Statistics, RmsOfASineIsItsAmplitudeOverRootTwo) {
  const auto s = Sine(3.0).statistics();
  EXPECT_NEAR(s.lateralRms[0], 3.0 / std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(s.lateralRms[1], 0.0, 1e-12);
}

TEST(Statistics, ContactDutyOfASine) {
  // 32 samples a period, 11.25 degrees apart: those of 33.75 to 146.25 degrees and their opposites
  // lie above sin 30 degrees = 1/2
  const auto s = Sine(1.0).statistics({0.5, 0.4});
  EXPECT_NEAR(s.contactDuty[0], 22.0 / 32.0, 1e-12);
  EXPECT_EQ(s.contactDuty[1], 1.0);
  EXPECT_EQ(Sine(1.0).statistics({2.0, never}).contactDuty[0], 0.0);
}

TEST(Statistics, TheSpectrumOfASineHoldsHalfItsAmplitudeSquared) {
  const auto s = Sine(3.0).statistics();
  const double df = s.frequency[1] - s.frequency[0];
  double power = 0.0;
  std::size_t highest = 0;
  for (std::size_t k = 0; k < s.spectrum.size(); ++k) {
    power += s.spectrum[k] * df;
    if (s.spectrum[k] > s.spectrum[highest]) highest = k;
  }
  EXPECT_NEAR(power, 0.5 * (4.5 + 0.0), 1e-6);  // mean over the two nodes
  EXPECT_NEAR(s.frequency[highest], 8.0, 1e-12);
  EXPECT_NEAR(s.frequency.back(), 128.0, 1e-12);
}

TEST(Statistics, FewSamplesHaveNoSpectrum) {
  const auto s = Sine(1.0).statistics({never, never}, {0.0, 20.0 / 256.0});
  EXPECT_TRUE(s.spectrum.empty());
  EXPECT_EQ(s.contactDuty.size(), 2u);
}

TEST(Statistics, OfAnEmptyWindowAreRefused) {
  EXPECT_THROW(Sine(1.0).statistics({never, never}, {50.0, 60.0}), Error);
}

TEST(StatisticsDifference, IsZeroAgainstItself) {
  const auto s = Sine(1.0).statistics({0.5, 0.4});
  const auto d = study::difference(s, s);
  EXPECT_EQ(d.bitSpeed, 0.0);
  EXPECT_EQ(d.dutyMax, 0.0);
  EXPECT_EQ(d.lateralRms, 0.0);
  EXPECT_EQ(d.spectrum, 0.0);
}

TEST(StatisticsDifference, OfTwiceTheMotion) {
  const auto one = Sine(1.0).statistics({1.5, 0.4});
  const auto two = Sine(2.0).statistics({1.5, 0.4});
  const auto d = study::difference(two, one);
  EXPECT_NEAR(d.lateralRms, 1.0, 1e-12);
  EXPECT_NEAR(d.spectrum, 10.0 * std::log10(4.0), 1e-6);  // 6 dB in every band
  EXPECT_EQ(d.dutyMax, two.contactDuty[0]);               // the smaller motion never touches
  EXPECT_NEAR(d.dutyMean, 0.5 * two.contactDuty[0], 1e-15);
}

}  // namespace StatisticsTest
