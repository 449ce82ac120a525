// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/MasterDofs.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <utility>

namespace tooljoint::reduction {

namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// Rows of a symmetric pair of matrices that is condensed dof by dof.
class Condensation {
 public:
  Condensation(const Sparse& K, const Sparse& M) : rows_(at(static_cast<int>(K.rows()))) {
    for (int i = 0; i < K.outerSize(); ++i) {
      for (Sparse::InnerIterator it(K, i); it; ++it) rows_[at(i)][static_cast<int>(it.col())].k += it.value();
      for (Sparse::InnerIterator it(M, i); it; ++it) rows_[at(i)][static_cast<int>(it.col())].m += it.value();
    }
  }

  double ratio(int i) {
    const Entry& entry = rows_[at(i)][i];
    if (entry.m <= 0) return std::numeric_limits<double>::max();
    return entry.k / entry.m;
  }
  bool stands(int i) { return rows_[at(i)][i].k > 0; }

  /// t_i = -k_ie / k_ee:  k_ij += k_ie t_j,  m_ij += t_i m_ej + m_ie t_j + t_i t_j m_ee. Returns the neighbours of e.
  std::vector<int> eliminate(int e) {
    const std::map<int, Entry> row = std::move(rows_[at(e)]);
    const Entry pivot = row.at(e);
    std::vector<int> neighbours;
    for (const auto& [i, left] : row) {
      if (i == e) continue;
      neighbours.push_back(i);
      rows_[at(i)].erase(e);
      const double ti = -left.k / pivot.k;
      for (const auto& [j, right] : row) {
        if (j == e) continue;
        const double tj = -right.k / pivot.k;
        Entry& entry = rows_[at(i)][j];
        entry.k += left.k * tj;
        entry.m += ti * right.m + left.m * tj + ti * tj * pivot.m;
      }
    }
    return neighbours;
  }

 private:
  struct Entry {
    double k = 0, m = 0;
  };
  std::vector<std::map<int, Entry>> rows_;
};

}  // namespace

MasterRanking rankMasters(const model::Substructure& part, const Partition& p, const Sparse& symmetricK) {
  Condensation left(symmetricK, part.model.mass);
  using Candidate = std::pair<double, int>;
  std::set<Candidate> queue;
  std::map<int, double> current;
  for (int i : p.interior) {
    current[i] = left.ratio(i);
    queue.insert({current[i], i});
  }
  MasterRanking ranking;
  std::vector<double> ratios;
  double bound = std::numeric_limits<double>::max();
  while (!queue.empty()) {
    const auto [ratio, dof] = *queue.rbegin();
    queue.erase(std::prev(queue.end()));
    current.erase(dof);
    bound = std::min(bound, ratio);
    ranking.positions.push_back(dof);
    ratios.push_back(bound);
    if (!left.stands(dof)) continue;
    for (int i : left.eliminate(dof)) {
      const auto it = current.find(i);
      if (it == current.end()) continue;
      queue.erase({it->second, i});
      it->second = left.ratio(i);
      queue.insert({it->second, i});
    }
  }
  std::reverse(ranking.positions.begin(), ranking.positions.end());
  std::reverse(ratios.begin(), ratios.end());
  ranking.ratios = Eigen::Map<const Vector>(ratios.data(), static_cast<Eigen::Index>(ratios.size()));
  return ranking;
}

}  // namespace tooljoint::reduction
