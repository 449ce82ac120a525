// SPDX-License-Identifier: BSD-3-Clause
#include "transient/ranks/RankShare.hpp"

#include <algorithm>
#include <map>
#include <mpi.h>
#include <numeric>
#include <set>
#include <utility>

#include "common/Communicator.hpp"
#include "common/Index.hpp"
#include "common/Parallel.hpp"
#include "transient/compiled/ModelPattern.hpp"
#include "transient/ranks/BlockLevels.hpp"

namespace tooljoint::transient {
namespace {

/// Dofs of a beam node in space.
constexpr int nodeDofs = 6;
/// Cost of a point in a step relative to an entry of the matrix.
constexpr double pointWork = 80;
/// Cost of an entry in products relative to one in solves, because a step has so many more
/// products. Rows with other than six dofs cost more, because the kernels for six are the fastest.
constexpr double productWork = 2.0, otherWork = 1.4;

/// Blocks used by the rows of a matrix, for groups of `rows` rows.
std::vector<std::vector<int>> blocksOfRows(const Sparse& matrix, int rows,
                                           const std::vector<int>& blockOf) {
  std::vector<std::vector<int>> all;
  for (int first = 0; first < matrix.rows(); first += rows) {
    std::set<int> blocks;
    for (int r = first; r < std::min<int>(first + rows, static_cast<int>(matrix.rows())); ++r)
      forEachInRow(matrix, r, [&](int column, double value) {
        if (value != 0.0) blocks.insert(blockOf[at(column)]);
      });
    all.emplace_back(blocks.begin(), blocks.end());
  }
  return all;
}

/// The whole model and its distribution among the ranks.
class Division {
 public:
  Division(const model::SecondOrderModel& whole, int ranks)
      : whole_(whole), pattern_(modelPattern(whole)) {
    const auto& partition = pattern_.partition();
    for (int i = 0; i < whole.size(); ++i)
      blockOf_.push_back(pattern_.blockOf(partition.position[at(i)]));
    recovery_ = blocksOfRows(whole.recovery, 1, blockOf_);
    for (const auto& set : whole.points)
      points_.push_back(blocksOfRows(set.rows, set.law->width(), blockOf_));
    shares_ = divide(graph(), widths(), works(), ranks);
  }

  bool isPossible() const {
    const auto allHeld = [this](const std::vector<std::vector<int>>& sets) {
      return std::all_of(sets.begin(), sets.end(), [this](const auto& blocks) {
        const int rank = rankOf(blocks);
        return std::all_of(blocks.begin(), blocks.end(),
                           [&](int b) { return shares_.holds(rank, b); });
      });
    };
    return !shares_.rank.empty() && allHeld(recovery_) &&
           std::all_of(points_.begin(), points_.end(), allHeld);
  }

  /// Rank to which a coupling of these blocks belongs; 0 for none.
  int rankOf(const std::vector<int>& blocks) const {
    int rank = 0;
    for (int b : blocks) {
      if (!shares_.cut[at(b)]) return shares_.rank[at(b)];
      rank = std::max(rank, shares_.rank[at(b)]);
    }
    return rank;
  }
  int rankOf(int dof, int other) const { return rankOf({blockOf_[at(dof)], blockOf_[at(other)]}); }
  int rankOfRecovery(int row) const { return rankOf(recovery_[at(row)]); }
  int rankOfPoint(std::size_t set, int point) const { return rankOf(points_[set][at(point)]); }

  /// Blocks of a rank: its interior or its cuts.
  std::vector<int> blocks(int rank, bool cut) const {
    std::vector<int> found;
    for (int b = 0; b < pattern_.blocks(); ++b)
      if ((shares_.cut[at(b)] != 0) == cut && shares_.holds(rank, b)) found.push_back(b);
    return found;
  }
  /// Blocks counted by a rank: its interior, and the cut to the next rank.
  std::vector<int> counted(int rank) const {
    auto found = blocks(rank, false);
    for (int b : blocks(rank, true))
      if (shares_.rank[at(b)] == rank) found.push_back(b);
    return found;
  }
  std::vector<int> dofs(const std::vector<int>& blocks) const {
    std::vector<int> found;
    for (int b : blocks)
      for (int p = pattern_.start(b); p < pattern_.start(b + 1); ++p)
        found.push_back(pattern_.partition().dof[at(p)]);
    return found;
  }
  /// Position of a dof in the pattern of the whole model.
  int number(int dof) const { return pattern_.partition().position[at(dof)]; }
  linalg::BlockPattern pattern(int rank, const model::SecondOrderModel& share) const;
  const model::SecondOrderModel& whole() const { return whole_; }

