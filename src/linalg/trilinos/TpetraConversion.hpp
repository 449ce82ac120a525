// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Eigen <-> Tpetra on rank-local maps. Every map created here is on Teuchos::SerialComm: with
/// Amesos2 of Trilinos 13.2 the solutions are wrong for matrices on communicators of two and more
/// ranks, and right on SerialComm for any number of ranks.
///
/// Included only by solver sources; no public header of the project includes Tpetra.
#pragma once

#include <algorithm>

#include "common/Types.hpp"
#include "linalg/trilinos/TrilinosAliases.hpp"

namespace tooljoint::linalg {

using ConstMatrixView = Eigen::Map<const Matrix, 0, Eigen::OuterStride<>>;
using MatrixView = Eigen::Map<Matrix, 0, Eigen::OuterStride<>>;

/// Map of n rows that all live on the calling rank.
Teuchos::RCP<const tpetra::Map> serialMap(int n);

/// Copy of a square matrix, fill complete. Row and column maps are both `map`, so local column
/// numbers are the column numbers of A even when A has empty columns (KLU2 reads local column
/// numbers).
Teuchos::RCP<tpetra::CrsMatrix> toTpetra(const Sparse& A,
                                         const Teuchos::RCP<const tpetra::Map>& map);

/// Overwrites the values of a matrix made by toTpetra; A has the same pattern (compressed).
void replaceValues(tpetra::CrsMatrix& matrix, const Sparse& A);

/// Copies of dense columns, and back.
Teuchos::RCP<tpetra::MultiVector> toTpetra(const Matrix& columns,
                                           const Teuchos::RCP<const tpetra::Map>& map);
Matrix toEigen(const tpetra::MultiVector& columns);

/// Runs work(X, Y) on Eigen views of two multivectors without copying; Y is overwritten.
template <class Work>
void onViews(const tpetra::MultiVector& x, tpetra::MultiVector& y, Work&& work) {
  const auto xHost = tpetra::readHost(x);
  const auto yHost = tpetra::overwriteHost(y);
  const auto rows = static_cast<Eigen::Index>(xHost.extent(0));
  const auto stride = [rows](const auto& view) {
    return Eigen::OuterStride<>(view.extent(1) > 1 ? static_cast<Eigen::Index>(view.stride(1))
                                                   : std::max<Eigen::Index>(rows, 1));
  };
  const ConstMatrixView in(xHost.data(), rows, static_cast<Eigen::Index>(xHost.extent(1)),
                           stride(xHost));
  MatrixView out(yHost.data(), static_cast<Eigen::Index>(yHost.extent(0)),
                 static_cast<Eigen::Index>(yHost.extent(1)), stride(yHost));
  work(in, out);
}

/// Whether both matrices are compressed and have the same pattern.
bool samePattern(const Sparse& a, const Sparse& b);

}  // namespace tooljoint::linalg
