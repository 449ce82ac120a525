// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Blocks, products and factors against dense algebra, on chains, loops, stars, arrows and random
/// graphs.
#include "linalg/blocks/BlockFactor.hpp"

#include <Eigen/LU>
#include <gtest/gtest.h>
#include <random>
#include <set>

#include "linalg/DenseDecompositions.hpp"

namespace tooljoint::linalg {
namespace BlockFactorTest {

using Edges = std::vector<std::pair<int, int>>;

/// A random unsymmetric matrix with blocks of these widths and couplings along the edges, strong on
/// the diagonal; rows and columns differ in size by up to 1e10, as forces and moments do. Dofs of a
/// group are scattered over the numbering.
struct Sample {
  Matrix dense;
  Sparse sparse;
  std::vector<int> group;
  std::vector<int> kind;

  Sample(const std::vector<int>& widths, const Edges& edges, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    for (std::size_t b = 0; b < widths.size(); ++b)
      for (int i = 0; i < widths[b]; ++i) group.push_back(static_cast<int>(b));
    std::shuffle(group.begin(), group.end(), random);
    const int n = static_cast<int>(group.size());
    kind.assign(group.size(), 0);
    const auto coupled = [&](int a, int b) {
      if (a == b) return true;
      for (const auto& [x, y] : edges)
        if ((x == a && y == b) || (x == b && y == a)) return true;
      return false;
    };
    dense = Matrix::Zero(n, n);
    Vector size(n);
    for (int i = 0; i < n; ++i) size[i] = std::pow(10.0, 5 * uniform(random) / 2);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        if (coupled(group[static_cast<std::size_t>(i)], group[static_cast<std::size_t>(j)]))
          dense(i, j) = uniform(random) + (i == j ? 4.0 : 0.0);
    dense = size.asDiagonal() * dense * size.asDiagonal();
    sparse = dense.sparseView();
  }
};

Edges chain(int n) {
  Edges edges;
  for (int i = 0; i + 1 < n; ++i) edges.emplace_back(i, i + 1);
  return edges;
}

Vector inPositions(const BlockPattern& pattern, const Vector& x) {
  Vector y(x.size());
  for (int i = 0; i < x.size(); ++i) y[i] = x[pattern.partition().dof[static_cast<std::size_t>(i)]];
  return y;
}

/// Entries of the inverse on the pattern, rows and columns scaled by the diagonal.
void expectInverse(const BlockPattern& pattern, const double* inverse, const Matrix& dense) {
  const Vector scale = dense.diagonal().cwiseAbs().cwiseSqrt();
  const Matrix scaled =
      scale.cwiseInverse().asDiagonal() * dense * scale.cwiseInverse().asDiagonal();
  const Matrix expected = linalg::inverseOf(scaled);
  const double tolerance = 1e-9 * expected.cwiseAbs().maxCoeff();
  const auto& dof = pattern.partition().dof;
  for (int p = 0; p < pattern.size(); ++p)
    for (int q = 0; q < pattern.size(); ++q) {
      if (pattern.find(pattern.blockOf(p), pattern.blockOf(q)) < 0) continue;
      const int i = dof[static_cast<std::size_t>(p)], j = dof[static_cast<std::size_t>(q)];
      ASSERT_NEAR(inverse[pattern.address(p, q)] * scale[i] * scale[j], expected(i, j), tolerance)
          << i << " " << j;
    }
}

/// Largest backward error of the solution and error of the product.
void expectSolves(const Sample& sample) {
  const BlockPattern pattern(partitionDofs({&sample.sparse}, sample.group, sample.kind),
                             {&sample.sparse});
  const int n = pattern.size();
  BlockValues values(pattern.storage(), 0.0);
  pattern.add(sample.sparse, 1.0, values);
  BlockFactor factor(pattern);
  for (int repeat = 0; repeat < 2;
       ++repeat) {  // data of the first factorisation must not affect the second
    std::copy(values.begin(), values.end(), factor.values());
    ASSERT_EQ(factor.factor(), -1);
  }
  const Vector x = Vector::LinSpaced(n, -1.0, 2.0);
  const Vector b = sample.dense * x;
  Vector solution = inPositions(pattern, b);
  factor.solve(solution.data());
  Vector back(n);
  for (int i = 0; i < n; ++i)
    back[pattern.partition().dof[static_cast<std::size_t>(i)]] = solution[i];
  const Vector residual = (sample.dense * back - b).cwiseAbs();
  const Vector scale = sample.dense.cwiseAbs() * back.cwiseAbs() + b.cwiseAbs();
  EXPECT_LT(residual.cwiseQuotient(scale).maxCoeff(), 1e-11);

  factor.invert(std::vector<char>(static_cast<std::size_t>(pattern.blocks()), 1));
  expectInverse(pattern, factor.inverse(), sample.dense);

  const BlockProduct product(pattern, {&values});
  const Vector in = inPositions(pattern, x);
  Vector y = Vector::Zero(n);
  product.addTo(values.data(), in.data(), y.data());
  const Vector expected = inPositions(pattern, b);
  const Vector size = inPositions(pattern, sample.dense.cwiseAbs() * x.cwiseAbs());
  EXPECT_LT((y - expected).cwiseAbs().cwiseQuotient(size).maxCoeff(), 1e-14);
  EXPECT_FALSE(product.isSymmetric());
  EXPECT_NEAR(product.form(values.data(), in.data()), x.dot(b),
              1e-14 * x.cwiseAbs().dot(sample.dense.cwiseAbs() * x.cwiseAbs()));
}

/// A x and x'A x of a symmetric chain of blocks (optionally with unsymmetric diagonal blocks),
/// whole and in runs, against Eigen's sparse product.
void expectSymmetricProduct(const std::vector<int>& widths, bool skewDiagonal = false) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Triplets triplets;
  std::vector<int> group;
  int before = 0;  // first dof of the block before
  for (std::size_t b = 0; b < widths.size(); ++b) {
    const int first = static_cast<int>(group.size());
    group.resize(group.size() + static_cast<std::size_t>(widths[b]), static_cast<int>(b));
    for (int i = first; i < static_cast<int>(group.size()); ++i)
      for (int j = before; j <= i; ++j) {
        const double value = uniform(random) + (i == j ? 4.0 : 0.0);
        triplets.emplace_back(i, j, value);
        if (i != j) triplets.emplace_back(j, i, skewDiagonal && j >= first ? 0.5 * value : value);
      }
    before = first;
  }
  const auto n = static_cast<Eigen::Index>(group.size());
  Sparse matrix(n, n);
  matrix.setFromTriplets(triplets.begin(), triplets.end());
  const BlockPattern pattern(partitionDofs({&matrix}, group, group), {&matrix});
  BlockValues values(pattern.storage(), 0.0);
  pattern.add(matrix, 1.0, values);
  const BlockProduct product(pattern, {&values});
  ASSERT_NE(product.isSymmetric(), skewDiagonal);
  const Vector x = Vector::LinSpaced(n, -1.0, 2.0);
  const Vector in = inPositions(pattern, x);
  const Vector size = inPositions(pattern, matrix.cwiseAbs() * x.cwiseAbs());
  Vector y = Vector::Zero(n), parts = y;
  product.addTo(values.data(), in.data(), y.data());
  EXPECT_LT((y - inPositions(pattern, matrix * x)).cwiseAbs().cwiseQuotient(size).maxCoeff(),
            1e-14);
  double form = 0;
  for (const BlockRange& run : blockRuns(pattern, 20)) {
    product.addTo(values.data(), in.data(), parts.data(), 1.0, run);
    form += product.form(values.data(), in.data(), run);
  }
  EXPECT_EQ(parts, y);
  const double sum = in.cwiseAbs().dot(size);
  EXPECT_NEAR(form, x.dot(matrix * x), 1e-14 * sum);
  EXPECT_NEAR(product.form(values.data(), in.data()), form, 1e-14 * sum);
  // a small unsymmetric part is detected
  values[pattern.address(pattern.start(1), pattern.start(0))] *= 1 + 1e-9;
  EXPECT_FALSE(BlockProduct(pattern, {&values}).isSymmetric());
}

TEST(BlockProduct, ofSymmetricMatrices) {
  expectSymmetricProduct({6, 6, 6, 6, 6});
  expectSymmetricProduct({2, 6, 9, 6, 3, 14});
  expectSymmetricProduct({2, 6, 9, 6, 3, 14}, true);
}
/// Long enough that blocks below the diagonal are not read.
TEST(BlockProduct, ofLongSymmetricMatrices) {
  expectSymmetricProduct(std::vector<int>(5000, 6));
  expectSymmetricProduct(std::vector<int>(200, 43));
  expectSymmetricProduct(std::vector<int>(5000, 6), true);
}

TEST(BlockFactor, chainOfSixWithHeldEnds) {
  expectSolves(Sample({2, 6, 6, 6, 6, 6, 6, 4}, chain(8), 1));
}
TEST(BlockFactor, chainsOfAnyWidth) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    std::vector<int> widths;
    for (int i = 0; i < 9; ++i) widths.push_back(1 + static_cast<int>(random() % 14));
    expectSolves(Sample(widths, chain(9), seed));
  }
}
TEST(BlockFactor, wideBlocksAcrossSeveralPanels) {
  expectSolves(Sample({6, 61, 6, 30, 6}, chain(5), 3));
}
TEST(BlockFactor, loop) {
  auto edges = chain(9);
  edges.emplace_back(8, 0);
  expectSolves(Sample({3, 6, 6, 2, 9, 6, 6, 1, 5}, edges, 4));
}
TEST(BlockFactor, star) {
  expectSolves(Sample({6, 3, 6, 9, 1, 6}, {{0, 1}, {0, 2}, {0, 3}, {0, 4}, {0, 5}}, 5));
}
TEST(BlockFactor, chainOfInterfacesWithModesBetween) {
  expectSolves(Sample({6, 6, 6, 6, 12, 25, 7},
                      {{0, 1}, {1, 2}, {2, 3}, {4, 0}, {4, 1}, {5, 1}, {5, 2}, {6, 2}, {6, 3}}, 6));
}
TEST(BlockFactor, everythingCoupled) {
  expectSolves(Sample({4, 5, 6}, {{0, 1}, {1, 2}, {0, 2}}, 7));
}
TEST(BlockFactor, grid) {
  Edges edges;
  for (int i = 0; i < 16; ++i) {
    if (i % 4 < 3) edges.emplace_back(i, i + 1);
    if (i < 12) edges.emplace_back(i, i + 4);
  }
  expectSolves(Sample(std::vector<int>(16, 6), edges, 8));
}
TEST(BlockFactor, partsThatDoNotTouch) { expectSolves(Sample({6, 6, 3, 3}, {{0, 1}, {2, 3}}, 9)); }

