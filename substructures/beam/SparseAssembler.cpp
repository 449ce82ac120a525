// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/beam/SparseAssembler.hpp"

#include <algorithm>
#include <utility>

namespace tooljoint::beam {

SparseAssembler::SparseAssembler(int size, std::vector<std::vector<int>> unknowns)
    : size_(size), unknowns_(std::move(unknowns)), pattern_(size, size) {
  Triplets entries;
  std::size_t count = static_cast<std::size_t>(size);
  for (const std::vector<int>& rows : unknowns_) count += rows.size() * rows.size();
  entries.reserve(count);
  for (int i = 0; i < size; ++i) entries.emplace_back(i, i, 0.0);
  for (const std::vector<int>& rows : unknowns_)
    for (const int i : rows)
      for (const int j : rows)
        if (i >= 0 && j >= 0) entries.emplace_back(i, j, 0.0);
  pattern_.setFromTriplets(entries.begin(), entries.end());
  pattern_.makeCompressed();

  const int* start = pattern_.outerIndexPtr();
  const int* column = pattern_.innerIndexPtr();
  slots_.reserve(unknowns_.size());
  for (const std::vector<int>& rows : unknowns_) {
    std::vector<int> slots;
    slots.reserve(rows.size() * rows.size());
    for (const int i : rows)
      for (const int j : rows)
        slots.push_back(
            i < 0 || j < 0
                ? -1
                : static_cast<int>(std::lower_bound(column + start[i], column + start[i + 1], j) -
                                   column));
    slots_.push_back(std::move(slots));
  }
}

void SparseAssembler::clear(Sparse& matrix) const {
  if (matrix.rows() != size_ || matrix.nonZeros() != pattern_.nonZeros() || !matrix.isCompressed())
    matrix = pattern_;
  else
    std::fill(matrix.valuePtr(), matrix.valuePtr() + matrix.nonZeros(), 0.0);
}

}  // namespace tooljoint::beam
