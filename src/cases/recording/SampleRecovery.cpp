// SPDX-License-Identifier: BSD-3-Clause
#include "cases/recording/SampleRecovery.hpp"

#include <algorithm>
#include <vector>

#include "common/Index.hpp"
#include "common/Parallel.hpp"

namespace tooljoint::cases {
namespace {

/// Some rows of a matrix.
Sparse rowsOf(const Sparse& matrix, const std::vector<int>& rows) {
  Triplets entries;
  for (std::size_t i = 0; i < rows.size(); ++i)
    forEachInRow(matrix, rows[i], [&](int column, double value) {
      entries.emplace_back(static_cast<int>(i), column, value);
    });
  return sparse(sizeOf(rows), matrix.cols(), entries);
}

/// Rows that are not empty.
std::vector<int> filledRows(const Sparse& matrix) {
  std::vector<int> rows;
  for (int row = 0; row < matrix.rows(); ++row)
    if (Sparse::InnerIterator(matrix, row)) rows.push_back(row);
  return rows;
}

}  // namespace

Sample SampleRecovery::recover(double t, const Vector& q, const Vector& qDot, const Vector& qDDot) {
  if (!recovery_) recovery_.emplace(model_.recovery);
  // D = offset + Phi q, D' = Phi q', D'' = Phi q''
  recovery_->multiply({&q, &qDot, &qDDot}, {&displacement_, &velocity_, &acceleration_});
  displacement_ += model_.recoveryOffset;
  return {t, q, qDot, displacement_, velocity_, acceleration_, states_};
}

SampleRecovery::Division::Division(const transient::RankShare& share)
    : rows(filledRows(share.model().recovery)),
      recovery(rowsOf(share.model().recovery, rows)),
      gather(static_cast<int>(share.model().recovery.rows()), rows) {}

std::optional<Sample> SampleRecovery::gather(const transient::SampleShare& mine) {
  if (!division_) division_ = std::make_unique<Division>(mine.share);
  mine.share.gather(mine.q, q_);
  mine.share.gather(mine.qDot, qDot_);
  // the rows of this rank of Phi q, Phi q', Phi q''
  auto& recovered = division_->recovered;
  division_->recovery.multiply({&mine.q, &mine.qDot, &mine.qDDot},
                               {&recovered[0], &recovered[1], &recovered[2]});
  double* next = division_->gather.mine(recovered.size());
  for (const Vector& x : recovered) next = std::copy(x.begin(), x.end(), next);
  division_->gather.gather<3>({&displacement_, &velocity_, &acceleration_});
  if (parallel::rank() != 0) return {};
  states_ = mine.states;
  displacement_ += model_.recoveryOffset;
  return Sample{mine.t, q_, qDot_, displacement_, velocity_, acceleration_, states_};
}

}  // namespace tooljoint::cases