BlockPattern patternOf(const Sample& sample) {
  return BlockPattern(partitionDofs({&sample.sparse}, sample.group, sample.kind), {&sample.sparse});
}

TEST(BlockFactor, chainsAndStarsFillNothing) {
  EXPECT_EQ(BlockFactor(patternOf(Sample(std::vector<int>(12, 6), chain(12), 1))).fill(), 0u);
  EXPECT_EQ(BlockFactor(
                patternOf(Sample({6, 3, 6, 9, 1, 6}, {{0, 1}, {0, 2}, {0, 3}, {0, 4}, {0, 5}}, 1)))
                .fill(),
            0u);
}

TEST(BlockFactor, modesBetweenNodesFillNothing) {
  const Sample coupled({6, 6, 6, 6, 12, 25, 7},
                       {{0, 1}, {1, 2}, {2, 3}, {4, 0}, {4, 1}, {5, 1}, {5, 2}, {6, 2}, {6, 3}}, 1);
  EXPECT_EQ(BlockFactor(patternOf(coupled)).fill(), 0u);
}

TEST(BlockFactor, workIsLinearInTheLengthOfAChain) {
  const double shorter =
      BlockFactor(patternOf(Sample(std::vector<int>(20, 6), chain(20), 1))).solveWork();
  const double longer =
      BlockFactor(patternOf(Sample(std::vector<int>(40, 6), chain(40), 1))).solveWork();
  EXPECT_NEAR(longer / shorter, 2.0, 0.06);
}

