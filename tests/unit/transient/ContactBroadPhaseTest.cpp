// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// No inactive point closes its clearance, and most points are inactive.
#include "transient/points/ContactBroadPhase.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numeric>
#include <random>

namespace tooljoint::transient {
namespace ContactBroadPhaseTest {

std::vector<int> upTo(int count) {
  std::vector<int> all(static_cast<std::size_t>(count));
  std::iota(all.begin(), all.end(), 0);
  return all;
}

/// Points of three coordinates (two of them lengths) on one block of coordinates, clearance = gap -
/// |(d_0, d_1)|.
struct Cloud {
  static constexpr int points = 40, width = 3, coordinates = 30;
  std::vector<int> rowBegin{0}, column;
  std::vector<double> value;
  Matrix rows = Matrix::Zero(points * width, coordinates);
  linalg::BlockPattern pattern;

  explicit Cloud(unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    for (int r = 0; r < points * width; ++r) {
      for (int j = 0; j < coordinates; ++j) {
        rows(r, j) = r % width == 2 ? 100.0 * normal(random) : normal(random) / (1 + j);
        column.push_back(j);
        value.push_back(rows(r, j));
      }
      rowBegin.push_back(static_cast<int>(column.size()));
    }
    const Sparse full = Matrix::Ones(coordinates, coordinates).sparseView();
    const std::vector<int> group(coordinates, 0);
    pattern = linalg::BlockPattern(linalg::partitionDofs({&full}, group, group), {&full});
  }
  double clearance(int p, const Vector& q) const {
    return 1.0 + 0.05 * p - (rows.middleRows(p * width, 2) * q).norm();
  }
  ContactBroadPhase watch() const {
    return {upTo(points), width, 2, rowBegin, column, value, pattern};
  }
};

struct Walk {
  long looks = 0;
  int touches = 0, missed = 0;
};

/// A damped walk about zero in steps of this size.
Walk walk(double size, int steps) {
  const Cloud cloud(3);
  auto watch = cloud.watch();
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  Vector q = Vector::Zero(Cloud::coordinates), v = q;
  std::vector<double> measured(Cloud::points, 0.0);
  Walk result;
  for (int step = 0; step < steps; ++step) {
    for (int j = 0; j < Cloud::coordinates; ++j) {
      v[j] += size * normal(random) - 0.02 * v[j] - 0.002 * q[j];
      q[j] += 0.1 * v[j];
    }
    watch.activate(q.data());
    const auto seen = watch.active();
    for (int p : seen) measured[static_cast<std::size_t>(p)] = cloud.clearance(p, q);
    result.looks += static_cast<long>(seen.size());
    watch.deactivate(q.data(), measured.data());
    for (int p = 0; p < Cloud::points; ++p) {
      if (cloud.clearance(p, q) > 0) continue;
      ++result.touches;
      result.missed += !std::binary_search(seen.begin(), seen.end(), p);
    }
  }
  return result;
}

/// A broad phase with the restored memory of another activates the same points.
TEST(ContactBroadPhase, goesOnFromItsMemory) {
  const Cloud cloud(3);
  auto watch = cloud.watch();
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  Vector q = Vector::Zero(Cloud::coordinates);
  std::vector<double> measured(Cloud::points, 0.0);
  const auto look = [&](ContactBroadPhase& one) {
    one.activate(q.data());
    for (int p : one.active()) measured[static_cast<std::size_t>(p)] = cloud.clearance(p, q);
    one.deactivate(q.data(), measured.data());
  };
  std::size_t asleep = 0;
  for (int step = 0; step < 40; ++step) {
    for (int j = 0; j < Cloud::coordinates; ++j) q[j] += 0.003 * normal(random);
    look(watch);
    std::vector<double> memory, again;
    watch.save(memory);
    auto other = cloud.watch();
    const double* at = memory.data();
    other.restore(at);
    EXPECT_EQ(at, memory.data() + memory.size());
    EXPECT_EQ(other.active(), watch.active());
    other.save(again);
    EXPECT_EQ(again, memory);
    asleep += Cloud::points - watch.active().size();
    look(other);
    auto copy = watch;
    look(copy);
    EXPECT_EQ(other.active(), copy.active());
  }
  EXPECT_GT(asleep, 100u);
}

TEST(ContactBroadPhase, NoPointTouchesInItsSleep) {
  const Walk wild = walk(0.01, 4000);
  EXPECT_GT(wild.touches, 10) << "the walk must reach the wall";
  EXPECT_EQ(wild.missed, 0);
}

TEST(ContactBroadPhase, PointsFarFromTheWallSleep) {
  const Walk calm = walk(0.002, 4000);
  EXPECT_EQ(calm.touches, 0);
  EXPECT_LT(calm.looks, 4000L * Cloud::points / 2);
}

/// Rows of one sign with all coordinates moving alike: the bound equals the true displacement of
/// the point, so the point is evaluated when it touches and not long before.
TEST(ContactBroadPhase, ThePointThatGoesStraightToTheWallIsLookedAtInTime) {
  constexpr int points = 3, width = 2, coordinates = 20;
  std::vector<int> rowBegin{0}, column;
  std::vector<double> value;
  for (int row = 0; row < points * width; ++row) {
    for (int j = 0; j < coordinates; ++j) {
      column.push_back(j);
      value.push_back(row % width == 0 ? 3.0
                                       : 4.0);  // 5 m along (0.6, 0.8) per unit of each coordinate
    }
    rowBegin.push_back(static_cast<int>(column.size()));
  }
  const Sparse full = Matrix::Ones(coordinates, coordinates).sparseView();
  const std::vector<int> group(coordinates, 0);
  const linalg::BlockPattern pattern(linalg::partitionDofs({&full}, group, group), {&full});
  ContactBroadPhase watch(upTo(points), width, width, rowBegin, column, value, pattern);
  const auto at = [](double way) {
    return Vector(Vector::Constant(coordinates, way / (5.0 * coordinates)));
  };
  Vector q = at(0.0);
  const double clearance[points] = {0.4, 0.5, 0.9};
  watch.activate(q.data());
  watch.deactivate(q.data(), clearance);
  EXPECT_TRUE(watch.active().empty());
  q = at(0.39);
  watch.activate(q.data());
  EXPECT_TRUE(watch.active().empty()) << "the nearest point still has 0.01 m";
  q = at(0.4001);
  watch.activate(q.data());
  EXPECT_EQ(watch.active(), (std::vector<int>{0, 1, 2})) << "the nearest point touches";
}

TEST(ContactBroadPhase, CheapPointsStayAwake) {
  const std::vector<int> rowBegin{0, 1, 2}, column{0, 1};
  const std::vector<double> value{1.0, 1.0};
  const Sparse full = Matrix::Ones(2, 2).sparseView();
  const linalg::BlockPattern pattern(linalg::partitionDofs({&full}, {0, 0}, {0, 0}), {&full});
  ContactBroadPhase watch(upTo(2), 1, 1, rowBegin, column, value, pattern);
  const double q[2] = {0.0, 0.0}, clearance[2] = {1.0, 1.0};
  watch.activate(q);
  watch.deactivate(q, clearance);
  EXPECT_EQ(watch.active(), (std::vector<int>{0, 1}));
}

TEST(ContactBroadPhase, GoesOnAsItWas) {
  const Cloud cloud(11);
  auto first = cloud.watch();
  Vector q = Vector::Constant(Cloud::coordinates, 1e-3);
  std::vector<double> measured(Cloud::points, 0.0);
  const auto step = [&](ContactBroadPhase& watch) {
    watch.activate(q.data());
    for (int p : watch.active()) measured[static_cast<std::size_t>(p)] = cloud.clearance(p, q);
    watch.deactivate(q.data(), measured.data());
  };
  for (int i = 0; i < 50; ++i) q *= 1.05, step(first);
  std::vector<double> memory;
  first.save(memory);
  auto second = cloud.watch();
  const double* read = memory.data();
  second.restore(read);
  EXPECT_EQ(read, memory.data() + memory.size());
  for (int i = 0; i < 100; ++i) {
    q *= 1.05;
    step(first);
    step(second);
    EXPECT_EQ(first.active(), second.active());
  }
}

}  // namespace ContactBroadPhaseTest
}  // namespace tooljoint::transient
