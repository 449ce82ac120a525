// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/part/MasterDofs.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <limits>
#include <set>
#include <utility>

#include "common/Index.hpp"
#include "common/report/StageTimes.hpp"

namespace tooljoint::reduction {

namespace {

/// Dense matrices are faster above this fraction of nonzero entries.
constexpr double denseFill = 0.2;
/// Number of pivots whose updates of the dense matrices are combined into matrix products.
constexpr Eigen::Index together = 48;

double ratioOf(double k, double m) { return m <= 0 ? std::numeric_limits<double>::max() : k / m; }

/// Dofs in the order of condensation, with their ratios made monotonic (increasing towards the
/// first).
struct Order {
  std::vector<int> dofs;
  std::vector<double> ratios;
  double bound = std::numeric_limits<double>::max();
  void add(int dof, double ratio) {
    bound = std::min(bound, ratio);
    dofs.push_back(dof);
    ratios.push_back(bound);
  }
};

/// The interior of a symmetric pair of matrices, condensed dof by dof, as sparse rows:
///
///     t_i = -k_ie / k_ee:  k_ij += k_ie t_j,  m_ij += t_i m_ej + m_ie t_j + t_i t_j m_ee
class SparseCondensation {
 public:
  struct Entry {
    int dof;
    double k, m;
  };
  using Row = std::vector<Entry>;

  SparseCondensation(const Sparse& K, const Sparse& M)
      : rows_(at(static_cast<int>(K.rows()))), left_(static_cast<int>(K.rows())) {
    for (int i = 0; i < K.rows(); ++i) {
      Row& row = rows_[at(i)];
      Sparse::InnerIterator k(K, i), m(M, i);
      while (k || m) {
        const int j =
            !m || (k && k.col() <= m.col()) ? static_cast<int>(k.col()) : static_cast<int>(m.col());
        row.push_back({j, 0, 0});
        if (k && k.col() == j) row.back().k = k.value(), ++k;
        if (m && m.col() == j) row.back().m = m.value(), ++m;
      }
      entries_ += static_cast<double>(row.size());
    }
  }

  bool filled() const {
    return entries_ > denseFill * static_cast<double>(left_) * static_cast<double>(left_);
  }
  const Row& row(int i) const { return rows_[at(i)]; }
  Entry diagonal(int i) const {
    const auto it = find(rows_[at(i)], i);
    return it != rows_[at(i)].end() && it->dof == i ? *it : Entry{i, 0, 0};
  }

  /// Returns the neighbours of e. A dof without positive stiffness is removed and changes nothing.
  std::vector<int> eliminate(int e) {
    const Row pivotRow = std::exchange(rows_[at(e)], {});
    --left_;
    entries_ -= static_cast<double>(pivotRow.size());
    const auto pivot =
        std::find_if(pivotRow.begin(), pivotRow.end(), [&](const Entry& x) { return x.dof == e; });
    const bool stands = pivot != pivotRow.end() && pivot->k > 0;
    std::vector<int> neighbours;
    for (const Entry& mine : pivotRow) {
      if (mine.dof == e) continue;
      neighbours.push_back(mine.dof);
      Row& old = rows_[at(mine.dof)];
      entries_ -= static_cast<double>(old.size());
      if (stands) {
        merge(old, pivotRow, *pivot, mine);
      } else {
        const auto it = find(old, e);
        if (it != old.end() && it->dof == e) old.erase(old.begin() + (it - old.begin()));
      }
      entries_ += static_cast<double>(old.size());
    }
    return neighbours;
  }

 private:
  static Row::const_iterator find(const Row& row, int dof) {
    return std::lower_bound(row.begin(), row.end(), dof,
                            [](const Entry& x, int d) { return x.dof < d; });
  }

  void merge(Row& old, const Row& pivotRow, const Entry& pivot, const Entry& mine) {
    const double ti = -mine.k / pivot.k;
    fresh_.clear();
    auto a = old.begin();
    for (const Entry& other : pivotRow) {
      if (other.dof == pivot.dof) continue;
      for (; a != old.end() && a->dof < other.dof; ++a)
        if (a->dof != pivot.dof) fresh_.push_back(*a);
      Entry sum = a != old.end() && a->dof == other.dof ? *a++ : Entry{other.dof, 0, 0};
      const double tj = -other.k / pivot.k;
      sum.k += mine.k * tj;
      sum.m += ti * other.m + mine.m * tj + ti * tj * pivot.m;
      fresh_.push_back(sum);
    }
    for (; a != old.end(); ++a)
      if (a->dof != pivot.dof) fresh_.push_back(*a);
    old = fresh_;
  }

  std::vector<Row> rows_;
  Row fresh_;
  int left_;
  double entries_ = 0;
};

/// The same with dense matrices. With y = m_e + (m_ee / 2) t an elimination is K -= k_e k_e' /
/// k_ee, M += t y' + y t'. Diagonals are always up to date, a row is updated when it becomes the
/// pivot, and the matrices after a number of pivots.
class DenseCondensation {
 public:
  DenseCondensation(const SparseCondensation& rows, std::vector<int> dofs)
      : dofs_(std::move(dofs)) {
    const auto n = static_cast<Eigen::Index>(dofs_.size());
    K_ = Matrix::Zero(n, n);
    M_ = Matrix::Zero(n, n);
    std::vector<int> place(
        dofs_.empty() ? 0 : at(*std::max_element(dofs_.begin(), dofs_.end())) + 1, -1);
    for (Eigen::Index i = 0; i < n; ++i) place[at(dofs_[at(i)])] = static_cast<int>(i);
    for (Eigen::Index i = 0; i < n; ++i)
      for (const auto& entry : rows.row(dofs_[at(i)]))
        if (at(entry.dof) < place.size() && place[at(entry.dof)] >= 0) {
          K_(i, place[at(entry.dof)]) = entry.k;
          M_(i, place[at(entry.dof)]) = entry.m;
        }
    compact();
  }