TEST(BlockFactor, invertsWhatIsWanted) {
  const Sample sample({6, 6, 6, 6, 12, 25, 7},
                      {{0, 1}, {1, 2}, {2, 3}, {4, 0}, {4, 1}, {5, 1}, {5, 2}, {6, 2}, {6, 3}}, 6);
  const auto pattern = patternOf(sample);
  BlockValues values(pattern.storage(), 0.0);
  pattern.add(sample.sparse, 1.0, values);
  BlockFactor factor(pattern);
  std::copy(values.begin(), values.end(), factor.values());
  ASSERT_EQ(factor.factor(), -1);
  std::vector<char> wanted(static_cast<std::size_t>(pattern.blocks()), 0);
  wanted[2] = 1;
  factor.invert(wanted);
  const Matrix expected = linalg::inverseOf(sample.dense);
  for (int p = pattern.start(2); p < pattern.start(3); ++p) {
    const int i = pattern.partition().dof[static_cast<std::size_t>(p)];
    EXPECT_NEAR(factor.inverse()[pattern.address(p, p)], expected(i, i),
                1e-9 * std::abs(expected(i, i)));
  }
}

// A force on one block of a stiff chain: the whole solution without a bound; with a bound only the
// values above it.
TEST(BlockFactor, solvesNearAForce) {
  for (const int width : {6, 3, 70}) {
    Sample sample(std::vector<int>(60, width), chain(60), 3);
    for (int i = 0; i < sample.dense.rows(); ++i)
      for (int j = 0; j < sample.dense.cols(); ++j)
        if (sample.dense(i, j) != 0.0)
          sample.dense(i, j) = (i == j ? 1.0 : 0.0) + 0.04 / width * std::sin(i + 3.0 * j);
    sample.sparse = sample.dense.sparseView();
    const auto pattern = patternOf(sample);
    BlockValues values(pattern.storage(), 0.0);
    pattern.add(sample.sparse, 1.0, values);
    BlockFactor factor(pattern);
    std::copy(values.begin(), values.end(), factor.values());
    ASSERT_EQ(factor.factor(), -1);
    const int n = pattern.size(), block = 20;
    const Vector weight = Vector::Ones(n);
    Vector force = Vector::Zero(n);
    force[pattern.start(block) + 1] = 1.0;
    Vector whole = force;
    factor.solve(whole.data());
    for (const double small : {0.0, 1e-9}) {
      std::vector<int> live{block, block};  // duplicates are allowed
      Vector near = force;
      factor.solveNear(near.data(), live, weight.data(), small);
      EXPECT_LE((near - whole).cwiseAbs().maxCoeff(), 4 * small + 1e-15) << width;
      const std::set<int> reached(live.begin(), live.end());
      EXPECT_EQ(reached.size(), live.size());
      for (int b = 0; b < pattern.blocks(); ++b)
        if (reached.count(b) == 0) {
          EXPECT_EQ(near.segment(pattern.start(b), pattern.width(b)).cwiseAbs().maxCoeff(), 0.0);
        }
      EXPECT_EQ(reached.count(block), 1u);
      if (small > 0) {
        EXPECT_LT(live.size(), 20u) << width;
      }
    }
  }
}