 private:
  BlockGraph graph() const {
    BlockGraph graph(at(pattern_.blocks()));
    for (int b = 0; b < pattern_.blocks(); ++b)
      for (int e = pattern_.rowBegin(b); e < pattern_.rowBegin(b + 1); ++e)
        if (pattern_.column(e) != b) graph[at(b)].insert(pattern_.column(e));
    std::set<std::vector<int>> known(recovery_.begin(), recovery_.end());
    for (const auto& blocks : known)
      for (int b : blocks)
        for (int c : blocks)
          if (b != c) graph[at(b)].insert(c);
    return graph;
  }
  std::vector<int> widths() const {
    std::vector<int> found;
    for (int b = 0; b < pattern_.blocks(); ++b) found.push_back(pattern_.width(b));
    return found;
  }
  /// Work of a step per block: solves read the whole pattern, products the blocks of M, C and K.
  std::vector<double> works() const {
    std::vector<double> work(at(pattern_.blocks()), 0.0);
    for (int b = 0; b < pattern_.blocks(); ++b)
      for (int e = pattern_.rowBegin(b); e < pattern_.rowBegin(b + 1); ++e)
        work[at(b)] += area(b, e);
    addProduct({&whole_.mass.sparse()}, work);
    for (const auto* terms : {&whole_.damping, &whole_.stiffness})
      for (const auto& [law, matrices] : byLaw(*terms)) addProduct(matrices, work);
    for (std::size_t s = 0; s < points_.size(); ++s)
      for (std::size_t p = 0; p < points_[s].size(); ++p)
        if (!points_[s][p].empty())
          work[at(points_[s][p].front())] += pointWork + entriesOfPoint(whole_.points[s], p);
    return work;
  }
  double area(int block, int entry) const {
    return pattern_.width(block) * pattern_.width(pattern_.column(entry));
  }
  /// Terms with the same law form one matrix in a step.
  std::map<std::string, std::vector<const Sparse*>> byLaw(
      const model::SharedList<model::MatrixTerm>& terms) const {
    std::map<std::string, std::vector<const Sparse*>> all;
    for (const auto& term : terms)
      all[whole_.laws[at(term.law)].name].push_back(&term.matrix.sparse());
    return all;
  }
  static double entriesOfPoint(const model::PointSet& set, std::size_t point) {
    const int width = set.law->width(), first = static_cast<int>(point) * width;
    double count = 0;
    for (int row = first; row < first + width; ++row)
      forEachInRow(set.rows, row, [&](int, double) { ++count; });
    return count;
  }
  /// Adds the entries read by a product with the sum of some matrices: none of a zero block, the
  /// diagonal of a diagonal block.
  void addProduct(const std::vector<const Sparse*>& matrices, std::vector<double>& work) const {
    std::vector<char> form(at(pattern_.rowBegin(pattern_.blocks())), 0);  // 1 diagonal, 2 dense
    const auto& position = pattern_.partition().position;
    for (const Sparse* matrix : matrices)
      forEachEntry(*matrix, [&](int i, int j, double value) {
        const int b = blockOf_[at(i)], c = blockOf_[at(j)];
        const bool diagonal =
            pattern_.width(b) == pattern_.width(c) &&
            position[at(i)] - pattern_.start(b) == position[at(j)] - pattern_.start(c);
        char& known = form[at(pattern_.find(b, c))];
        if (value != 0.0) known = std::max(known, static_cast<char>(diagonal ? 1 : 2));
      });
    for (int b = 0; b < pattern_.blocks(); ++b) {
      const double each = productWork * (pattern_.width(b) == nodeDofs ? 1.0 : otherWork);
      for (int e = pattern_.rowBegin(b); e < pattern_.rowBegin(b + 1); ++e)
        if (form[at(e)] != 0)
          work[at(b)] += each * (form[at(e)] == 2 ? area(b, e) : pattern_.width(b));
    }
  }

