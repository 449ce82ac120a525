// SPDX-License-Identifier: BSD-3-Clause
#include "statics/PathContinuation.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <tuple>
#include <utility>
#include <vector>

#include "common/Constants.hpp"
#include "common/Error.hpp"

namespace tooljoint::statics {
namespace PathContinuationTest {

/// Euler load of a clamped column, E I = L = 1.
constexpr double euler = 0.25 * constants::pi * constants::pi;

/// One equation r(x, p) = 0 with its derivatives.
struct Curve : model::ParametricProblem {
  using Function = std::function<double(double, double)>;
  Function r, dx, dp;
  Curve(Function r_, Function dx_, Function dp_)
      : r(std::move(r_)), dx(std::move(dx_)), dp(std::move(dp_)) {}
  int size() const override { return 1; }
  void residual(const Vector& x, double p, Vector& out) const override {
    out = Vector::Constant(1, r(x[0], p));
  }
  void jacobian(const Vector& x, double p, Sparse& J) const override {
    J.resize(1, 1);
    J.coeffRef(0, 0) = dx(x[0], p);
  }
  void parameterDerivative(const Vector& x, double p, Vector& out) const override {
    out = Vector::Constant(1, dp(x[0], p));
  }
  Vector residualScale() const override { return Vector::Ones(1); }
  Vector pathWeights() const override { return Vector::Ones(1); }
  double parameterScale() const override { return 1.0; }
  std::string unknownName(int) const override { return "x"; }
};

/// A column of n rigid links of the length 1/n with springs n between them (E I = 1, L = 1), x the
/// angles of the links against the load p, clamped at its first end by a spring 2 n:
///
///     V = n x_1^2 + n/2 sum (x_{i+1} - x_i)^2 + p/n sum cos x_i - m x_n
///
/// m a small moment at the free end. As half of a hinged chain of 2 n links it buckles at 4 n^2
/// sin^2(pi/(4 n)).
struct Column : model::ParametricProblem {
  int n;
  double m;
  Column(int links, double moment) : n(links), m(moment) {}
  int size() const override { return n; }
  void residual(const Vector& x, double p, Vector& r) const override {
    r = -p / n * x.array().sin().matrix();
    r[0] += 2.0 * n * x[0];
    r[n - 1] -= m;
    for (int i = 0; i + 1 < n; ++i) {
      r[i] -= n * (x[i + 1] - x[i]);
      r[i + 1] += n * (x[i + 1] - x[i]);
    }
  }
  void jacobian(const Vector& x, double p, Sparse& J) const override {
    Triplets all;
    for (int i = 0; i < n; ++i) {
      const double springs = i == 0 ? 3.0 * n : (i + 1 == n ? 1.0 * n : 2.0 * n);
      all.emplace_back(i, i, springs - p / n * std::cos(x[i]));
      if (i > 0) all.emplace_back(i, i - 1, -n);
      if (i + 1 < n) all.emplace_back(i, i + 1, -n);
    }
    J.resize(n, n);
    J.setFromTriplets(all.begin(), all.end());
  }
  void parameterDerivative(const Vector& x, double, Vector& out) const override {
    out = -x.array().sin().matrix() / n;
  }
  std::optional<int> negativePivots(const Vector& x, double p) const override {
    Sparse J;
    jacobian(x, p, J);
    const Eigen::SelfAdjointEigenSolver<Matrix> modes(Matrix(J), Eigen::EigenvaluesOnly);
    return static_cast<int>((modes.eigenvalues().array() < 0.0).count());
  }
  Vector residualScale() const override { return Vector::Ones(n); }
  Vector pathWeights() const override { return Vector::Constant(n, 1.0 / n); }
  double parameterScale() const override { return euler; }
  std::string unknownName(int i) const override { return "link " + std::to_string(i + 1); }
  double criticalLoad() const {
    const double s = std::sin(0.25 * constants::pi / n);
    return 4.0 * n * n * s * s;
  }
};

struct Path {
  std::vector<PathPoint> points;
  PathReport report;
};
Path follow(const model::ParametricProblem& problem, const Vector& start,
            const PathOptions& options) {
  Path path;
  path.report = followPath(problem, start, options, [&](const PathPoint& point) {
    path.points.push_back(point);
    return true;
  });
  return path;
}

// p = x - x^3/3 grows from -3 to 2/3 at x = 1, falls to -2/3 at x = -1, and grows again.
TEST(PathContinuation, GoesThroughTurningPoints) {
  const Curve curve([](double x, double p) { return x * x * x / 3.0 - x + p; },
                    [](double x, double) { return x * x - 1.0; },
                    [](double, double) { return 1.0; });
  PathOptions options;
  options.from = -3.0, options.to = 1.0;
  const auto path = follow(curve, Vector::Constant(1, 2.6), options);
  EXPECT_EQ(path.report.end, PathEnd::Reached) << path.report.explanation;
  ASSERT_GT(path.points.size(), 10U);
  double top = -10.0;
  int falling = 0;
  for (std::size_t i = 0; i < path.points.size(); ++i) {
    const double x = path.points[i].x[0], p = path.points[i].parameter;
    EXPECT_NEAR(p, x - x * x * x / 3.0, 1e-8);
    if (i > 0 && p < path.points[i - 1].parameter) ++falling;
    if (x > 0.0) top = std::max(top, p);
  }
  EXPECT_NEAR(top, 2.0 / 3.0, 5e-3);
  EXPECT_GT(falling, 5);                           // between the turning points
  EXPECT_LT(path.points.back().x[0], -1.0);        // beyond both
  EXPECT_NEAR(path.report.parameter, 1.0, 1e-12);  // the end is met exactly
}

TEST(PathContinuation, FollowsTheElasticaThroughTheEulerLoad) {
  const Column column(60, 1e-3);
  PathOptions options;
  options.to = 2.0 * euler;
  const auto path = follow(column, Vector::Zero(60), options);
  ASSERT_EQ(path.report.end, PathEnd::Reached) << path.report.explanation;
  // Elastica: P/P_E = (2 K(sin(alpha/2))/pi)^2 with alpha the slope at the free end (Timoshenko and
  // Gere, Theory of Elastic Stability, 2.7); K by the arithmetic-geometric mean. The links are
  // second order in 1/n; the moment m is 1e-3.
  int compared = 0;
  for (const auto& point : path.points) {
    const double alpha = std::abs(point.x[59]);
    if (alpha < 0.5) continue;
    double a = 1.0, b = std::cos(0.5 * alpha);
    for (int i = 0; i < 8; ++i) std::tie(a, b) = std::make_pair(0.5 * (a + b), std::sqrt(a * b));
    const double ratio = 1.0 / (a * a);  // K = pi/(2 a)
    EXPECT_NEAR(point.parameter / column.criticalLoad(), ratio, 3e-3 * ratio) << alpha;
    ++compared;
  }
  EXPECT_GT(compared, 5);
  EXPECT_GT(std::abs(path.points.back().x[59]), 1.5);
}

TEST(PathContinuation, StaysOnTheStraightColumnWithoutImperfection) {
  const Column column(20, 0.0);
  PathOptions options;
  options.to = 1.5 * euler;
  const auto path = follow(column, Vector::Zero(20), options);
  EXPECT_EQ(path.report.end, PathEnd::Reached) << path.report.explanation;
  EXPECT_LT(path.points.back().x.cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_EQ(path.points.front().negativePivots, 0);
  EXPECT_EQ(path.points.back().negativePivots, 1);
  // the bifurcation lies within one short step
  for (std::size_t i = 1; i < path.points.size(); ++i)
    if (path.points[i].negativePivots != path.points[i - 1].negativePivots) {
      EXPECT_LE(path.points[i - 1].parameter, column.criticalLoad());
      EXPECT_GE(path.points[i].parameter, column.criticalLoad());
      EXPECT_LE(path.points[i].parameter - path.points[i - 1].parameter,
                options.bifurcationStep * euler * (1.0 + 1e-9));
    }
}

// x^2 = 1 - p has no solution beyond p = 1: the path returns on the other branch.
TEST(PathContinuation, SaysHowAPathEnds) {
  const Curve parabola([](double x, double p) { return x * x + p - 1.0; },
                       [](double x, double) { return 2.0 * x; },
                       [](double, double) { return 1.0; });
  PathOptions options;
  options.to = 2.0;
  const auto back = follow(parabola, Vector::Ones(1), options);
  EXPECT_EQ(back.report.end, PathEnd::Returned) << back.report.explanation;
  EXPECT_NEAR(back.points.back().x[0], -1.0, 1e-8);

  options.maxSteps = 3;
  const auto few = follow(parabola, Vector::Ones(1), options);
  EXPECT_EQ(few.report.end, PathEnd::Steps) << few.report.explanation;
  EXPECT_NE(few.report.explanation.find("the number allowed"), std::string::npos);

  const auto stopped = followPath(parabola, Vector::Ones(1), PathOptions{},
                                  [](const PathPoint& point) { return point.step < 2; });
  EXPECT_EQ(stopped.end, PathEnd::Stopped) << stopped.explanation;
  EXPECT_EQ(stopped.steps, 2);

  // a force that jumps: no step across x = 0.5 converges
  const Curve jump([](double x, double p) { return x - p + (x > 0.5 ? 1.0 : 0.0); },
                   [](double, double) { return 1.0; }, [](double, double) { return -1.0; });
  const auto failed = follow(jump, Vector::Zero(1), PathOptions{});
  EXPECT_EQ(failed.report.end, PathEnd::Failed) << failed.report.explanation;
  EXPECT_NEAR(failed.report.parameter, 0.5, 1e-2);
  EXPECT_NE(failed.report.explanation.find("does not converge"), std::string::npos)
      << failed.report.explanation;
}

TEST(PathContinuation, RefusesWhatDoesNotFit) {
  const Column column(4, 0.0);
  const auto ignore = [](const PathPoint&) { return true; };
  EXPECT_THROW(followPath(column, Vector::Zero(3), PathOptions{}, ignore), ModelError);
  PathOptions options;
  options.to = options.from;
  EXPECT_THROW(followPath(column, Vector::Zero(4), options, ignore), ModelError);
  options = {};
  options.firstStep = 1.0;
  EXPECT_THROW(followPath(column, Vector::Zero(4), options, ignore), ModelError);
  // an exception of an observer is passed on
  EXPECT_THROW(followPath(column, Vector::Zero(4), PathOptions{},
                          [](const PathPoint&) -> bool { throw DeckError("observer"); }),
               DeckError);
}

}  // namespace PathContinuationTest
}  // namespace tooljoint::statics
