// SPDX-License-Identifier: BSD-3-Clause
// Products by rows are those of dense matrices.
#include "reduction/project/FullBasis.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "common/Index.hpp"
#include "linalg/Deterministic.hpp"
#include "linalg/SparseProducts.hpp"

namespace tooljoint::reduction {
namespace FullBasisTest {

/// Full rows, and some with one entry, as of boundary dofs; more rows than in a block.
struct Basis {
  static constexpr int rows = 2600, columns = 11;
  Basis() : dense(linalg::scatteredNumbers(rows, columns, 3)) {
    for (int i = 0; i < rows; i += 300) {
      dense.row(i).setZero();
      dense(i, i / 300) = 1.0;
    }
    Phi = dense.sparseView();
    Triplets entries;
    for (int i = 0; i < rows; ++i)
      for (int j : {(i + rows - 40) % rows, i, (i + 1) % rows})
        entries.emplace_back(i, j, 1.0 / (1 + i % 7) - 0.3 * (j % 3));  // unsymmetric
    A = sparse(rows, rows, entries);
  }
  Matrix dense;
  Sparse Phi, A;
};

TEST(FullBasis, ProductsAreThoseOfDenseMatrices) {
  const Basis b;
  ASSERT_TRUE(isLargeAndFull(b.Phi));
  EXPECT_FALSE(isLargeAndFull(b.A));
  const Matrix A = b.A;
  const auto near = [](const Matrix& found, const Matrix& exact) {
    EXPECT_LT((found - exact).cwiseAbs().maxCoeff(), 1e-12 * exact.cwiseAbs().maxCoeff());
  };
  near(projectByRows(b.A, b.Phi), b.dense.transpose() * A * b.dense);
  near(gramByRows(b.Phi), b.dense.transpose() * b.dense);
  const Matrix q = linalg::scatteredNumbers(Basis::columns, 3, 5);
  near(timesByRows(b.Phi, q), b.dense * q);
  const Matrix absolute = b.dense.cwiseAbs();
  near(absoluteEnergiesByRows(b.A, b.Phi),
       absolute.cwiseProduct(A.cwiseAbs() * absolute).colwise().sum().transpose());
}

TEST(SparseProducts, AnyNumberOfColumnsIsThatOfDenseMatrices) {
  const Basis b;
  const Matrix A = b.A;
  for (int columns : {1, 3, 4, 5, 8, 11}) {
    const Matrix X = b.dense.leftCols(columns), exact = A * X;
    EXPECT_LT((linalg::product(b.A, X) - exact).cwiseAbs().maxCoeff(), 1e-13);
    EXPECT_LT((linalg::absoluteProduct(b.A, X) - A.cwiseAbs() * X.cwiseAbs()).cwiseAbs().maxCoeff(),
              1e-13);
    Matrix B = exact;
    B(17, columns - 1) += 1e-6;
    const auto left = linalg::residualOf(b.A, X, B);
    EXPECT_LT((left.values - (B - exact)).cwiseAbs().maxCoeff(), 1e-13);
    const double size =
        A.row(17).cwiseAbs().dot(X.col(columns - 1).cwiseAbs()) + std::abs(B(17, columns - 1));
    EXPECT_NEAR(left.backwardError, 1e-6 / size, 1e-9 / size);
    B(3, 0) = std::nan("");
    EXPECT_TRUE(std::isinf(linalg::residualOf(b.A, X, B).backwardError));
  }
}

}  // namespace FullBasisTest
}  // namespace tooljoint::reduction
