// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Factors by MUMPS on the grid of springs whose eigenvalues are known, 6 - 2 sum cos(i pi /
/// (n+1)).
#include "linalg/factor/MumpsFactor.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <optional>
#include <string>
#include <sys/resource.h>
#include <unistd.h>
#include <utility>
#include <vector>

#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "common/Index.hpp"
#include "linalg/Deterministic.hpp"
#include "linalg/SparseProducts.hpp"
#include "linalg/factor/FactorMemory.hpp"
#include "linalg/trilinos/DirectSolver.hpp"
#include "linalg/trilinos/EigenChecks.hpp"
#include "linalg/trilinos/EigenSolver.hpp"

namespace MumpsFactorTest {

using namespace tooljoint;
using namespace tooljoint::linalg;
using Symmetry = MumpsFactor::Symmetry;

constexpr int edge = 14;  // 2744 dofs

/// Masses at the points of a cube, coupled to their neighbours and, unless free, to walls; `skew`
/// is the part of the coupling that acts in one direction only.
Sparse grid(bool free = false, double skew = 0.0) {
  Triplets entries;
  const auto number = [](int x, int y, int z) { return x + edge * (y + edge * z); };
  for (int z = 0; z < edge; ++z)
    for (int y = 0; y < edge; ++y)
      for (int x = 0; x < edge; ++x) {
        const int i = number(x, y, z);
        int neighbours = 0;
        for (const auto& [a, b, c] :
             {std::array{1, 0, 0}, std::array{0, 1, 0}, std::array{0, 0, 1}})
          for (const int side : {-1, 1}) {
            const int p = x + side * a, q = y + side * b, r = z + side * c;
            if (std::min({p, q, r}) < 0 || std::max({p, q, r}) >= edge) continue;
            ++neighbours;
            entries.emplace_back(i, number(p, q, r), -1.0 + side * skew);
          }
        entries.emplace_back(i, i, free ? neighbours : 6.0);
      }
  return sparse(edge * edge * edge, edge * edge * edge, entries);
}

/// Three coupled grids: grid x [2 1 1; 1 2 1; 1 1 2], with the eigenvalues of the grid times 4, 1
/// and 1.
Sparse solid(bool free = false) {
  Triplets entries;
  forEachEntry(grid(free), [&](int row, int column, double value) {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        entries.emplace_back(3 * row + i, 3 * column + j, (i == j ? 2 : 1) * value);
  });
  return sparse(3 * edge * edge * edge, 3 * edge * edge * edge, entries);
}

int eigenvaluesOfGridBelow(double bound) {
  int below = 0;
  const auto one = [](int i) { return 2 - 2 * std::cos(i * constants::pi / (edge + 1)); };
  for (int i = 1; i <= edge; ++i)
    for (int j = 1; j <= edge; ++j)
      for (int k = 1; k <= edge; ++k) below += one(i) + one(j) + one(k) < bound;
  return below;
}

Sparse shifted(const Sparse& A, double shift) {
  Sparse one(A.rows(), A.cols());
  one.setIdentity();
  return A - shift * one;
}

TEST(MumpsFactor, solvesWithEverySymmetry) {
  const Matrix b = scatteredNumbers(edge * edge * edge, 100, 3);
  for (const auto& [A, symmetry] :
       {std::pair{grid(), Symmetry::None}, std::pair{grid(false, 0.3), Symmetry::None},
        std::pair{grid(), Symmetry::Definite},
        std::pair{shifted(grid(), 2.0), Symmetry::Indefinite}}) {
    MumpsFactor factor;
    ASSERT_TRUE(factor.factor(A, symmetry));
    EXPECT_LT(backwardError(A, factor.solve(b), b), 1e-11);
    EXPECT_GT(factor.entries(), A.nonZeros());
  }
}

TEST(MumpsFactor, goesOnWithTheOrderingOfOnePattern) {
  MumpsFactor factor;
  const Matrix b = scatteredNumbers(edge * edge * edge, 1, 3);
  for (const double skew : {0.0, 0.1, 0.2}) {
    const Sparse A = grid(false, skew);
    ASSERT_TRUE(factor.factor(A, Symmetry::None));
    EXPECT_LT(backwardError(A, factor.solve(b), b), 1e-12) << skew;
  }
  const Sparse half = shifted(grid(), -1.0);
  ASSERT_TRUE(factor.factor(half, Symmetry::Definite));
  EXPECT_LT(backwardError(half, factor.solve(b), b), 1e-12);
  const Sparse longer = half * half;  // rows
  ASSERT_TRUE(factor.factor(longer, Symmetry::Definite));
  EXPECT_LT(backwardError(longer, factor.solve(b), b), 1e-12) << "another pattern";
}

TEST(MumpsFactor, countsEigenvalues) {
  for (const double bound : {0.05, 0.2, 3.05, 6.05, 11.0}) {
    MumpsFactor factor;
    ASSERT_TRUE(factor.factor(shifted(grid(), bound), Symmetry::Indefinite));
    EXPECT_EQ(factor.negativePivots(), eigenvaluesOfGridBelow(bound)) << bound;
  }
  for (const double bound : {0.3, 3.05}) {
    Sparse one(solid().rows(), solid().rows());
    one.setIdentity();
    EXPECT_EQ(eigenvaluesBelow(solid(), one, bound),
              eigenvaluesOfGridBelow(bound / 4) + 2 * eigenvaluesOfGridBelow(bound))
        << bound;
  }
}

/// The limit of the address space is used if it is below the free memory of the machine.
TEST(FactorMemory, IsWhatTheLimitOfTheProcessLeaves) {
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_AS, &before), 0);
  if (before.rlim_cur != RLIM_INFINITY) GTEST_SKIP() << "the process has a limit";
  const auto unlimited = freeMegabytes();
  ASSERT_TRUE(unlimited);
  long pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  rlimit limit = before;
  const long left = *unlimited / 4;
  limit.rlim_cur = static_cast<rlim_t>(pages * sysconf(_SC_PAGESIZE) + left * 1024 * 1024);
  ASSERT_EQ(setrlimit(RLIMIT_AS, &limit), 0);
  const auto limited = freeMegabytes();
  ASSERT_EQ(setrlimit(RLIMIT_AS, &before), 0);
  EXPECT_LE(limited.value_or(0), left);
  EXPECT_GE(limited.value_or(0), left - 10);
}

