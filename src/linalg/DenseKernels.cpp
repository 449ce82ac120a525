// SPDX-License-Identifier: BSD-3-Clause
#include "linalg/DenseKernels.hpp"

#include <Eigen/Core>
#include <Teuchos_BLAS.hpp>
#include <Teuchos_LAPACK.hpp>
#include <limits>
#include <utility>

namespace tooljoint::linalg {

namespace {

using Blas = Teuchos::BLAS<int, double>;

/// A pivot below this part of its diagonal entry counts as rounding.
constexpr double smallestPivot = 64 * std::numeric_limits<double>::epsilon();

int rowsOf(const Matrix& A) { return static_cast<int>(A.rows()); }
int columnsOf(const Matrix& A) { return static_cast<int>(A.cols()); }

void solveTriangular(const Matrix& L, Teuchos::ETransp transposed, Matrix& B) {
  if (B.size() == 0) return;
  Blas().TRSM(Teuchos::LEFT_SIDE, Teuchos::LOWER_TRI, transposed, Teuchos::NON_UNIT_DIAG, rowsOf(B),
              columnsOf(B), 1.0, L.data(), rowsOf(L), B.data(), rowsOf(B));
}

}  // namespace

Matrix transposedTimes(const Matrix& A, const Matrix& B) {
  Matrix C = Matrix::Zero(A.cols(), B.cols());
  if (C.size() > 0 && A.rows() > 0)
    Blas().GEMM(Teuchos::TRANS, Teuchos::NO_TRANS, columnsOf(A), columnsOf(B), rowsOf(A), 1.0,
                A.data(), rowsOf(A), B.data(), rowsOf(B), 0.0, C.data(), rowsOf(C));
  return C;
}

void addProduct(double factor, const Matrix& A, const Matrix& B, Matrix& C) {
  if (C.size() > 0 && A.cols() > 0)
    Blas().GEMM(Teuchos::NO_TRANS, Teuchos::NO_TRANS, rowsOf(A), columnsOf(B), columnsOf(A), factor,
                A.data(), rowsOf(A), B.data(), rowsOf(B), 1.0, C.data(), rowsOf(C));
}

void addTransposedProduct(const Matrix& A, const Matrix& B, Matrix& C) {
  if (C.size() > 0 && A.cols() > 0)
    Blas().GEMM(Teuchos::NO_TRANS, Teuchos::TRANS, rowsOf(A), rowsOf(B), columnsOf(A), 1.0,
                A.data(), rowsOf(A), B.data(), rowsOf(B), 1.0, C.data(), rowsOf(C));
}

void subtractSquare(const Matrix& Y, Matrix& C) {
  if (C.size() == 0) return;
  if (Y.rows() > 0)
    Blas().SYRK(Teuchos::LOWER_TRI, Teuchos::TRANS, rowsOf(C), rowsOf(Y), -1.0, Y.data(), rowsOf(Y),
                1.0, C.data(), rowsOf(C));
  C.triangularView<Eigen::StrictlyUpper>() = C.transpose();
}

bool DenseCholesky::factor(Matrix A) {
  const Vector diagonal = A.diagonal();
  L_ = std::move(A);
  if (L_.rows() == 0) return true;
  int info = 0;
  Teuchos::LAPACK<int, double>().POTRF('L', rowsOf(L_), L_.data(), rowsOf(L_), &info);
  return info == 0 &&
         (L_.diagonal().array().square() > smallestPivot * diagonal.array().abs()).all();
}

void DenseCholesky::solveLower(Matrix& B) const { solveTriangular(L_, Teuchos::NO_TRANS, B); }
void DenseCholesky::solveUpper(Matrix& B) const { solveTriangular(L_, Teuchos::TRANS, B); }

Matrix DenseCholesky::solve(Matrix B) const {
  solveLower(B);
  solveUpper(B);
  return B;
}

Matrix DenseCholesky::product() const {
  const Matrix L = L_.triangularView<Eigen::Lower>();
  return L * L.transpose();
}

}  // namespace tooljoint::linalg
