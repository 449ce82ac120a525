// SPDX-License-Identifier: BSD-3-Clause
#include "linalg/blocks/DividedChain.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "common/Index.hpp"
#include "linalg/Deterministic.hpp"

namespace tooljoint::linalg {
namespace {

/// Nodes of one rank, and the positions of their rows: those between the cuts, then the cut to the
/// rank before, which is that one's last node, then the cut to the rank behind, its own last node.
class Positions {
 public:
  explicit Positions(const ChainShare& share) : first_(share.first()), rank_(share.rank()) {
    begin_ = share.begin(rank_);
    end_ = share.begin(rank_ + 1);
    if (rank_ + 1 < share.ranks()) --end_;
    isFirst_ = rank_ == 0, isLast_ = rank_ + 1 == share.ranks();
  }

  int interior() const { return row(end_) - row(begin_); }
  int before() const { return isFirst_ ? 0 : row(begin_) - row(begin_ - 1); }
  int behind() const { return isLast_ ? 0 : row(end_ + 1) - row(end_); }
  int size() const { return interior() + before() + behind(); }
  int firstInterior() const { return row(begin_); }
  /// -1 for a row that another rank holds.
  int of(int r) const {
    if (r >= row(begin_) && r < row(end_)) return r - row(begin_);
    if (!isFirst_ && r >= row(begin_ - 1) && r < row(begin_))
      return interior() + r - row(begin_ - 1);
    if (!isLast_ && r >= row(end_) && r < row(end_ + 1))
      return interior() + before() + r - row(end_);
    return -1;
  }
  /// Whether an entry of the matrix is this rank's: that between the cut nodes themselves is of the
  /// rank whose last node it is.
  bool owns(int r, int column) const {
    const int i = of(r), j = of(column);
    return i >= 0 && j >= 0 && !(isBefore(i) && isBefore(j));
  }
  std::vector<int> blockStarts() const {
    std::vector<int> starts;
    for (int node = begin_; node < end_; ++node) starts.push_back(row(node) - row(begin_));
    if (!isFirst_) starts.push_back(interior());
    if (!isLast_) starts.push_back(interior() + before());
    starts.push_back(size());
    return starts;
  }

 private:
  int row(int node) const { return first_[at(node)]; }
  bool isBefore(int position) const {
    return position >= interior() && position < interior() + before();
  }

  const std::vector<int>& first_;
  int rank_, begin_, end_;
  bool isFirst_, isLast_;
};

RankCut cutOf(const ChainShare& share, const Positions& positions) {
  std::vector<int> number;
  std::vector<char> own;
  int total = 0;
  for (int r = 0; r + 1 < share.ranks(); ++r) {
    const int node = share.begin(r + 1) - 1;
    const int width = share.first()[at(node + 1)] - share.first()[at(node)];
    if (r + 1 == share.rank() || r == share.rank())
      for (int i = 0; i < width; ++i) {
        number.push_back(total + i);
        own.push_back(r == share.rank());
      }
    total += width;
  }
  return {positions.interior(), std::move(number), total, std::move(own)};
}

}  // namespace

DividedChain::DividedChain(std::shared_ptr<const ChainShare> share, const Sparse& A)
    : share_(std::move(share)) {
  const Positions positions(*share_);
  interior_ = positions.interior();
  before_ = positions.before();
  behind_ = positions.behind();
  local_.resize(positions.size());
  BlockPartition partition;
  partition.start = positions.blockStarts();
  partition.position.resize(at(positions.size()));
  std::iota(partition.position.begin(), partition.position.end(), 0);
  partition.dof = partition.position;

  const auto around = share_->around();
  const auto forEachOwn = [&](const auto& visit) {
    for (int row = around.begin; row < around.end; ++row)
      for (int k = A.outerIndexPtr()[row]; k < A.outerIndexPtr()[row + 1]; ++k)
        if (positions.owns(row, A.innerIndexPtr()[k]))
          visit(positions.of(row), positions.of(A.innerIndexPtr()[k]), k);
  };
  Triplets ones;
  forEachOwn([&](int i, int j, int) { ones.emplace_back(i, j, 1.0); });
  Sparse pattern(positions.size(), positions.size());
  pattern.setFromTriplets(ones.begin(), ones.end());
  BlockPattern blocks(std::move(partition), {&pattern});
  blocks.divide(cutOf(*share_, positions));
  factor_ = BlockFactor(blocks);
  storage_ = blocks.storage() + factor_.fill();
  entries_.reserve(ones.size());
  forEachOwn([&](int i, int j, int k) { entries_.push_back({blocks.address(i, j), k}); });
}

bool DividedChain::factor(const Sparse& A, bool failed) {
  double* values = factor_.values();
  std::fill(values, values + storage_, 0.0);
  double zero = 0.0;  // not a number where an entry is none, or infinite
  for (const Entry& entry : entries_) {
    values[entry.address] = A.valuePtr()[entry.from];
    zero += 0.0 * values[entry.address];
  }
  if (failed || zero != 0.0) std::fill(values, values + storage_, NAN);
  return factor_.factor() < 0;
}

Matrix DividedChain::solve(const Matrix& b) const {
  Matrix x(b.rows(), b.cols());
  const auto own = share_->own();
  for (Eigen::Index j = 0; j < b.cols(); ++j) {
    local_.head(interior_) = b.col(j).segment(own.begin, interior_);
    local_.segment(interior_, before_).setZero();  // counted by the rank before
    local_.tail(behind_) = b.col(j).segment(own.begin + interior_, behind_);
    factor_.solve(local_.data());
    x.col(j).segment(own.begin, interior_) = local_.head(interior_);
    x.col(j).segment(own.begin + interior_, behind_) = local_.tail(behind_);
  }
  share_->gather(x.data(), static_cast<int>(x.cols()));
  return x;
}

Matrix DividedChain::multiply(const Sparse& A, const Matrix& x) const {
  Matrix y(x.rows(), x.cols());
  const auto own = share_->own();
  const int length = own.end - own.begin;
  for (Eigen::Index j = 0; j < x.cols(); ++j)
    y.col(j).segment(own.begin, length) = A.middleRows(own.begin, length) * x.col(j);
  share_->gather(y.data(), static_cast<int>(y.cols()));
  return y;
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
