// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/part/Partition.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "common/Error.hpp"
#include "common/Index.hpp"
#include "linalg/SparseProducts.hpp"
#include "model/DofNames.hpp"

namespace tooljoint::reduction {

namespace {

/// Disjoint sets of the integers 0 .. n-1.
class Sets {
 public:
  explicit Sets(int n) : parent_(range(n)) {}
  int find(int i) {
    while (parent_[at(i)] != i) i = parent_[at(i)] = parent_[at(parent_[at(i)])];
    return i;
  }
  void join(int i, int j) {
    i = find(i);
    j = find(j);
    if (i != j) parent_[at(std::max(i, j))] = std::min(i, j);
  }

 private:
  std::vector<int> parent_;
};

void checkPositions(const model::Substructure& part, const std::vector<int>& positions,
                    const char* kind, std::vector<char>& seen) {
  const int n = part.model.size();
  int last = -1;
  for (int i : positions) {
    const std::string who =
        "Part \"" + part.name + "\": position " + std::to_string(i) + " of its " + kind + " dofs ";
    if (i < 0 || i >= n) throw ModelError(who + "is outside its " + std::to_string(n) + " dofs.");
    if (seen[at(i)])
      throw ModelError(who + "(" + model::dofName(part.model, i) +
                       ") appears twice among its interface and retained dofs.");
    if (i < last) throw ModelError(who + "is not in increasing order. Sort the positions.");
    seen[at(i)] = 1;
    last = i;
  }
}

/// Index of every dof in a list of positions, -1 if it is not in the list.
std::vector<int> inverse(const std::vector<int>& positions, int size) {
  std::vector<int> index(at(size), -1);
  for (int i = 0; i < sizeOf(positions); ++i) index[at(positions[at(i)])] = i;
  return index;
}

void findBlocks(const model::SecondOrderModel& model, const Sparse& K, Partition& p) {
  const std::vector<int> interior = inverse(p.interior, p.size),
                         boundary = inverse(p.boundary, p.size);
  Sets sets(sizeOf(p.interior));
  const auto join = [&](int row, int column, double value) {
    const int i = interior[at(row)], j = interior[at(column)];
    if (value != 0.0 && i >= 0 && j >= 0) sets.join(i, j);
  };
  forEachEntry(K, join);
  forEachEntry(model.mass, join);

  std::vector<int> blockOf(p.interior.size(), -1);
  for (int i = 0; i < sizeOf(p.interior); ++i) {
    int& number = blockOf[at(sets.find(i))];
    if (number < 0) {
      number = sizeOf(p.blocks);
      p.blocks.emplace_back();
    }
    p.blocks[at(number)].push_back(i);
  }

  p.touched.resize(p.blocks.size());
  forEachEntry(K, [&](int row, int column, double value) {
    for (const auto& [inner, outer] : {std::pair{row, column}, std::pair{column, row}})
      if (value != 0.0 && interior[at(inner)] >= 0 && boundary[at(outer)] >= 0)
        p.touched[at(blockOf[at(sets.find(interior[at(inner)]))])].push_back(boundary[at(outer)]);
  });
  for (auto& touched : p.touched) makeUnique(touched);
}

}  // namespace

void checkPart(const model::Substructure& part) {
  try {
    part.model.validate();
  } catch (const ModelError& error) {
    throw ModelError("Part \"" + part.name + "\": " + error.what());
  }
  const int size = part.model.size();
  std::vector<char> seen(at(size), 0);
  checkPositions(part, part.interface, "interface", seen);
  checkPositions(part, part.retained, "retained", seen);
  if (part.reference.size() != 0 && part.reference.size() != size)
    throw ModelError("Part \"" + part.name + "\": its reference state has " +
                     std::to_string(part.reference.size()) + " entries for " +
                     std::to_string(size) + " dofs.");
  if (!part.reference.allFinite())
    throw ModelError("Part \"" + part.name +
                     "\": its reference state contains a value that is not finite.");
  if (!nearlySymmetric(part.model.mass, 1e-10))
    throw ModelError("Part \"" + part.name + "\": its mass matrix is not symmetric.");
}

Partition partition(const model::Substructure& part) {
  checkPart(part);
  return partition(part.model, constantStiffness(part.model), part.interface, part.retained);
}

Partition partition(const model::SecondOrderModel& model, const Sparse& K,
                    const std::vector<int>& interface, const std::vector<int>& retained) {
  Partition p;
  p.size = model.size();
  p.interface = interface;
  p.retained = retained;
  p.boundary = interface;
  p.boundary.insert(p.boundary.end(), retained.begin(), retained.end());
  const std::vector<int> boundary = inverse(p.boundary, p.size);
  for (int i = 0; i < p.size; ++i)
    if (boundary[at(i)] < 0) p.interior.push_back(i);
  findBlocks(model, K, p);
  return p;
}

Sparse constantStiffness(const model::SecondOrderModel& model) {
  Sparse K(model.size(), model.size());
  for (const auto& term : model.stiffness)
    if (model.laws[at(term.law)].isOne()) K += term.matrix;
  return K;
}

Sparse symmetricPart(const Sparse& A) {
  if (linalg::isExactlySymmetric(A)) return A;
  const Sparse transposed = A.transpose();
  return 0.5 * (A + transposed);
}

double largestEntry(const Sparse& A) {
  return A.nonZeros() > 0
             ? Eigen::Map<const Vector>(A.valuePtr(), A.nonZeros()).cwiseAbs().maxCoeff()
             : 0.0;
}

bool nearlySymmetric(const Sparse& A, double tolerance) {
  const Sparse transposed = A.transpose();
  const Sparse difference = A - transposed;
  const Vector diagonal = A.diagonal().cwiseAbs();
  const double largest = largestEntry(A);
  for (int i = 0; i < difference.outerSize(); ++i)
    for (Sparse::InnerIterator it(difference, i); it; ++it) {
      const double scale = std::sqrt(diagonal[i] * diagonal[it.col()]);
      if (std::abs(it.value()) > tolerance * (scale > 0.0 ? scale : largest)) return false;
    }
  return true;
}

Sparse block(const Sparse& A, const std::vector<int>& rows, const std::vector<int>& columns) {
  const std::vector<int> columnIndex = inverse(columns, static_cast<int>(A.cols()));
  const auto forEachKept = [&](int i, const auto& visit) {
    forEachInRow(A, rows[at(i)], [&](int column, double value) {
      if (const int j = columnIndex[at(column)]; j >= 0) visit(j, value);
    });
  };
  Eigen::Index entries = 0;
  for (int i = 0; i < sizeOf(rows); ++i) forEachKept(i, [&](int, double) { ++entries; });
  Sparse found(sizeOf(rows), sizeOf(columns));
  found.reserve(entries);
  std::vector<std::pair<int, double>> row;
  for (int i = 0; i < sizeOf(rows); ++i) {
    row.clear();
    forEachKept(i, [&](int j, double value) { row.emplace_back(j, value); });
    std::sort(row.begin(), row.end());
    found.startVec(i);
    for (const auto& [j, value] : row) found.insertBack(i, j) = value;
  }
  found.finalize();
  return found;
}

model::SharedSparse interiorOf(const Partition& partition, const model::SharedSparse& A) {
  if (sizeOf(partition.interior) == partition.size) return A;
  return block(A, partition.interior, partition.interior);
}

}  // namespace tooljoint::reduction