/// The C library keeps freed blocks below one in use.
TEST(FactorMemory, GivesBackWhatWasFreedBefore) {
#if !defined(__GLIBC__) || defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "another allocator";
#endif
  const auto taken = [] {
    long size = 0, resident = 0;
    std::ifstream("/proc/self/statm") >> size >> resident;
    return resident * sysconf(_SC_PAGESIZE) / (1024 * 1024);
  };
  std::vector<std::vector<char>> blocks;
  for (int i = 0; i < 2000; ++i) blocks.emplace_back(100000, 'x');
  const std::vector<char> above(1000, 'x');
  const long before = taken();
  blocks.clear();
  ASSERT_TRUE(freeMegabytes());
  EXPECT_LT(taken(), before - 150) << above.size();
}

TEST(FactorMemory, IsNotSaidToBeFreeWhereItIsEnough) {
  const auto text = [](std::optional<long> available) -> std::string {
    try {
      refuseMemory(1000, 383, available);
    } catch (const MemoryError& error) {
      return error.what();
    }
  };
  EXPECT_NE(text(100).find("need 383 MB of memory, and 100 MB are free."), std::string::npos);
  for (const auto& known : {std::optional<long>(22185), std::optional<long>()})
    EXPECT_NE(text(known).find("need 383 MB of memory, more than there is."), std::string::npos);
}

