// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Corotational beams against large-displacement solutions: the elastica, the roll-up, Bathe's
/// 45-degree bend.
#include <Eigen/Geometry>
#include <cmath>
#include <gtest/gtest.h>

#include "common/Constants.hpp"
#include "tests/support/DirectNewton.hpp"
#include "tests/support/FrameProblem.hpp"

namespace tooljoint::beam {
namespace LargeDisplacementTest {

using constants::pi;
using testing_::FrameProblem;

/// Cantilever along z with E I = 1, E S = 1e8, length 1.
FrameProblem cantilever(int elements) {
  const Section s = Section::general(1e8, 1.0, 1.0, 1.0, Material{1.0, 1.0, 0.0});
  std::vector<Vector3> positions;
  for (int i = 0; i <= elements; ++i)
    positions.emplace_back(0.0, 0.0, static_cast<double>(i) / elements);
  const std::vector<Matrix3> triads(positions.size(), Matrix3::Identity());
  const std::vector<CorotationalElement> chain(
      static_cast<std::size_t>(elements),
      CorotationalElement(stiffness(s, 1.0 / elements), 1.0 / elements));
  return FrameProblem(positions, triads, chain, 1.0, 1.0);
}

/// Brings the load on in equal steps; returns whether all converged.
bool loadUp(FrameProblem& problem, const Vector3& force, const Vector3& moment, int steps,
            double tolerance) {
  for (int step = 1; step <= steps; ++step) {
    const double part = static_cast<double>(step) / steps;
    problem.loadTip(part * force, part * moment);
    Vector x = problem.start();
    model::SolveRequest request;
    request.tolerance = tolerance;
    request.maxIterations = 60;
    request.search = model::LineSearch::None;
    if (!testing_::directNewton(problem, x, request).converged) return false;
    problem.accept(x);
  }
  return true;
}

TEST(LargeDisplacement, ElasticaUnderATipForce) {
  // Mattiasson (1981); straight chords of 60 elements: error below (1/60)^2
  struct Case {
    double load, across, along;
  };
  for (const Case& c : {Case{1.0, 0.30172, 0.05643}, Case{10.0, 0.81061, 0.55500}}) {
    FrameProblem problem = cantilever(60);
    ASSERT_TRUE(loadUp(problem, {c.load, 0.0, 0.0}, Vector3::Zero(), 5, 1e-5));
    EXPECT_NEAR(problem.tip().x(), c.across, 1.5e-4);
    EXPECT_NEAR(1.0 - problem.tip().z(), c.along, 1.5e-4);
    EXPECT_NEAR(problem.tip().y(), 0.0, 1e-9);
  }
}

TEST(LargeDisplacement, RollUpToAFullCircle) {
  // M = 2 pi E I/L: each of n elements turns by 2 pi/n, so the polygon closes exactly
  FrameProblem problem = cantilever(12);
  ASSERT_TRUE(loadUp(problem, Vector3::Zero(), {0.0, 2.0 * pi, 0.0}, 10, 1e-6));
  EXPECT_LT(problem.tip().norm(), 1e-6);
  EXPECT_LT((problem.tipTriad() - Matrix3::Identity()).norm(), 1e-6);
}

TEST(LargeDisplacement, Bathes45DegreeBend) {
  // Bathe and Bolourchi (1979): radius 100, unit square section, E = 1e7, nu = 0, tip force 600 out
  // of the plane. Reference values of Simo and Vu-Quoc (1986), eight straight elements.
  const int elements = 8;
  const Section s =
      Section::general(1.0, 1.0 / 12.0, 1.0 / 12.0, 1.0 / 6.0, Material{1.0, 1e7, 0.0});
  std::vector<Vector3> positions;
  std::vector<Matrix3> triads;
  for (int i = 0; i <= elements; ++i) {
    const double a = 0.25 * pi * i / elements;
    positions.emplace_back(100.0 * std::sin(a), 100.0 * (1.0 - std::cos(a)), 0.0);
    Matrix3 t;
    t.col(2) = Vector3(std::cos(a), std::sin(a), 0.0);
    t.col(1) = Vector3::UnitZ();
    t.col(0) = t.col(1).cross(t.col(2));
    triads.push_back(t);
  }
  std::vector<CorotationalElement> chain;
  for (std::size_t e = 0; e < static_cast<std::size_t>(elements); ++e) {
    const Matrix3 triad = elementTriad(positions[e], positions[e + 1], triads[e], triads[e + 1]);
    const double length = (positions[e + 1] - positions[e]).norm();
    chain.emplace_back(stiffness(s, length), length, triad, triads[e], triads[e + 1]);
  }
  FrameProblem problem(positions, triads, chain, 600.0, 60000.0);
  ASSERT_TRUE(loadUp(problem, {0.0, 0.0, 600.0}, Vector3::Zero(), 6, 1e-8));
  // the curve starts along X and bends towards Y; the published axes give (bend, along, out of
  // plane)
  EXPECT_NEAR(problem.tip().x() / 47.23, 1.0, 0.015);
  EXPECT_NEAR(problem.tip().y() / 15.79, 1.0, 0.015);
  EXPECT_NEAR(problem.tip().z() / 53.37, 1.0, 0.015);
  RecordProperty("tip", std::to_string(problem.tip().x()) + " " +
                            std::to_string(problem.tip().y()) + " " +
                            std::to_string(problem.tip().z()));
}

}  // namespace LargeDisplacementTest
}  // namespace tooljoint::beam
