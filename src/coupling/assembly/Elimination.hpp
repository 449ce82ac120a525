// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Linear equations solved for some of their unknowns, sparse.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "common/Types.hpp"

namespace tooljoint::coupling {

/// sum_k entries[k].second y[entries[k].first] = value. Solved for the first unknown if possible.
struct ConstraintRow {
  std::string
      name;  ///< its name in messages: `constraint "crank"`, `u of node 4 of parts "a" and "b"`
  std::vector<std::pair<int, double>> entries;
  double value = 0;
};

/// y[unknown] = value + sum_k rest[k].second y[rest[k].first]; no `rest` contains a solved unknown.
struct SolvedRow {
  int unknown = 0;
  std::vector<std::pair<int, double>> rest;  ///< by increasing unknown
  double value = 0;
  int row = 0;  ///< index of its constraint
};

struct Elimination {
  std::vector<SolvedRow> solved;       ///< in the order of the constraints
  std::vector<std::string> redundant;  ///< sentences: redundant constraints
};

/// Gauss-Jordan elimination, one constraint after the other. A row is solved for an unknown with
/// the lowest `rank` among those whose coefficient is at least 1e-3 of the largest; among equal
/// ranks for the first one in the constraint. ModelError names constraints that contradict each
/// other. \param rank  per unknown: lower ones are eliminated first
Elimination eliminate(const std::vector<ConstraintRow>& rows, const std::vector<int>& rank);

}  // namespace tooljoint::coupling