/// The refusal comes before the factorisation, and its message states the rows and both amounts of
/// memory. A limit equal to the size of the factors is sufficient.
TEST(MumpsFactor, refusesFactorsBeyondTheMemory) {
  const Sparse A = solid();
  const auto refusal = [&](long megabytes) -> std::string {
    MumpsFactor factor(megabytes);
    try {
      factor.factor(A, Symmetry::Definite);
    } catch (const ModelError& error) {
      return error.what();
    }
    return "";
  };
  const std::string text = refusal(1);
  const std::string begin = "The factors of a matrix of 8232 rows need ";
  ASSERT_EQ(text.substr(0, begin.size()), begin);
  EXPECT_NE(text.find(" MB of memory, and 1 MB are free. Cut the part"), std::string::npos) << text;
  const long needed = std::stol(text.substr(begin.size()));
  MumpsFactor enough(needed);
  ASSERT_TRUE(enough.factor(A, Symmetry::Definite));
  EXPECT_GE(8 * enough.entries(), 500000L * needed / 2) << "a quarter of it is the factors";
  EXPECT_LE(8 * enough.entries(), 1048576L * needed) << "and they fit";
  EXPECT_NE(refusal(needed - 1), "");
}

TEST(MumpsFactor, tellsWhatIsDefinite) {
  const double lowest = 6 - 6 * std::cos(constants::pi / (edge + 1));
  EXPECT_TRUE(isDefinite(grid(), 0.99 * lowest / 6));  // of the diagonal, 6
  EXPECT_FALSE(isDefinite(grid(), 1.01 * lowest / 6));
  EXPECT_FALSE(MumpsFactor().factor(shifted(grid(), 1.0), Symmetry::Definite));
}

TEST(MumpsFactor, isForLargeMatricesWithLongRows) {
  EXPECT_TRUE(suitsMumps(solid()));
  Triplets entries;
  for (int i = 0; i < 6000; ++i)  // nodes of six dofs, each joined with the next
    for (int j = std::max(0, i - i % 6 - 6); j < std::min(6000, i - i % 6 + 12); ++j)
      entries.emplace_back(i, j, i == j ? 2.0 : -0.1);
  EXPECT_FALSE(suitsMumps(sparse(6000, 6000, entries)));
  EXPECT_FALSE(suitsMumps(solid().topLeftCorner(100, 100)));
  EXPECT_TRUE(isExactlySymmetric(grid()));
  EXPECT_FALSE(isExactlySymmetric(grid(false, 1e-15)));
}

/// The direct solver of such a matrix: its solution is as accurate, and free motions are named.
TEST(MumpsFactor, standsBehindTheDirectSolver) {
  const Matrix b = scatteredNumbers(solid().rows(), 130, 5);
  const DirectSolver solver(solid());
  EXPECT_LT(backwardError(solid(), solver.solve(b), b), 1e-13);
  EXPECT_LT(solver.lastResidual(), 1e-13);
  EXPECT_EQ(solver.negativeEigenvalues(), 0);
  EXPECT_GT(DirectSolver(shifted(solid(), 0.3)).negativeEigenvalues().value(), 0);
  EXPECT_FALSE(DirectSolver(grid().topLeftCorner(100, 100)).negativeEigenvalues().has_value());
  try {
    const DirectSolver free(solid(true));
    FAIL() << "a free solid was factored";
  } catch (const ModelError& error) {
    EXPECT_NE(std::string(error.what()).find("nothing resists a motion"), std::string::npos)
        << error.what();
  }
}

/// Modes with given factors of K equal those without them; the factors are not used if zero is no
/// suitable shift (not below all eigenvalues).
TEST(MumpsFactor, servesTheModesOfTheSameMatrix) {
  Sparse one(solid().rows(), solid().rows());
  one.setIdentity();
  for (const double shift : {0.0, 0.2}) {
    const Sparse K = shifted(solid(), shift);
    const DirectSolver factors(K);
    const EigenPairs alone = lowestModes(K, one, 6);
    EigenOptions options;
    options.stiffness = &factors;
    const EigenPairs shared = lowestModes(K, one, 6, options);
    EXPECT_LT((shared.values - alone.values).cwiseAbs().maxCoeff(), 1e-10);
    EXPECT_EQ(shared.method.find("shift 0.0e+00,") != std::string::npos, shift == 0.0)
        << shared.method;
  }
}

}  // namespace MumpsFactorTest