  void run(Order& order) {
    for (auto left = dofs_.size(); left > 0; --left) {
      Eigen::Index e = -1;
      double largest = 0;
      for (Eigen::Index i = 0; i < k_.size(); ++i) {
        if (!open_[at(i)]) continue;
        const double ratio = ratioOf(k_[i], m_[i]);
        if (e < 0 || ratio > largest || (ratio == largest && dof(i) > dof(e)))
          e = i, largest = ratio;
      }
      order.add(dof(e), largest);
      open_[at(e)] = 0;
      if (k_[e] > 0) eliminate(e);
      if (pending_ == together) update();
    }
  }

 private:
  int dof(Eigen::Index i) const { return dofs_[at(i)]; }

  void eliminate(Eigen::Index e) {
    const auto n = K_.rows();
    const auto A = A_.leftCols(pending_), T = T_.leftCols(pending_), Y = Y_.leftCols(pending_);
    Vector k = K_.col(e) - A * A.row(e).transpose();
    Vector m = M_.col(e) + T * Y.row(e).transpose() + Y * T.row(e).transpose();
    for (Eigen::Index i = 0; i < n; ++i)
      if (!open_[at(i)]) k[i] = m[i] = 0;
    const double pivot = k_[e];
    A_.col(pending_) = k / std::sqrt(pivot);
    T_.col(pending_) = -k / pivot;
    Y_.col(pending_) = m + 0.5 * m_[e] * T_.col(pending_);
    k_ -= A_.col(pending_).cwiseAbs2();
    m_ += 2.0 * T_.col(pending_).cwiseProduct(Y_.col(pending_));
    ++pending_;
  }

  /// Applies the pending updates and removes the condensed dofs.
  void update() {
    K_.noalias() -= A_ * A_.transpose();
    M_.noalias() += T_ * Y_.transpose();
    M_.noalias() += Y_ * T_.transpose();
    std::vector<Eigen::Index> keep;
    for (Eigen::Index i = 0; i < K_.rows(); ++i)
      if (open_[at(i)]) keep.push_back(i);
    std::vector<int> dofs;
    for (std::size_t j = 0; j < keep.size(); ++j) {
      const auto to = static_cast<Eigen::Index>(j);
      dofs.push_back(dof(keep[j]));
      for (std::size_t i = 0; i < keep.size();
           ++i) {  // keep[i] >= i: nothing is overwritten before it is read
        K_(static_cast<Eigen::Index>(i), to) = K_(keep[i], keep[j]);
        M_(static_cast<Eigen::Index>(i), to) = M_(keep[i], keep[j]);
      }
    }
    const auto n = static_cast<Eigen::Index>(keep.size());
    K_.conservativeResize(n, n);
    M_.conservativeResize(n, n);
    dofs_ = std::move(dofs);
    compact();
  }

  void compact() {
    const auto n = K_.rows();
    k_ = K_.diagonal();
    m_ = M_.diagonal();
    open_.assign(static_cast<std::size_t>(n), 1);
    A_ = Matrix::Zero(n, together);
    T_ = Matrix::Zero(n, together);
    Y_ = Matrix::Zero(n, together);
    pending_ = 0;
  }

  std::vector<int> dofs_;
  Matrix K_, M_;
  Vector k_, m_;            ///< diagonals, up to date
  std::vector<char> open_;  ///< not condensed yet
  Matrix A_, T_, Y_;        ///< pending updates, dofs x together
  Eigen::Index pending_ = 0;
};

}  // namespace

MasterRanking rankMasters(const PartView& part) {
  const Stage stage("choice of masters");
  const auto& interior = part.partition().interior;
  // Boundary dofs are never condensed, and their rows do not affect the others.
  SparseCondensation left(part.symmetricInteriorStiffness(), part.interiorMass());
  const auto ratio = [&](int i) {
    const auto entry = left.diagonal(i);
    return ratioOf(entry.k, entry.m);
  };
  std::set<std::pair<double, int>> queue;
  std::vector<double> current(interior.size());
  for (int i = 0; i < sizeOf(current); ++i) {
    current[at(i)] = ratio(i);
    queue.insert({current[at(i)], i});
  }
  Order order;
  while (!queue.empty() && !left.filled()) {
    const auto [largest, dof] = *queue.rbegin();
    queue.erase(std::prev(queue.end()));
    order.add(dof, largest);
    for (int i : left.eliminate(dof)) {
      queue.erase({current[at(i)], i});
      current[at(i)] = ratio(i);
      queue.insert({current[at(i)], i});
    }
  }
  std::vector<int> rest;
  for (const auto& candidate : queue) rest.push_back(candidate.second);
  std::sort(rest.begin(), rest.end());
  if (!rest.empty()) DenseCondensation(left, rest).run(order);

  MasterRanking ranking;
  for (auto it = order.dofs.rbegin(); it != order.dofs.rend(); ++it)
    ranking.positions.push_back(interior[at(*it)]);
  std::reverse(order.ratios.begin(), order.ratios.end());
  ranking.ratios = Eigen::Map<const Vector>(order.ratios.data(), sizeOf(order.ratios));
  return ranking;
}

}  // namespace tooljoint::reduction