TEST(BlockFactor, namesTheSingularPosition) {
  Sample sample({6, 6, 6}, chain(3), 2);
  const int dof = 7;
  sample.dense.row(dof).setZero();
  sample.dense.col(dof).setZero();
  const Sample whole({6, 6, 6}, chain(3), 2);
  const auto pattern = patternOf(whole);
  const Sparse singular = sample.dense.sparseView();
  BlockFactor factor(pattern);
  BlockValues values(pattern.storage(), 0.0);
  pattern.add(singular, 1.0, values);
  std::copy(values.begin(), values.end(), factor.values());
  EXPECT_EQ(factor.factor(), pattern.partition().position[dof]);
}

TEST(BlockFactor, refusesARankDeficientBlock) {
  for (int width : {3, 6, 8, 12, 40}) {
    Sample sample({width, width}, chain(2), 2);
    Matrix a = Matrix::Random(2 * width, width) * Matrix::Random(width, 2 * width);  // rank half
    sample.sparse = a.sparseView();
    const auto pattern = patternOf(sample);
    BlockFactor factor(pattern);
    BlockValues values(pattern.storage(), 0.0);
    pattern.add(sample.sparse, 1.0, values);
    std::copy(values.begin(), values.end(), factor.values());
    EXPECT_GE(factor.factor(), 0) << "blocks of " << width;
  }
}

