// SPDX-License-Identifier: BSD-3-Clause
// Modes with known shapes: tracks through crossings, veerings, jumps and new modes.
#include "response/campbell/ModeTracker.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace tooljoint::response {
namespace ModeTrackerTest {

using Complex = std::complex<double>;

Sparse identity(int n) {
  Sparse M(n, n);
  M.setIdentity();
  return M;
}

/// Modes of unit shapes with these frequencies, by |s|.
VibratingModes sorted(std::vector<double> frequencies, Eigen::MatrixXcd shapes) {
  std::vector<int> order(frequencies.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i);
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    return frequencies[static_cast<std::size_t>(a)] < frequencies[static_cast<std::size_t>(b)];
  });
  VibratingModes out{Eigen::VectorXcd(shapes.cols()), shapes, {0, 1}, {}};
  for (std::size_t i = 0; i < order.size(); ++i) {
    out.values[static_cast<Eigen::Index>(i)] =
        Complex(0, frequencies[static_cast<std::size_t>(order[i])]);
    out.shapes.col(static_cast<Eigen::Index>(i)) = shapes.col(order[i]);
  }
  return out;
}

const TrackedMode& track(const ModeTracker& tracker, int number) {
  for (const auto& mode : tracker.now())
    if (mode.track == number) return mode;
  throw std::runtime_error("no such track");
}

TEST(ModeTracker, CrossingModesKeepTheirNumbers) {
  ModeTracker tracker(
      [](double speed, int) {
        return sorted({1.0 + speed, 3.0 - speed}, Eigen::MatrixXcd::Identity(2, 2));
      },
      identity(2));
  for (const double speed : {0.0, 0.5, 1.0, 1.5, 2.0}) {
    tracker.advance(speed);
    EXPECT_EQ(track(tracker, 1).s, Complex(0, 1.0 + speed));
    EXPECT_EQ(track(tracker, 2).s, Complex(0, 3.0 - speed));
    EXPECT_EQ(tracker.now().size(), 2U);
  }
}

// Shapes that rotate by 60 degrees between two speeds have a MAC of 1/4: tracking needs smaller
// steps.
TEST(ModeTracker, StepsAreHalvedWhereShapesTurn) {
  int calls = 0;
  ModeTracker tracker(
      [&calls](double speed, int) {
        ++calls;
        const double angle = speed * std::acos(-1.0) / 3.0;
        Eigen::MatrixXcd shapes(2, 2);
        shapes << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
        return sorted({2.0 - speed, 2.2 + speed}, shapes);
      },
      identity(2));
  tracker.advance(0.0);
  tracker.advance(1.0);
  EXPECT_GT(calls, 4);
  EXPECT_EQ(track(tracker, 1).s, Complex(0, 1.0));
  EXPECT_GE(track(tracker, 1).mac, 0.9);
}

// u and v of the same value span one subspace: their whirls are any combination of them.
TEST(ModeTracker, RepeatedValuesSplitWithoutBeingLost) {
  ModeTracker tracker(
      [](double speed, int) {
        if (speed == 0.0) return sorted({1.0, 1.0}, Eigen::MatrixXcd::Identity(2, 2));
        Eigen::MatrixXcd circles(2, 2);
        circles << 1.0, 1.0, Complex(0, -1), Complex(0, 1);
        return sorted({1.0 + speed, 1.0 - speed}, circles);
      },
      identity(2));
  tracker.advance(0.0);
  tracker.advance(0.5);
  ASSERT_EQ(tracker.now().size(), 2U);
  for (const auto& mode : tracker.now()) {
    EXPECT_LE(mode.track, 2);
    EXPECT_NEAR(mode.mac, 1.0, 1e-12);
  }
}

// A mode at the edge of a window may leave it: the step is not reduced, and its track ends.
TEST(ModeTracker, ModesAtTheEdgeLeaveWithoutSmallerSteps) {
  for (const bool edge : {false, true}) {
    int calls = 0;
    ModeTracker tracker(
        [&](double speed, int) {
          ++calls;
          auto modes = sorted({1.0, 2.0}, Eigen::MatrixXcd::Identity(2, 2));
          modes.wanted = speed < 0.5 ? std::vector<int>{0, 1} : std::vector<int>{0};
          if (speed >= 0.5 && edge) modes.edge = {1};
          if (speed > 1.5) modes.shapes.col(1).setZero(), modes.shapes(0, 1) = 1.0;
          return modes;
        },
        identity(2));
    for (const double speed : {0.0, 1.0, 2.0}) tracker.advance(speed);
    ASSERT_EQ(tracker.now().size(), 1U);
    EXPECT_EQ(tracker.now()[0].track, 1);
    EXPECT_EQ(calls == 3, edge);
  }
}

TEST(ModeTracker, NewModesBeginTracksAndStrangersEndThem) {
  ModeTracker tracker(
      [](double speed, int) {
        Eigen::MatrixXcd shapes = Eigen::MatrixXcd::Identity(3, 3);
        if (speed < 0.5) return sorted({1.0, 2.0}, shapes.leftCols(2));
        return sorted({1.0, 1.5},
                      Eigen::MatrixXcd((Eigen::MatrixXcd(3, 2) << 1, 0, 0, 0, 0, 1).finished()));
      },
      identity(3));
  tracker.advance(0.0);
  tracker.advance(1.0);
  ASSERT_EQ(tracker.now().size(), 2U);
  EXPECT_EQ(tracker.now()[0].track, 1);
  EXPECT_EQ(tracker.now()[1].track, 3);  // the shape of track 2 is gone
}

}  // namespace ModeTrackerTest
}  // namespace tooljoint::response
