// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/part/Partition.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <string>

#include "common/Error.hpp"
#include "common/Index.hpp"

namespace tooljoint::reduction {

namespace {

/// Disjoint sets of the integers 0 .. n-1.
class Sets {
 public:
  explicit Sets(int n) : parent_(at(n)) { std::iota(parent_.begin(), parent_.end(), 0); }
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
      throw ModelError(who + "(" +
                       model::describe(part.model.dofs[at(i)], part.model.componentNames) +
                       ") is named twice among its interface and retained dofs.");
    if (i < last) throw ModelError(who + "is out of order; positions must increase.");
    seen[at(i)] = 1;
    last = i;
  }
}

/// Calls visit(row, column) for every entry of A that is not zero.
template <class Visit>
void forEachEntry(const Sparse& A, const Visit& visit) {
  for (int row = 0; row < A.outerSize(); ++row)
    for (Sparse::InnerIterator it(A, row); it; ++it)
      if (it.value() != 0.0) visit(row, static_cast<int>(it.col()));
}

void findLinks(const model::Substructure& part, Partition& p) {
  constexpr int none = -1;
  std::vector<int> interiorIndex(at(p.size), none);
  std::vector<int> keptIndex(at(p.size), none);
  for (std::size_t i = 0; i < p.interior.size(); ++i)
    interiorIndex[at(p.interior[i])] = static_cast<int>(i);
  for (std::size_t i = 0; i < p.kept.size(); ++i) keptIndex[at(p.kept[i])] = static_cast<int>(i);

  const Sparse K = constantStiffness(part.model);
  Sets sets(static_cast<int>(p.interior.size()));
  const auto join = [&](int row, int column) {
    const int i = interiorIndex[at(row)];
    const int j = interiorIndex[at(column)];
    if (i != none && j != none) sets.join(i, j);
  };
  forEachEntry(K, join);
  forEachEntry(part.model.mass, join);

  std::vector<int> linkOfRoot(p.interior.size(), none);
  for (int i = 0; i < static_cast<int>(p.interior.size()); ++i) {
    int& link = linkOfRoot[at(sets.find(i))];
    if (link == none) {
      link = static_cast<int>(p.links.size());
      p.links.emplace_back();
    }
    p.links[at(link)].push_back(i);
  }

  p.ends.resize(p.links.size());
  forEachEntry(K, [&](int row, int column) {
    for (const auto& [inner, outer] : {std::pair{row, column}, std::pair{column, row}})
      if (interiorIndex[at(inner)] != none && keptIndex[at(outer)] != none)
        p.ends[at(linkOfRoot[at(sets.find(interiorIndex[at(inner)]))])].push_back(
            keptIndex[at(outer)]);
  });
  for (auto& ends : p.ends) {
    std::sort(ends.begin(), ends.end());
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  }
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
    throw ModelError("Part \"" + part.name + "\": its reference state is not finite.");
  if (!nearlySymmetric(part.model.mass, 1e-10))
    throw ModelError("Part \"" + part.name + "\": its mass matrix is not symmetric.");
}

Partition partition(const model::Substructure& part) {
  checkPart(part);
  Partition p;
  p.size = part.model.size();
  p.interface = part.interface;
  p.retained = part.retained;
  p.interior = part.interior();
  p.kept = p.interface;
  p.kept.insert(p.kept.end(), p.retained.begin(), p.retained.end());
  findLinks(part, p);
  return p;
}

Sparse constantStiffness(const model::SecondOrderModel& model) {
  Sparse K(model.size(), model.size());
  for (const auto& term : model.stiffness)
    if (model.laws[at(term.law)].name == "1") K += term.matrix;
  return K;
}

Sparse symmetricPart(const Sparse& A) {
  const Sparse transposed = A.transpose();
  return 0.5 * (A + transposed);
}

bool nearlySymmetric(const Sparse& A, double tolerance) {
  const Sparse transposed = A.transpose();
  const Sparse difference = A - transposed;
  const Vector diagonal = A.diagonal().cwiseAbs();
  const double largest =
      A.nonZeros() > 0 ? Eigen::Map<const Vector>(A.valuePtr(), A.nonZeros()).cwiseAbs().maxCoeff()
                       : 0.0;
  for (int i = 0; i < difference.outerSize(); ++i)
    for (Sparse::InnerIterator it(difference, i); it; ++it) {
      const double scale = std::sqrt(diagonal[i] * diagonal[it.col()]);
      if (std::abs(it.value()) > tolerance * (scale > 0.0 ? scale : largest)) return false;
    }
  return true;
}

Sparse block(const Sparse& A, const std::vector<int>& rows, const std::vector<int>& columns) {
  std::vector<int> columnIndex(at(static_cast<int>(A.cols())), -1);
  for (std::size_t j = 0; j < columns.size(); ++j)
    columnIndex[at(columns[j])] = static_cast<int>(j);
  Triplets entries;
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (Sparse::InnerIterator it(A, rows[i]); it; ++it) {
      const int j = columnIndex[at(static_cast<int>(it.col()))];
      if (j >= 0) entries.emplace_back(static_cast<int>(i), j, it.value());
    }
  Sparse out(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(columns.size()));
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

}  // namespace tooljoint::reduction
