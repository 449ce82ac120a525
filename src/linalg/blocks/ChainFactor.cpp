// SPDX-License-Identifier: BSD-3-Clause
#include "linalg/blocks/ChainFactor.hpp"

#include <algorithm>
#include <numeric>

#include "common/Index.hpp"

namespace tooljoint::linalg {
namespace {

/// Dofs of a beam node in space.
constexpr int nodeDofs = 6;

/// First row of each run of rows with equal pattern, and the number of rows at the end.
std::vector<int> runsOfOnePattern(const Sparse& A) {
  const int* start = A.outerIndexPtr();
  const int* column = A.innerIndexPtr();
  std::vector<int> first{0};
  for (int i = 1; i < A.rows(); ++i)
    if (!std::equal(column + start[i - 1], column + start[i], column + start[i],
                    column + start[i + 1]))
      first.push_back(i);
  if (A.rows() > 0) first.push_back(static_cast<int>(A.rows()));
  return first;
}

BlockPartition partitionOf(const Sparse& A) {
  BlockPartition partition;
  partition.start = runsOfOnePattern(A);
  partition.position.resize(at(static_cast<int>(A.rows())));
  std::iota(partition.position.begin(), partition.position.end(), 0);
  partition.dof = partition.position;
  return partition;
}

}  // namespace

bool ChainFactor::isChain(const Sparse& A) {
  if (!A.isCompressed() || A.rows() < 2 * nodeDofs) return false;
  const int* start = A.outerIndexPtr();
  for (int i = 0; i < A.rows(); ++i)
    if (start[i + 1] - start[i] > 3 * nodeDofs) return false;
  const auto runs = static_cast<Eigen::Index>(runsOfOnePattern(A).size()) - 1;
  return 2 * A.rows() > nodeDofs * runs;
}

ChainFactor::ChainFactor(const Sparse& A) {
  Sparse pattern = A;
  std::fill(pattern.valuePtr(), pattern.valuePtr() + pattern.nonZeros(), 1.0);
  const BlockPattern blocks(partitionOf(A), {&pattern});
  factor_ = BlockFactor(blocks);
  storage_ = blocks.storage() + factor_.fill();
  address_.reserve(static_cast<std::size_t>(A.nonZeros()));
  for (int i = 0; i < A.rows(); ++i)
    for (Sparse::InnerIterator it(A, i); it; ++it)
      address_.push_back(blocks.address(i, static_cast<int>(it.col())));
}

bool ChainFactor::factor(const Sparse& A) {
  fill(A, 0, static_cast<int>(A.rows()));
  return factor_.factor() < 0;
}

void ChainFactor::fill(const Sparse& A, int begin, int end) {
  double* values = factor_.values();
  std::fill(values, values + storage_, 0.0);
  const double* entry = A.valuePtr();
  for (std::size_t k = at(A.outerIndexPtr()[begin]); k < at(A.outerIndexPtr()[end]); ++k)
    values[address_[k]] = entry[k];
}

}  // namespace tooljoint::linalg
