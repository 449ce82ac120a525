// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Keep static against least squares.
#include "reduction/vectors/InitialState.hpp"

#include <Teuchos_ParameterList.hpp>
#include <cmath>
#include <gtest/gtest.h>

#include "linalg/trilinos/DirectSolver.hpp"
#include "reduction/Reduce.hpp"
#include "tests/support/BasisFamilies.hpp"

namespace InitialStateTest {

using namespace tooljoint;
using namespace tooljoint::reduction;

Basis basisOf(const model::Substructure& part, int modes,
              const std::string& method = "Craig-Bampton") {
  return makeBasis(method, Teuchos::ParameterList())->build(part, samples::modes(modes));
}

ReductionOptions with(InitialState state) {
  ReductionOptions options;
  options.initialState = state;
  return options;
}

/// A clamped bar under its own weight, at rest in its static state, with cubic springs (without
/// force there) at two nodes.
model::Substructure hangingBar() {
  auto part = samples::bar("hanging", 0, 12, 3.0, 2.0, {0});
  auto& m = part.model;
  const int n = m.size();
  m.loads.push_back({"weight", m.mass * Vector::Ones(n), 0});
  part.reference = linalg::DirectSolver(m.stiffness[0].matrix).solve(m.loads[0].vector);
  m.initialDisplacement = part.reference;
  samples::classify(part, {}, {12});
  return part;
}

TEST(FitState, ZeroStaysExactlyZero) {
  const auto part = hangingBar();
  EXPECT_EQ(fitState(basisOf(part, 4), Vector::Zero(12)).norm(), 0.0);
}

TEST(FitState, IsTheLeastSquaresSolution) {
  const auto part = hangingBar();
  const Basis basis = basisOf(part, 4);
  const Vector x = Vector::LinSpaced(12, 1, 3).array().square();
  const Vector q = fitState(basis, x);
  EXPECT_EQ(q[0], x[11]) << "q_C = D_C";
  const Vector rest = x - basis.vectors * q;
  const Matrix modal = Matrix(basis.vectors).rightCols(4);
  EXPECT_LT((modal.transpose() * rest).norm(), 1e-12) << "normal equations (39)";
  const Vector inside = basis.vectors * q;
  EXPECT_LT((fitState(basis, inside) - q).norm(), 1e-12)
      << "a state inside the basis is met exactly";
}

/// The bar with the mass of its dofs growing tenfold along it and the third dof in other units.
model::Substructure unevenBar(double unit) {
  auto part = hangingBar();
  const int n = part.model.size();
  Vector scale(n);
  for (int i = 0; i < n; ++i) scale[i] = (i == 2 ? unit : 1.0);
  const Vector root =
      Vector::LinSpaced(n, 0, 1).unaryExpr([](double s) { return std::pow(10.0, 0.5 * s); });
  const auto scaled = [&](const Sparse& A, const Vector& by) {
    return Sparse(by.asDiagonal() * A * by.asDiagonal());
  };
  part.model.mass = scaled(part.model.mass, root.cwiseProduct(scale));
  auto& K = part.model.stiffness.own().front().matrix;
  K = scaled(K, scale);
  return part;
}

TEST(FitState, LosesTheLeastKineticEnergy) {
  const auto part = unevenBar(1.0);
  const Sparse& M = part.model.mass;
  const Basis basis = basisOf(part, 4);
  const Vector x = Vector::LinSpaced(12, 1, 3).array().square();
  const Vector q = fitState(basis, M, x);
  EXPECT_EQ(q[0], x[11]) << "q_C = D_C";
  const Vector rest = x - basis.vectors * q;
  const Matrix modal = Matrix(basis.vectors).rightCols(4);
  EXPECT_LT((modal.transpose() * M * rest).norm(), 1e-11) << "normal equations";
  const auto lost = [&](const Vector& state) {
    const Vector e = x - basis.vectors * state;
    return e.dot(M * e);
  };
  EXPECT_LT(lost(q), 0.95 * lost(fitState(basis, x)));
  for (int k = 1; k < 5; ++k)
    for (const double step : {-1e-3, 1e-3}) {
      Vector other = q;
      other[k] += step;
      EXPECT_GT(lost(other), lost(q)) << k;
    }
}

TEST(FitState, DoesNotDependOnTheUnitsOfADof) {
  const Vector x = Vector::LinSpaced(12, 1, 3).array().square();
  const auto motion = [&](double unit) {
    const auto part = unevenBar(unit);
    const Basis basis = basisOf(part, 4);
    Vector inUnits = x;
    inUnits[2] /= unit;
    Vector fitted = basis.vectors * fitState(basis, part.model.mass, inUnits);
    fitted[2] *= unit;
    return fitted;
  };
  EXPECT_LT((motion(1e3) - motion(1.0)).norm(), 1e-9);
}

TEST(FitState, ReachesVectorsWithoutMass) {
  auto part = hangingBar();
  const Basis basis = basisOf(part, 4);
  part.model.mass *= 0.0;
  const Vector x = Vector::LinSpaced(12, 1, 3).array().square();
  EXPECT_EQ(fitState(basis, part.model.mass, x), fitState(basis, x));
}

// The interface forces are coordinates after the modes: a motion of the modes has none.
TEST(FitState, LeavesInterfaceForcesZero) {
  auto part = samples::bar("free", 1, 8, 3.0, 2.0);
  samples::classify(part, {1, 9});
  const Basis basis = basisOf(part, 3, "Dual Craig-Bampton");
  ASSERT_EQ(basis.forces(), 2);
  Vector expected = Vector::Zero(5);
  expected.head(3) << 0.5, -2, 1;
  EXPECT_LT((fitState(basis, basis.vectors * expected) - expected).norm(), 1e-12);
}

TEST(KeepStatic, StartsAtRestInTheStaticState) {
  const auto part = hangingBar();
  const auto cb = reduce(part, basisOf(part, 2), with(InitialState::KeepStatic), 0);
  EXPECT_EQ(cb.model.initialDisplacement.norm(), 0.0);
  EXPECT_EQ(cb.report.startMisfit, 0.0);
  const Vector force = cb.model.loadAt(0) - cb.model.stiffnessAt(0) * cb.model.initialDisplacement;
  EXPECT_LT(force.norm(), 1e-11) << "F - K D_s vanishes also in the basis";
  ASSERT_EQ(cb.model.loads.size(), 2u);
  EXPECT_EQ(cb.model.loads[1].name, "reference state");
  EXPECT_LT((cb.model.recoveryOffset - part.reference).norm(), 1e-15);
}

TEST(LeastSquares, ProjectsTheStaticState) {
  const auto part = hangingBar();
  const auto cb = reduce(part, basisOf(part, 2), with(InitialState::LeastSquares), 0);
  EXPECT_EQ(cb.offset.norm(), 0.0);
  EXPECT_EQ(cb.model.loads.size(), 1u);
  EXPECT_EQ(cb.model.initialDisplacement[0], part.reference[11]);
  EXPECT_GT(cb.report.startMisfit, 1e-4 * cb.report.startEnergy);
  const auto more = reduce(part, basisOf(part, 8), with(InitialState::LeastSquares), 0);
  EXPECT_LT(more.report.startMisfit, 0.1 * cb.report.startMisfit);
  const auto all = reduce(part, basisOf(part, 11), with(InitialState::LeastSquares), 0);
  EXPECT_LT(all.report.startMisfit, 1e-13 * all.report.startEnergy);
}

TEST(KeepStatic, MeasuresPointsFromTheSameOrigin) {
  auto part = samples::loopFrame(4, true)[2];
  samples::addCubicSprings(part, {301, 302});
  part.reference = 1e-3 * Vector::LinSpaced(part.model.size(), -1, 2);
  part.model.initialDisplacement = part.reference;
  const auto basis = basisOf(part, 100);
  for (const auto state : {InitialState::KeepStatic, InitialState::LeastSquares}) {
    const auto cb = reduce(part, basis, with(state), 0);
    const Vector d =
        cb.model.points[0].offset + cb.model.points[0].rows * cb.model.initialDisplacement;
    const Vector expected = part.model.points[0].rows * part.reference;
    EXPECT_LT((d - expected).norm(), 1e-13);
  }
}

TEST(KeepStatic, StiffnessThatVariesInTimePullsTowardsZeroNotTowardsTheReference) {
  auto part = samples::loopFrame(4, true)[2];
  part.reference = Vector::Ones(part.model.size());
  part.model.initialDisplacement = part.reference;
  const auto cb = reduce(part, basisOf(part, 100), with(InitialState::KeepStatic), 0);
  ASSERT_EQ(cb.model.loads.size(), 2u);
  EXPECT_EQ(cb.model.loads[1].name, "reference state: gyroscopic rate");
  EXPECT_EQ(cb.model.laws[static_cast<std::size_t>(cb.model.loads[1].law)].name, "dOmega/dt");
}

TEST(InitialVelocity, IsProjectedLikeTheDisplacement) {
  auto part = hangingBar();
  const Basis basis = basisOf(part, 3);
  Vector q = Vector::LinSpaced(4, 1, 4);
  part.model.initialVelocity = basis.vectors * q;
  EXPECT_LT(
      (reduce(part, basis, with(InitialState::KeepStatic), 0).model.initialVelocity - q).norm(),
      1e-12);
}

}  // namespace InitialStateTest