TEST(BlockFactor, refusesWhatIsNotANumber) {
  Sample sample({6, 6}, chain(2), 2);
  const auto pattern = patternOf(sample);
  BlockFactor factor(pattern);
  for (std::size_t i = 0; i < pattern.storage(); ++i) factor.values()[i] = std::nan("");
  EXPECT_GE(factor.factor(), 0);
}

TEST(Partition, uncoupledFamiliesGetBlocksOfTheirOwn) {
  // Two nodes of three dofs; the third dof of each couples only to the third of the other.
  Matrix a = Matrix::Zero(6, 6);
  for (int i : {0, 1, 3, 4})
    for (int j : {0, 1, 3, 4}) a(i, j) = 1;
  a(2, 2) = a(5, 5) = 2, a(2, 5) = a(5, 2) = -1;
  const Sparse sparse = a.sparseView();
  const auto partition = partitionDofs({&sparse}, {0, 0, 0, 1, 1, 1}, std::vector<int>(6, 0));
  // Both nodes have the same neighbours in each family, so each family is one block.
  EXPECT_EQ(partition.blocks(), 2);
  EXPECT_EQ(partition.dof, (std::vector<int>{0, 1, 3, 4, 2, 5}));
}

TEST(Partition, denseInterfaceIsOneBlockAndModesAnother) {
  const Matrix a = Matrix::Ones(10, 10);
  const Sparse sparse = a.sparseView();
  const auto partition =
      partitionDofs({&sparse}, {0, 0, 1, 1, 2, 2, 3, 3, 3, 3}, {0, 0, 0, 0, 0, 0, 1, 1, 1, 1});
  EXPECT_EQ(partition.start, (std::vector<int>{0, 6, 10}));
}

