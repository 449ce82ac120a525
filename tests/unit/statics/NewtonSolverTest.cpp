// SPDX-License-Identifier: BSD-3-Clause
#include "statics/NewtonSolver.hpp"

#include <Teuchos_ParameterList.hpp>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include "Problems.hpp"
#include "common/Constants.hpp"
#include "common/Error.hpp"

namespace tooljoint::statics {
namespace NewtonSolverTest {

using testing::ContactChain;
using testing::DenseProblem;
using testing::FrictionChain;
using testing::rosenbrock;
using testing::StringInHole;

NewtonOptions with(NewtonOptions::LineSearch search) {
  NewtonOptions options;
  options.lineSearch = search;
  return options;
}

Vector vector2(double a, double b) {
  Vector v(2);
  v << a, b;
  return v;
}

TEST(NewtonSolver, RosenbrockWithFullStepsAndWithBacktracking) {
  for (const auto search : {NewtonOptions::LimitedStep, NewtonOptions::Backtracking}) {
    const DenseProblem problem = rosenbrock();
    Vector x = vector2(-1.2, 1.0);
    const NewtonReport report = solve(problem, x, with(search));
    EXPECT_TRUE(report.converged) << report.message;
    EXPECT_NEAR(x[0], 1.0, 1e-12);
    EXPECT_NEAR(x[1], 1.0, 1e-12);
    EXPECT_EQ(static_cast<int>(report.history.size()), report.iterations + 1);
    EXPECT_DOUBLE_EQ(report.history.front(), 4.4);
    EXPECT_DOUBLE_EQ(report.history.back(), report.residual);
    EXPECT_EQ(report.factorisations, report.iterations);
    if (search == NewtonOptions::LimitedStep) {
      EXPECT_LE(report.iterations, 3);
      EXPECT_GT(report.history[1], report.history[0]);  // full steps may climb,
      EXPECT_EQ(report.halvings, 0);
    } else {
      EXPECT_GT(report.halvings, 0);  // backtracking may not
    }
  }
}

TEST(NewtonSolver, ConvergesQuadratically) {
  ContactChain chain(40, 100.0, 2e3);
  Vector x = Vector::Zero(40);
  const NewtonReport report = solve(chain, x, with(NewtonOptions::LimitedStep));
  ASSERT_TRUE(report.converged) << report.message;
  const std::size_t n = report.history.size();
  ASSERT_GT(n, 4U);
  EXPECT_LT(report.history[n - 2], 10.0 * std::pow(report.history[n - 3], 2));
  EXPECT_LT(report.linearResidual, 1e-10);
}

TEST(NewtonSolver, FrictionThatDefeatsFullStepsIsSolvedByBacktracking) {
  FrictionChain chain(30);
  Vector x = Vector::Ones(30);
  const NewtonReport full = solve(chain, x, with(NewtonOptions::LimitedStep));
  EXPECT_FALSE(full.converged);
  EXPECT_EQ(full.iterations, 50);
  EXPECT_NE(full.message.find("50 Newton iterations were not enough"), std::string::npos)
      << full.message;
  EXPECT_NE(full.message.find("node"), std::string::npos) << full.message;
  x.setOnes();
  const NewtonReport backtracked = solve(chain, x, with(NewtonOptions::Backtracking));
  EXPECT_TRUE(backtracked.converged) << backtracked.message;
  Vector r;
  chain.residual(x, r);
  EXPECT_LT(r.cwiseAbs().maxCoeff(), 1e-8 * chain.load);
  // in the middle, friction alone holds the load: atan(x/width) = pi/2 load/friction
  EXPECT_NEAR(x[15], chain.width * std::tan(constants::pi / 2 * chain.load / chain.friction), 1e-8);
}

/// A string in a hole of stiff, sharp walls, from 1 mm off the axis; 200 iterations allowed.
NewtonReport settle(StringInHole& string, NewtonOptions::LineSearch search) {
  Vector x(string.size());
  for (int i = 0; i < string.n; ++i)
    x.segment<2>(2 * i) =
        1e-3 * vector2(std::cos(4.0 * i / string.n), std::sin(4.0 * i / string.n));
  NewtonOptions options = with(search);
  options.maxIterations = 200;
  const NewtonReport report = solve(string, x, options);
  Vector r;
  string.residual(x, r);
  EXPECT_EQ(report.converged, r.cwiseAbs().maxCoeff() <= 1e-8 * string.load);
  return report;
}

TEST(NewtonSolver, AStiffSharpWallDefeatsStepsAsTheyAreAndResidualsButNotTheWorkOfTheStep) {
  StringInHole string(300);
  string.slides = false;
  EXPECT_FALSE(settle(string, NewtonOptions::LimitedStep).converged);
  EXPECT_FALSE(settle(string, NewtonOptions::Backtracking).converged);
  const NewtonReport report = settle(string, NewtonOptions::CriticalPoint);
  EXPECT_TRUE(report.converged) << report.message;
}

TEST(NewtonSolver, StepsAlongACurvedWallDoNotPressIntoIt) {
  StringInHole tangent(300), slides(300);
  tangent.slides = false;
  const NewtonReport full = settle(slides, NewtonOptions::LimitedStep);  // no convergence along the
                                                                         // tangent
  EXPECT_TRUE(full.converged) << full.message;
  EXPECT_LT(3 * settle(slides, NewtonOptions::CriticalPoint).iterations,
            2 * settle(tangent, NewtonOptions::CriticalPoint).iterations);
}

TEST(NewtonSolver, AResidualThatIsNotFiniteStopsTheStepBeforeIt) {
  DenseProblem logarithm(
      1, [](const Vector& y) -> Vector { return Vector::Constant(1, std::log(y[0])); },
      [](const Vector& y) -> Matrix { return Matrix::Constant(1, 1, 1.0 / y[0]); });
  Vector y = Vector::Constant(1, 5.0);  // a full step leads to a negative number
  const NewtonReport report = solve(logarithm, y, with(NewtonOptions::CriticalPoint));
  EXPECT_TRUE(report.converged) << report.message;
  EXPECT_NEAR(y[0], 1.0, 1e-12);
}

TEST(NewtonSolver, AToleranceBelowRoundingIsToldSo) {
  DenseProblem stiff(
      1, [](const Vector& x) -> Vector { return Vector::Constant(1, 1e12 * (x[0] * x[0] - 2.0)); },
      [](const Vector& x) -> Matrix { return Matrix::Constant(1, 1, 2e12 * x[0]); });
  Vector x = Vector::Ones(1);
  const NewtonReport report = solve(stiff, x);
  EXPECT_FALSE(report.converged);
  EXPECT_NE(report.message.find(
                "Rounding to double precision may leave 3.6e-03: set no smaller tolerance."),
            std::string::npos)
      << report.message;
  NewtonOptions attainable;
  attainable.tolerance = 3.6e-3;
  EXPECT_TRUE(solve(stiff, x, attainable).converged);
}

/// Less than a millionth, at which iterations end because of rounding.
TEST(NewtonSolver, StopsWhereRoundingKeepsTheResidual) {
  DenseProblem stiff(
      1, [](const Vector& x) -> Vector { return Vector::Constant(1, 1e8 * (x[0] * x[0] - 2.0)); },
      [](const Vector& x) -> Matrix { return Matrix::Constant(1, 1, 2e8 * x[0]); });
  Vector x = Vector::Ones(1);
  NewtonOptions options;
  options.tolerance = 1e-12;
  options.maxIterations = 100;
  const NewtonReport report = solve(stiff, x, options);
  EXPECT_TRUE(report.converged) << report.message;
  EXPECT_LT(report.iterations, 15);
  EXPECT_GT(report.residual, options.tolerance);
  EXPECT_LE(report.residual, report.rounding);
  EXPECT_NEAR(x[0], std::sqrt(2.0), 1e-15);
  EXPECT_NE(report.message.find("which rounding leaves"), std::string::npos) << report.message;
}

TEST(NewtonSolver, RowsOfVeryDifferentSizeAreMeasuredByTheScaleOfTheProblem) {
  const auto weighted = [](double a, double b) {
    DenseProblem plain = rosenbrock();
    const Vector rows = vector2(a, b);
    DenseProblem problem(
        2, [=](const Vector& x) -> Vector { return rows.cwiseProduct(plain.r(x)); },
        [=](const Vector& x) -> Matrix { return rows.asDiagonal() * plain.J(x); });
    problem.weight = rows.cwiseInverse();
    return problem;
  };
  Vector x = vector2(-1.2, 1.0), y = x;
  const NewtonReport plain = solve(weighted(1.0, 1.0), x), wild = solve(weighted(1e9, 1e-7), y);
  EXPECT_TRUE(wild.converged) << wild.message;
  EXPECT_EQ(plain.iterations, wild.iterations);
  ASSERT_EQ(plain.history.size(), wild.history.size());
  for (std::size_t i = 0; i < plain.history.size(); ++i)
    EXPECT_NEAR(plain.history[i], wild.history[i], 1e-9 * plain.history[0]);
  // the tolerance applies to the scaled residual: with weights that make every row tiny the start
  // counts as solved
  DenseProblem unweighted = weighted(1e-12, 1e-12);
  unweighted.weight.setOnes();
  Vector z = vector2(-1.2, 1.0);
  EXPECT_LT(solve(unweighted, z).history.front(), 1e-10);
}

TEST(NewtonSolver, BothTestsMustHold) {
  // x^3 = 0: the residual is small long before the steps are
  DenseProblem cube(
      1, [](const Vector& x) -> Vector { return Vector::Constant(1, std::pow(x[0], 3)); },
      [](const Vector& x) -> Matrix { return Matrix::Constant(1, 1, 3.0 * x[0] * x[0]); });
  Vector x = Vector::Ones(1);
  NewtonOptions loose;
  loose.tolerance = 1e-3;
  loose.updateTolerance = 1.0;
  EXPECT_TRUE(solve(cube, x, loose).converged);
  x.setOnes();
  loose.updateTolerance = 1e-8;  // the relative step stays at one half
  loose.maxIterations = 12;
  EXPECT_FALSE(solve(cube, x, loose).converged);
}

TEST(NewtonSolver, AStartThatSolvesTheProblemIsLeftAlone) {
  const DenseProblem problem = rosenbrock();
  Vector x = vector2(1.0, 1.0);
  const NewtonReport report = solve(problem, x);
  EXPECT_TRUE(report.converged);
  EXPECT_EQ(report.iterations, 0);
  EXPECT_TRUE(x == vector2(1.0, 1.0));
}

TEST(NewtonSolver, TheStepLimitCapsTheStep) {
  for (const auto search : {NewtonOptions::LimitedStep, NewtonOptions::Backtracking}) {
    double farthest = 0.0;
    DenseProblem line(
        1,
        [&](const Vector& x) -> Vector {
          farthest = std::max(farthest, std::abs(x[0]));
          return Vector::Constant(1, x[0] - 10.0);
        },
        [](const Vector&) -> Matrix { return Matrix::Identity(1, 1); });
    line.cap = 2.5;
    Vector x = Vector::Zero(1);
    const NewtonReport report = solve(line, x, with(search));
    EXPECT_TRUE(report.converged);
    EXPECT_NEAR(x[0], 10.0, 1e-12);
    EXPECT_GE(report.iterations, 4);
    EXPECT_NEAR(report.history[1], 7.5, 1e-12);
    EXPECT_EQ(report.halvings, 0);
  }
}

TEST(NewtonSolver, ASingularJacobianIsReportedByName) {
  DenseProblem plane(
      2,
      [](const Vector& x) -> Vector {
        return vector2(x[0] + x[1] - 1.0, 2.0 * (x[0] + x[1]) - 3.0);
      },
      [](const Vector&) -> Matrix {
        Matrix J(2, 2);
        J << 1.0, 1.0, 2.0, 2.0;
        return J;
      });
  Vector x = Vector::Zero(2);
  const NewtonReport report = solve(plane, x);
  EXPECT_FALSE(report.converged);
  EXPECT_NE(report.message.find("singular"), std::string::npos) << report.message;
  EXPECT_NE(report.message.find("x1"), std::string::npos) << report.message;
  EXPECT_TRUE(x == Vector::Zero(2));
}

TEST(NewtonSolver, ResidualsThatAreNotFiniteAreReportedByName) {
  DenseProblem root(
      2, [](const Vector& x) -> Vector { return vector2(x[0], std::sqrt(x[1] - 5.0)); },
      [](const Vector&) -> Matrix { return Matrix::Identity(2, 2); });
  Vector x = Vector::Zero(2);
  const NewtonReport atStart = solve(root, x);
  EXPECT_FALSE(atStart.converged);
  EXPECT_NE(atStart.message.find("not finite at x2"), std::string::npos) << atStart.message;

  DenseProblem logarithm(
      1, [](const Vector& y) -> Vector { return Vector::Constant(1, std::log(y[0])); },
      [](const Vector& y) -> Matrix { return Matrix::Constant(1, 1, 1.0 / y[0]); });
  Vector y = Vector::Constant(1, 5.0);  // a full step leads to a negative number
  const NewtonReport later = solve(logarithm, y, with(NewtonOptions::LimitedStep));
  EXPECT_FALSE(later.converged);
  EXPECT_NE(later.message.find("not finite"), std::string::npos) << later.message;
  y.setConstant(5.0);
  EXPECT_TRUE(solve(logarithm, y, with(NewtonOptions::Backtracking)).converged);
  EXPECT_NEAR(y[0], 1.0, 1e-12);

  DenseProblem badJacobian(
      1, [](const Vector& z) -> Vector { return z - Vector::Ones(1); },
      [](const Vector&) -> Matrix {
        return Matrix::Constant(1, 1, std::numeric_limits<double>::quiet_NaN());
      });
  Vector z = Vector::Zero(1);
  const NewtonReport bad = solve(badJacobian, z);
  EXPECT_FALSE(bad.converged);
  EXPECT_NE(bad.message.find("not finite"), std::string::npos) << bad.message;
}

TEST(NewtonSolver, AProblemWithoutSolutionIsReported) {
  DenseProblem parabola(
      1, [](const Vector& x) -> Vector { return Vector::Constant(1, x[0] * x[0] + 1.0); },
      [](const Vector& x) -> Matrix { return Matrix::Constant(1, 1, 2.0 * x[0]); });
  Vector x = Vector::Constant(1, 3.0);
  const NewtonReport report = solve(parabola, x);
  EXPECT_FALSE(report.converged);
  EXPECT_GE(report.residual, 1.0);
  EXPECT_FALSE(report.message.empty());

  // a Jacobian of the wrong sign: no step along the direction helps
  DenseProblem wrong(
      1, [](const Vector& y) -> Vector { return y - Vector::Constant(1, 4.0); },
      [](const Vector&) -> Matrix { return Matrix::Constant(1, 1, -1.0); });
  Vector y = Vector::Zero(1);
  const NewtonReport stuck = solve(wrong, y);
  EXPECT_FALSE(stuck.converged);
  EXPECT_NE(stuck.message.find("no step along the Newton direction"), std::string::npos)
      << stuck.message;
}

TEST(NewtonSolver, ErrorsOfTheProblemPassThrough) {
  int calls = 0;
  DenseProblem interrupted(
      1,
      [&](const Vector& x) -> Vector {
        if (++calls > 3) throw InterruptedError("stop");
        return Vector::Constant(1, x[0] * x[0] - 2.0);
      },
      [](const Vector& x) -> Matrix { return Matrix::Constant(1, 1, 2.0 * x[0]); });
  Vector x = Vector::Ones(1);
  EXPECT_THROW(solve(interrupted, x), InterruptedError);
  Vector wrongSize = Vector::Zero(3);
  EXPECT_THROW(solve(interrupted, wrongSize), ModelError);
}

TEST(NewtonSolver, NoxAndBelosListsAreLaidOverOurs) {
  // NOX's own full step replaces our search
  Teuchos::ParameterList nox;
  nox.sublist("Line Search").set("Method", "Full Step");
  const DenseProblem problem = rosenbrock();
  Vector x = vector2(-1.2, 1.0);
  const NewtonReport full = solve(problem, x, {}, &nox);
  EXPECT_TRUE(full.converged);
  EXPECT_LE(full.iterations, 3);
  // another Krylov method
  Teuchos::ParameterList belos;
  belos.set("Solver Type", "BiCGStab");
  ContactChain chain(30, 100.0, 2e3);
  Vector y = Vector::Zero(30);
  const NewtonReport other = solve(chain, y, with(NewtonOptions::LimitedStep), nullptr, &belos);
  EXPECT_TRUE(other.converged) << other.message;
  // unknown parameters are refused
  belos.set("Solver Type", "Gauss");
  EXPECT_THROW(solve(chain, y, {}, nullptr, &belos), ModelError);
  Teuchos::ParameterList unknown;
  unknown.set("Solver Tipe", "Block GMRES");
  EXPECT_THROW(solve(chain, y, {}, nullptr, &unknown), ModelError);
  Teuchos::ParameterList badNox;
  badNox.sublist("Line Search").set("Method", "Guess");
  EXPECT_THROW(solve(chain, y, {}, &badNox), ModelError);
}

}  // namespace NewtonSolverTest
}  // namespace tooljoint::statics
