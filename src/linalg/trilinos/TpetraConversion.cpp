// SPDX-License-Identifier: BSD-3-Clause
#include "linalg/trilinos/TpetraConversion.hpp"

#include <Kokkos_Core.hpp>
#include <algorithm>
#include <stdexcept>

namespace tooljoint::linalg {

Teuchos::RCP<const tpetra::Map> serialMap(int n) {
  if (!Kokkos::is_initialized())
    throw std::logic_error(
        "Solvers need a live Tpetra::ScopeGuard: create one first thing in main().");
  const Teuchos::RCP<const Teuchos::Comm<int>> self = Teuchos::rcp(new Teuchos::SerialComm<int>());
  return Teuchos::rcp(new const tpetra::Map(static_cast<Tpetra::global_size_t>(n), 0, self));
}

Teuchos::RCP<tpetra::CrsMatrix> toTpetra(const Sparse& A,
                                         const Teuchos::RCP<const tpetra::Map>& map) {
  Sparse compressed = A;
  compressed.makeCompressed();
  const auto rows = static_cast<std::size_t>(compressed.rows());
  const auto entries = static_cast<std::size_t>(compressed.nonZeros());
  Teuchos::ArrayRCP<std::size_t> pointers(static_cast<Teuchos::Ordinal>(rows + 1));
  Teuchos::ArrayRCP<tpetra::LocalOrdinal> columns(static_cast<Teuchos::Ordinal>(entries));
  Teuchos::ArrayRCP<double> values(static_cast<Teuchos::Ordinal>(entries));
  std::transform(compressed.outerIndexPtr(), compressed.outerIndexPtr() + rows + 1,
                 pointers.begin(), [](int p) { return static_cast<std::size_t>(p); });
  std::copy_n(compressed.innerIndexPtr(), entries, columns.begin());
  std::copy_n(compressed.valuePtr(), entries, values.begin());
  const auto matrix = Teuchos::rcp(new tpetra::CrsMatrix(map, map, pointers, columns, values));
  matrix->expertStaticFillComplete(map, map);
  return matrix;
}

void replaceValues(tpetra::CrsMatrix& matrix, const Sparse& A) {
  const auto local = matrix.getLocalMatrixHost();
  if (static_cast<Eigen::Index>(local.nnz()) != A.nonZeros())
    throw std::logic_error("replaceValues: the pattern of the matrix has changed.");
  std::copy_n(A.valuePtr(), A.nonZeros(), local.values.data());
}

Teuchos::RCP<tpetra::MultiVector> toTpetra(const Matrix& columns,
                                           const Teuchos::RCP<const tpetra::Map>& map) {
  const auto result =
      Teuchos::rcp(new tpetra::MultiVector(map, static_cast<std::size_t>(columns.cols())));
  const auto host = tpetra::overwriteHost(*result);
  for (Eigen::Index j = 0; j < columns.cols(); ++j)
    for (Eigen::Index i = 0; i < columns.rows(); ++i)
      host(static_cast<std::size_t>(i), static_cast<std::size_t>(j)) = columns(i, j);
  return result;
}

Matrix toEigen(const tpetra::MultiVector& columns) {
  const auto host = tpetra::readHost(columns);
  Matrix result(static_cast<Eigen::Index>(host.extent(0)),
                static_cast<Eigen::Index>(host.extent(1)));
  for (Eigen::Index j = 0; j < result.cols(); ++j)
    for (Eigen::Index i = 0; i < result.rows(); ++i)
      result(i, j) = host(static_cast<std::size_t>(i), static_cast<std::size_t>(j));
  return result;
}

bool samePattern(const Sparse& a, const Sparse& b) {
  return a.isCompressed() && b.isCompressed() && a.rows() == b.rows() && a.cols() == b.cols() &&
         a.nonZeros() == b.nonZeros() &&
         std::equal(a.outerIndexPtr(), a.outerIndexPtr() + a.rows() + 1, b.outerIndexPtr()) &&
         std::equal(a.innerIndexPtr(), a.innerIndexPtr() + a.nonZeros(), b.innerIndexPtr());
}

}  // namespace tooljoint::linalg
