// SPDX-License-Identifier: BSD-3-Clause
#include "coupling/assembly/Elimination.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "common/Error.hpp"
#include "common/Index.hpp"
#include "common/Text.hpp"

namespace tooljoint::coupling {

namespace {

/// A coefficient reduced by cancellation to this fraction of its terms is zero.
constexpr double rounding = 1e-11;
/// A pivot is at least this fraction of the largest coefficient of its row.
constexpr double smallestPivot = 1e-3;

/// A row during substitution: values, and the sum of the magnitudes of their terms.
struct Accumulator {
  struct Entry {
    double value = 0, size = 0;
  };
  std::map<int, Entry> entries;
  Entry right;
  std::set<int> origins;  ///< other constraints used

  void add(int unknown, double value) {
    Entry& e = entries[unknown];
    e.value += value;
    e.size += std::abs(value);
  }
  void addRight(double value) {
    right.value += value;
    right.size += std::abs(value);
  }
};

class Eliminator {
 public:
  Eliminator(const std::vector<ConstraintRow>& rows, const std::vector<int>& rank)
      : rows_(rows), rank_(rank), solvedBy_(rank.size(), -1), users_(rank.size()) {}

  Elimination run() {
    for (int r = 0; r < static_cast<int>(rows_.size()); ++r) take(r);
    return std::move(out_);
  }

 private:
  void take(int r) {
    const ConstraintRow& row = rows_[at(r)];
    Accumulator a;
    a.addRight(row.value);
    double size = 0;
    for (const auto& [unknown, factor] : row.entries) {
      size = std::max(size, std::abs(factor));
      put(unknown, factor, a);
    }
    for (auto it = a.entries.begin(); it != a.entries.end();)
      it = std::abs(it->second.value) <= rounding * std::max(it->second.size, size)
               ? a.entries.erase(it)
               : std::next(it);
    if (a.entries.empty()) {
      empty(row, a);
      return;
    }
    solve(r, pivot(row, a), a);
  }

  /// factor * y[unknown], expressed in unsolved unknowns.
  void put(int unknown, double factor, Accumulator& a) const {
    const int s = solvedBy_[at(unknown)];
    if (s < 0) {
      a.add(unknown, factor);
      return;
    }
    const SolvedRow& solved = out_.solved[at(s)];
    for (const auto& [other, coefficient] : solved.rest) a.add(other, factor * coefficient);
    a.addRight(-factor * solved.value);
    a.origins.insert(origins_[at(s)].begin(), origins_[at(s)].end());
  }

  /// Handles a row whose left side is zero: a redundant row, or a contradiction.
  void empty(const ConstraintRow& row, const Accumulator& a) {
    std::vector<std::string> others;
    for (int o : a.origins) others.push_back(rows_[at(o)].name);
    const std::string by = others.empty()      ? ""
                           : others.size() > 6 ? std::to_string(others.size()) + " others"
                                               : join(others, ", ");
    if (std::abs(a.right.value) > 1e-9 * std::max(a.right.size, 1e-300))
      throw ModelError("The " + row.name +
                       (by.empty() ? " has no dof in it" : " contradicts " + by) +
                       ": together they require 0 = " + formatNumber(a.right.value) +
                       ". Remove one of them, or change its value.");
    out_.redundant.push_back("The " + row.name +
                             (by.empty() ? " has no effect" : " follows from " + by) +
                             " and is ignored.");
  }

  int pivot(const ConstraintRow& row, const Accumulator& a) const {
    double largest = 0;
    for (const auto& [unknown, e] : a.entries) largest = std::max(largest, std::abs(e.value));
    int best = -1;
    for (const auto& [unknown, e] : a.entries) {
      if (std::abs(e.value) < smallestPivot * largest) continue;
      if (best < 0 || before(unknown, best, row)) best = unknown;
    }
    return best;
  }

  bool before(int a, int b, const ConstraintRow& row) const {
    if (rank_[at(a)] != rank_[at(b)]) return rank_[at(a)] < rank_[at(b)];
    const auto place = [&](int unknown) {
      return std::find_if(row.entries.begin(), row.entries.end(),
                          [&](const auto& e) { return e.first == unknown; }) -
             row.entries.begin();
    };
    if (place(a) != place(b)) return place(a) < place(b);
    return users_[at(a)].size() < users_[at(b)].size();
  }

  void solve(int r, int unknown, const Accumulator& a) {
    SolvedRow s;
    s.unknown = unknown;
    s.row = r;
    const double p = a.entries.at(unknown).value;
    for (const auto& [other, e] : a.entries)
      if (other != unknown) s.rest.emplace_back(other, -e.value / p);
    s.value = a.right.value / p;
    const int number = static_cast<int>(out_.solved.size());
    out_.solved.push_back(s);
    origins_.push_back(a.origins);
    origins_.back().insert(r);
    solvedBy_[at(unknown)] = number;
    const std::set<int> users = std::move(users_[at(unknown)]);
    users_[at(unknown)].clear();
    for (int user : users) replace(user, number);
    for (const auto& [other, coefficient] : s.rest) users_[at(other)].insert(number);
  }

  /// Inserts the newly solved unknown into an earlier row.
  void replace(int user, int number) {
    SolvedRow& s = out_.solved[at(user)];
    Accumulator a;
    for (const auto& [other, coefficient] : s.rest) {
      users_[at(other)].erase(user);
      put(other, coefficient, a);
    }
    s.rest.clear();
    for (const auto& [other, e] : a.entries) {
      if (std::abs(e.value) <= rounding * e.size) continue;
      s.rest.emplace_back(other, e.value);
      users_[at(other)].insert(user);
    }
    s.value -= a.right.value;
    origins_[at(user)].insert(origins_[at(number)].begin(), origins_[at(number)].end());
  }

  const std::vector<ConstraintRow>& rows_;
  const std::vector<int>& rank_;
  std::vector<int> solvedBy_;
  std::vector<std::set<int>> users_;  ///< per unknown: solved rows that contain it
  std::vector<std::set<int>> origins_;
  Elimination out_;
};

}  // namespace

Elimination eliminate(const std::vector<ConstraintRow>& rows, const std::vector<int>& rank) {
  return Eliminator(rows, rank).run();
}

}  // namespace tooljoint::coupling