TEST(BlockProduct, skipsZeroAndKnowsDiagonalBlocks) {
  Matrix a = Matrix::Zero(20, 20);
  a.topLeftCorner(10, 10).setIdentity();  // modal mass
  a.bottomRightCorner(10, 10).setRandom();
  Matrix pattern = Matrix::Ones(20, 20);
  const Sparse sparse = a.sparseView();
  const Sparse full = pattern.sparseView();
  std::vector<int> group(20, 0);
  std::fill(group.begin() + 10, group.end(), 1);
  const BlockPattern blocks(partitionDofs({&full}, group, group), {&full});
  BlockValues values(blocks.storage(), 0.0);
  blocks.add(sparse, 1.0, values);
  const BlockProduct product(blocks, {&values});
  // The product must not read entries that are assumed to be zero: they are set to other values.
  for (int row = 0; row < 2; ++row) values[blocks.offset(blocks.find(row, 1 - row))] = std::nan("");
  values[blocks.offset(blocks.find(0, 0)) + 1] = std::nan("");
  const Vector x = Vector::LinSpaced(20, 1, 3);
  Vector y = Vector::Zero(20);
  product.addTo(values.data(), x.data(), y.data());
  EXPECT_LT((y - a * x).cwiseAbs().maxCoeff(), 1e-13);
  EXPECT_TRUE(BlockProduct(blocks, {}).empty());
}

TEST(BlockProduct, sharesTheListOfBlocksThatAreReadAlike) {
  const Sparse chain = Matrix(Matrix::Ones(6, 6)).sparseView();
  const std::vector<int> group{0, 0, 1, 1, 2, 2};
  const BlockPattern pattern(partitionDofs({&chain}, group, group), {&chain});
  BlockValues values(pattern.storage(), 1.0), diagonal(pattern.storage(), 0.0);
  diagonal[pattern.offset(pattern.find(0, 0))] = 3.0;
  const BlockProduct product(pattern, {&values});
  const BlockProduct alike(pattern, {&values}, &product), other(pattern, {&diagonal}, &product),
      alone(pattern, {&values});
  EXPECT_TRUE(alike.shares(product));
  EXPECT_FALSE(other.shares(product));
  EXPECT_FALSE(alone.shares(product));
  const Vector x = Vector::LinSpaced(6, 1, 6);
  for (const auto& [each, its, sum] :
       {std::make_tuple(&alike, &values, 21.0), std::make_tuple(&other, &diagonal, 3.0)}) {
    Vector y = Vector::Zero(6);
    each->addTo(its->data(), x.data(), y.data());
    EXPECT_EQ(y[0], sum);
  }
}

/// Rows of six beside a block of modes, their own blocks diagonal, with and without symmetry.
TEST(BlockProduct, ofNodesBesideModes) {
  const std::vector<int> widths{6, 12, 6, 6, 3};
  for (const bool symmetric : {true, false}) {
    const int n = 33;
    Matrix a = Matrix::Random(n, n);
    if (symmetric) a = (a + a.transpose()).eval();
    std::vector<int> group;
    for (int b = 0; b < 5; ++b)
      group.insert(group.end(), static_cast<std::size_t>(widths[static_cast<std::size_t>(b)]), b);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const int far =
            std::abs(group[static_cast<std::size_t>(i)] - group[static_cast<std::size_t>(j)]);
        if (far > 1 || (far == 0 && i != j &&
                        widths[static_cast<std::size_t>(group[static_cast<std::size_t>(i)])] == 6))
          a(i, j) = 0;
      }
    const Sparse sparse = a.sparseView();
    const BlockPattern pattern(partitionDofs({&sparse}, group, group), {&sparse});
    ASSERT_EQ(pattern.blocks(), 5);
    BlockValues values(pattern.storage(), 0.0);
    pattern.add(sparse, 1.0, values);
    const BlockProduct product(pattern, {&values});
    EXPECT_EQ(product.isSymmetric(), symmetric);
    const Vector x = Vector::LinSpaced(n, -1, 2), in = inPositions(pattern, x);
    Vector y = Vector::Zero(n);
    product.addTo(values.data(), in.data(), y.data(), -2.0);
    EXPECT_LT((y + 2.0 * inPositions(pattern, a * x)).cwiseAbs().maxCoeff(), 1e-13);
    EXPECT_NEAR(product.form(values.data(), in.data()), x.dot(a * x), 1e-12);
  }
}

}  // namespace BlockFactorTest
}  // namespace tooljoint::linalg
