// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Linear equations solved for some of their unknowns, sparse.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "common/Types.hpp"

namespace tooljoint::coupling {

/// sum_k entries[k].second y[entries[k].first] = value. Solved for the first unknown if that is
/// possible.
struct ConstraintRow {
  std::string
      name;  ///< how messages call it: `constraint "crank"`, `u of node 4 of parts "a" and "b"`
  std::vector<std::pair<int, double>> entries;
  double value = 0;
};

/// y[unknown] = value + sum_k rest[k].second y[rest[k].first]; no unknown that is solved for stands
/// in any `rest`.
struct SolvedRow {
  int unknown = 0;
  std::vector<std::pair<int, double>> rest;  ///< by increasing unknown
  double value = 0;
  int row = 0;  ///< the constraint it came with
};

struct Elimination {
  std::vector<SolvedRow> solved;       ///< in the order of the constraints
  std::vector<std::string> redundant;  ///< sentences: redundant constraints
};

/// Gauss-Jordan elimination, one constraint after the other. Of the unknowns of a row whose
/// coefficient is at least 1e-3 of the largest, one with the least `rank` is solved for; of
/// several, the one named first in the constraint. ModelError when constraints contradict each
/// other, naming them.
/// \param rank per unknown: lower ones are eliminated rather
Elimination eliminate(const std::vector<ConstraintRow>& rows, const std::vector<int>& rank);

}  // namespace tooljoint::coupling