  const model::SecondOrderModel& whole_;
  linalg::BlockPattern pattern_;
  std::vector<int> blockOf_;                           ///< per dof
  std::vector<std::vector<int>> recovery_;             ///< blocks per row
  std::vector<std::vector<std::vector<int>>> points_;  ///< per set and point
  BlockShares shares_;
};

linalg::BlockPattern Division::pattern(int rank, const model::SecondOrderModel& share) const {
  const auto interior = blocks(rank, false), cut = blocks(rank, true);
  linalg::BlockPartition partition;
  partition.start.push_back(0);
  for (const auto* list : {&interior, &cut})
    for (int b : *list) partition.start.push_back(partition.start.back() + pattern_.width(b));
  partition.dof.resize(at(partition.start.back()));
  std::iota(partition.dof.begin(), partition.dof.end(), 0);
  partition.position = partition.dof;

  std::vector<int> numberOf(at(pattern_.blocks()), 0);  // first number of each block of the cut
  int total = 0;
  for (int b = 0; b < pattern_.blocks(); ++b)
    if (shares_.cut[at(b)]) numberOf[at(b)] = total, total += pattern_.width(b);
  std::vector<int> number;
  std::vector<char> own;
  for (int b : cut)
    for (int i = 0; i < pattern_.width(b); ++i) {
      number.push_back(numberOf[at(b)] + i);
      own.push_back(shares_.rank[at(b)] == rank ? 1 : 0);
    }
  auto result = modelPattern(share, partition);
  result.divide(
      linalg::RankCut(partition.start[interior.size()], std::move(number), total, std::move(own)));
  return result;
}

/// Rows and columns of the dofs of a rank, with the entries that belong to it.
Sparse shareOf(const Sparse& matrix, const Division& division, int rank,
               const std::vector<int>& local) {
  const int n = static_cast<int>(*std::max_element(local.begin(), local.end())) + 1;
  Triplets entries;
  forEachEntry(matrix, [&](int i, int j, double value) {
    if (local[at(i)] >= 0 && local[at(j)] >= 0 && division.rankOf(i, j) == rank)
      entries.emplace_back(local[at(i)], local[at(j)], value);
  });
  Sparse share(n, n);
  share.setFromTriplets(entries.begin(), entries.end());
  return share;
}

/// Columns of the dofs of a rank, with the rows selected by keep().
template <class Keep>
Sparse shareOfRows(const Sparse& rows, const std::vector<int>& local, const Keep& keep) {
  const int n = *std::max_element(local.begin(), local.end()) + 1;
  Triplets entries;
  forEachEntry(rows, [&](int i, int j, double value) {
    if (keep(i)) entries.emplace_back(i, local[at(j)], value);
  });
  Sparse share(rows.rows(), n);
  share.setFromTriplets(entries.begin(), entries.end());
  return share;
}

model::SecondOrderModel modelOf(const Division& division, int rank, const std::vector<int>& dofs) {
  const auto& whole = division.whole();
  std::vector<int> local(at(whole.size()), -1);
  for (std::size_t i = 0; i < dofs.size(); ++i) local[at(dofs[i])] = static_cast<int>(i);
  const auto pick = [&](const Vector& all) {
    Vector mine(static_cast<Eigen::Index>(dofs.size()));
    for (std::size_t i = 0; i < dofs.size(); ++i) mine[static_cast<int>(i)] = all[dofs[i]];
    return mine;
  };
  model::SecondOrderModel share;
  for (int i : dofs) share.dofs.push_back(whole.dofs[at(i)]);
  share.componentNames = whole.componentNames;
  share.nodeName = whole.nodeName;
  share.laws = whole.laws;
  share.mass = shareOf(whole.mass, division, rank, local);
  for (const auto& term : whole.damping)
    share.damping.push_back({term.name, shareOf(term.matrix, division, rank, local), term.law});
  for (const auto& term : whole.stiffness)
    share.stiffness.push_back({term.name, shareOf(term.matrix, division, rank, local), term.law});
  for (const auto& term : whole.loads) {
    share.loads.push_back({term.name, pick(term.vector), term.law});
    for (std::size_t i = 0; i < dofs.size(); ++i)
      if (division.rankOf(dofs[i], dofs[i]) != rank)
        share.loads.back().vector[static_cast<int>(i)] = 0.0;
  }
  for (std::size_t s = 0; s < whole.points.size(); ++s) {
    const auto& set = whole.points[s];
    share.points.push_back(set);
    share.points.back().rows = shareOfRows(set.rows, local, [&](int row) {
      return division.rankOfPoint(s, row / set.law->width()) == rank;
    });
  }
  share.initialDisplacement = pick(whole.initialDisplacement);
  share.initialVelocity = pick(whole.initialVelocity);
  share.recovery = shareOfRows(whole.recovery, local,
                               [&](int row) { return division.rankOfRecovery(row) == rank; });
  share.recoveryOffset = whole.recoveryOffset;
  share.recoveryNodes = whole.recoveryNodes;
  return share;
}

}  // namespace

std::unique_ptr<RankShare> RankShare::of(const model::SecondOrderModel& whole) {
  const int ranks = parallel::size(), rank = parallel::rank();
  const Division division(whole, ranks);
  if (!division.isPossible()) return nullptr;
  auto dofs = division.dofs(division.blocks(rank, false));
  const auto cut = division.dofs(division.blocks(rank, true));
  dofs.insert(dofs.end(), cut.begin(), cut.end());

  std::unique_ptr<RankShare> share(new RankShare);
  share->model_ = modelOf(division, rank, dofs);
  share->pattern_ = division.pattern(rank, share->model_);
  for (std::size_t s = 0; s < whole.points.size(); ++s) {
    share->points_.emplace_back();
    for (int p = 0; p < whole.points[s].law->size(); ++p)
      if (division.rankOfPoint(s, p) == rank) share->points_.back().push_back(p);
  }
  share->place_.resize(at(whole.size()));
  int next = 0;
  for (int r = 0; r < ranks; ++r) {
    share->begins_.push_back(next);
    for (int dof : division.dofs(division.counted(r))) share->place_[at(dof)] = next++;
    share->counts_.push_back(next - share->begins_.back());
  }
  for (int i = 0; i < static_cast<int>(dofs.size()); ++i)
    if (share->pattern_.cut().owns(i)) share->counted_.push_back(i);
  for (int dof : dofs) share->numbers_.push_back(division.number(dof));
  share->dofs_ = std::move(dofs);
  share->mine_.resize(share->counted_.size());
  share->all_.resize(at(next));
  return share;
}

Vector RankShare::pick(const Vector& whole) const {
  Vector mine(static_cast<Eigen::Index>(dofs_.size()));
  for (std::size_t i = 0; i < dofs_.size(); ++i) mine[static_cast<int>(i)] = whole[dofs_[i]];
  return mine;
}

void RankShare::gather(const Vector& mine, Vector& whole) const {
  for (std::size_t i = 0; i < counted_.size(); ++i) mine_[i] = mine[counted_[i]];
  const int rank = parallel::rank();
  MPI_Allgatherv(mine_.data(), counts_[at(rank)], MPI_DOUBLE, all_.data(), counts_.data(),
                 begins_.data(), MPI_DOUBLE, parallel::communicator());
  whole.resize(wholeSize());
  for (int i = 0; i < wholeSize(); ++i) whole[i] = all_[at(place_[at(i)])];
}

void RankShare::gatherArrays(const std::vector<double>& mine, std::vector<double>& all,
                             std::vector<int>& lengths) {
  lengths.assign(at(parallel::size()), 0);
  const int length = static_cast<int>(mine.size());
  MPI_Allgather(&length, 1, MPI_INT, lengths.data(), 1, MPI_INT, parallel::communicator());
  std::vector<int> begins(lengths.size(), 0);
  std::partial_sum(lengths.begin(), lengths.end() - 1, begins.begin() + 1);
  all.resize(at(begins.back() + lengths.back()));
  MPI_Allgatherv(mine.data(), length, MPI_DOUBLE, all.data(), lengths.data(), begins.data(),
                 MPI_DOUBLE, parallel::communicator());
}

}  // namespace tooljoint::transient
