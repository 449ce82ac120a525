// SPDX-License-Identifier: BSD-3-Clause
#include "linalg/chains/DividedChain.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "common/Index.hpp"
#include "linalg/Deterministic.hpp"

namespace tooljoint::linalg {

DividedChain::DividedChain(std::shared_ptr<const ChainShare> share, const Sparse& A)
    : share_(std::move(share)) {
  if (!ChainFactor::isChain(A)) return;
  chain_ = ChainFactor(A);
  if (!chain_.hasTwoSweeps()) return;
  auto sweeps = std::make_unique<BlockFactor::TwoSweeps>(chain_.blocks());
  // two ranks hold the rows of their sweeps without a message
  const int before = share_->first()[at(share_->begin(1))];
  if (share_->ranks() == 2 && sweeps->meetingBegin() != before) return;
  sweeps_ = std::move(sweeps);
}

int DividedChain::sweep() const {
  return share_->rank() == 0 ? 0 : share_->rank() + 1 == share_->ranks() ? 1 : -1;
}

bool DividedChain::factor(Sparse& A, bool failed) {
  if (share_->ranks() > 2) share_->gatherRows(A);
  const int mine = sweep(), rows = static_cast<int>(A.rows());
  if (mine >= 0) {
    chain_.fill(A, mine == 0 ? 0 : sweeps_->meetingBegin(),
                mine == 0 ? sweeps_->meetingEnd() : rows);
    sweeps_->keepMeeting();
    failed = !sweeps_->factorSweep(mine) || failed;
  } else {
    chain_.fill(A, sweeps_->meetingBegin(), sweeps_->meetingEnd());
    sweeps_->keepMeeting();
  }
  const auto lengths = std::array{sweeps_->factorsLength(0), sweeps_->factorsLength(1)};
  mine_.assign(mine < 0 ? 0 : lengths[at(mine)], 0.0);
  if (mine >= 0) sweeps_->copyFactors(mine, mine_.data());
  failed = share_->exchangeEnds(mine_, lengths, all_, failed);
  if (failed) return false;
  sweeps_->takeFactors(0, all_.data());
  sweeps_->takeFactors(1, all_.data() + lengths[0]);
  return sweeps_->factorMeeting();
}

Matrix DividedChain::solve(const Matrix& b) const {
  Matrix x = b;
  const int mine = sweep(), columns = static_cast<int>(b.cols());
  const auto lengths =
      std::array{at(columns * sweeps_->lastWidth(0)), at(columns * sweeps_->lastWidth(1))};
  mine_.clear();
  if (mine >= 0)
    for (int j = 0; j < columns; ++j) {
      sweeps_->down(mine, x.col(j).data());
      const double* last = x.col(j).data() + sweeps_->lastBegin(mine);
      mine_.insert(mine_.end(), last, last + sweeps_->lastWidth(mine));
    }
  share_->exchangeEnds(mine_, lengths, all_);
  const double* from = all_.data();
  for (int side = 0; side < 2; ++side)
    for (int j = 0; j < columns; ++j, from += sweeps_->lastWidth(side))
      std::copy_n(from, sweeps_->lastWidth(side), x.col(j).data() + sweeps_->lastBegin(side));
  for (int j = 0; j < columns; ++j) {
    sweeps_->meet(x.col(j).data());
    if (mine >= 0) sweeps_->up(mine, x.col(j).data());
  }
  share_->gatherEnds(x.data(), columns, sweeps_->meetingEnd());
  return x;
}

/// Row by row in four partial sums, as in Tpetra on one rank.
Matrix DividedChain::multiply(const Sparse& A, const Matrix& x) const {
  const auto own = share_->own();
  const int *start = A.outerIndexPtr(), *column = A.innerIndexPtr();
  const double* value = A.valuePtr();
  Matrix y(x.rows(), x.cols());
  for (Eigen::Index j = 0; j < x.cols(); ++j) {
    const double* from = x.col(j).data();
    double* to = y.col(j).data();
    for (int row = own.begin; row < own.end; ++row) {
      double sum[4] = {0.0, 0.0, 0.0, 0.0};
      int k = start[row];
      for (; k + 4 <= start[row + 1]; k += 4)
        for (int part = 0; part < 4; ++part) sum[part] += value[k + part] * from[column[k + part]];
      for (; k < start[row + 1]; ++k) sum[0] += value[k] * from[column[k]];
      to[row] = sum[0] + sum[1] + sum[2] + sum[3];
    }
  }
  share_->gather(y.data(), static_cast<int>(y.cols()));
  return y;
}

void DividedChain::multiplyOwn(const Sparse& A, const Matrix& x, Matrix& y) const {
  const auto own = share_->own();
  const int *start = A.outerIndexPtr(), *column = A.innerIndexPtr();
  const double* value = A.valuePtr();
  for (Eigen::Index j = 0; j < x.cols(); ++j) {
    const double* from = x.col(j).data();
    double* to = y.col(j).data();
    for (int row = own.begin; row < own.end; ++row) {
      double sum = 0.0;
      for (int k = start[row]; k < start[row + 1]; ++k) sum += value[k] * from[column[k]];
      to[row] = sum;
    }
  }
}

double DividedChain::resistance(const Sparse& A) const {
  const auto own = share_->own(), around = share_->around();
  const int length = own.end - own.begin;
  Vector rows = Vector::Zero(A.rows()), columns = rows;
  for (int row = around.begin; row < around.end; ++row)
    for (Sparse::InnerIterator it(A, row); it; ++it)
      columns[it.col()] = std::max(columns[it.col()], std::abs(it.value()));
  columns = columns.unaryExpr([](double m) { return m > 0.0 ? 1.0 / std::sqrt(m) : 1.0; });
  share_->gather(columns.data(), 1);
  for (int row = own.begin; row < own.end; ++row)
    for (Sparse::InnerIterator it(A, row); it; ++it)
      rows[row] = std::max(rows[row], std::abs(it.value()) * columns[it.col()]);
  rows = rows.unaryExpr([](double m) { return m > 0.0 ? 1.0 / m : 1.0; });
  share_->gather(rows.data(), 1);

  Vector y = scatteredNumbers(A.rows(), 1, 20200105);
  for (int k = 0; k < 2; ++k) {
    const Vector next = solve(y.cwiseQuotient(rows)).col(0).cwiseQuotient(columns);
    const double size = next.cwiseAbs().maxCoeff();
    if (!std::isfinite(size) || size == 0.0) break;
    y = next / size;
  }
  const Vector v = y.cwiseProduct(columns), scale = rows.segment(own.begin, length);
  const Sparse mine = A.middleRows(own.begin, length);
  const double reaction = share_->largest((mine * v).cwiseProduct(scale).cwiseAbs().maxCoeff());
  const double participants =
      share_->largest((mine.cwiseAbs() * v.cwiseAbs()).cwiseProduct(scale).maxCoeff());
  return participants > 0.0 ? reaction / participants : 0.0;
}

}  // namespace tooljoint::linalg
