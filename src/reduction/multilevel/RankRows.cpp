// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/multilevel/RankRows.hpp"

#include "common/Message.hpp"
#include "common/Parallel.hpp"

namespace tooljoint::reduction {

namespace {

Eigen::Index beginOf(Eigen::Index size, int rank) { return size * rank / parallel::size(); }

}  // namespace

Matrix sumOverRanks(const Matrix& mine) {
  if (parallel::size() == 1) return mine;
  Matrix sum = Matrix::Zero(mine.rows(), mine.cols());
  for (int rank = 0; rank < parallel::size(); ++rank) {
    Matrix one;
    if (rank == parallel::rank()) one = mine;
    parallel::broadcast(one, rank);
    sum += one;
  }
  return sum;
}

RankRows::RankRows(Eigen::Index size)
    : size_(size),
      first_(beginOf(size, parallel::rank())),
      count_(beginOf(size, parallel::rank() + 1) - first_) {}

Matrix RankRows::all(const Matrix& mine) const {
  if (parallel::size() == 1) return mine;
  Matrix X(size_, mine.cols());
  for (int rank = 0; rank < parallel::size(); ++rank) {
    Matrix rows;
    if (rank == parallel::rank()) rows = mine;
    parallel::broadcast(rows, rank);
    X.middleRows(beginOf(size_, rank), rows.rows()) = rows;
  }
  return X;
}

}  // namespace tooljoint::reduction
