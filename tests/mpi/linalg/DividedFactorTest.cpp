// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Factors of a solid that MUMPS divides among the ranks, against those of one rank.
#include <gtest/gtest.h>
#include <string>

#include "common/Error.hpp"
#include "common/Parallel.hpp"
#include "coupling/CoupledModes.hpp"
#include "estimate/ResidualFlexibility.hpp"
#include "linalg/Deterministic.hpp"
#include "linalg/factor/MumpsFactor.hpp"
#include "linalg/trilinos/DirectSolver.hpp"
#include "linalg/trilinos/EigenChecks.hpp"
#include "linalg/trilinos/EigenSolver.hpp"
#include "reduction/Reduce.hpp"
#include "tests/support/SolidBlock.hpp"

namespace DividedFactorTest {

using namespace tooljoint;
using linalg::DirectSolver;
using parallel::Ranks;

linalg::DirectSolverOptions together() {
  linalg::DirectSolverOptions options;
  options.ranks = Ranks::All;
  return options;
}

/// Largest difference between this rank's numbers and those of rank 0.
double spread(const Matrix& mine) {
  Matrix root = mine;
  parallel::broadcast(root, 0);
  return parallel::maximum((root - mine).cwiseAbs().maxCoeff());
}

struct Pencil {
  Sparse K, M;
  explicit Pencil(bool free = false) {
    const auto block = samples::solidBlock(12, 8, 8, free);  // 2916 dofs, or 3159
    K = coupling::undampedStiffness(block.model);
    M = reduction::symmetricPart(block.model.mass);
  }
};

TEST(DividedFactor, SolvesAsOneRankDoesAndAlikeOnAll) {
  const Pencil block;
  const Matrix b = linalg::scatteredNumbers(block.K.rows(), 70, 3);
  const DirectSolver alone(block.K), divided(block.K, {}, together());
  const Matrix x = divided.solve(b);
  EXPECT_LT(linalg::backwardError(block.K, x, b), 1e-13);
  EXPECT_EQ(spread(x), 0.0);
  const Matrix own = alone.solve(b);
  EXPECT_LT((x - own).cwiseAbs().maxCoeff(), 1e-9 * own.cwiseAbs().maxCoeff());
  EXPECT_EQ(divided.negativeEigenvalues(), 0);
}

TEST(DividedFactor, CountsEigenvaluesAsOneRankDoes) {
  const Pencil block;
  const Vector values = linalg::lowestModes(block.K, block.M, 12).values;
  int counted = 0;
  for (int below = 1; below < values.size(); ++below) {
    if (values[below] - values[below - 1] < 1e-3 * values[below]) continue;  // equal bending modes
    const double bound = 0.5 * (values[below - 1] + values[below]);
    EXPECT_EQ(linalg::negativeEigenvalues(Sparse(block.K - bound * block.M), Ranks::All), below);
    ++counted;
  }
  EXPECT_GE(counted, 5);
}

TEST(DividedFactor, GivesTheFlexibilityOutsideABasis) {
  const auto block = samples::solidBlock(12, 8, 8);
  const Sparse K = coupling::undampedStiffness(block.model);
  reduction::ReductionOptions options;
  options.modes.kind = reduction::ModeRule::Kind::PerPart;
  options.modes.counts = {6};
  const auto reduced = reduction::reduceAll(
      {block}, *reduction::makeBasis("Craig-Bampton", Teuchos::ParameterList()), options);
  const auto& basis = *reduced.front().basis;
  const estimate::ResidualFlexibility alone(block, basis, K), divided(block, basis, K, Ranks::All);
  const Matrix r = linalg::scatteredNumbers(K.rows(), 4, 5);
  const Matrix own = alone.apply(r), x = divided.apply(r);
  EXPECT_LT((x - own).cwiseAbs().maxCoeff(), 1e-9 * own.cwiseAbs().maxCoeff());
  EXPECT_EQ(spread(x), 0.0);
}

/// The same message on every rank, and no rank waits.
TEST(DividedFactor, RefusesAlikeOnAllRanks) {
  const Pencil free(true);
  std::string refusal;
  try {
    const DirectSolver floating(free.K, {}, together());
  } catch (const ModelError& error) {
    refusal = error.what();
  }
  EXPECT_NE(refusal.find("nothing resists a motion"), std::string::npos) << refusal;
  std::string first = refusal;
  parallel::broadcast(first, 0);
  EXPECT_EQ(refusal, first);
  linalg::MumpsFactor small(parallel::rank() == 0 ? 1 : 1000, Ranks::All);
  EXPECT_THROW(small.factor(Pencil().K, linalg::MumpsFactor::Symmetry::Definite), ModelError);
}

}  // namespace DividedFactorTest
