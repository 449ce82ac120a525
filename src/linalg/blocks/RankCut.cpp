// SPDX-License-Identifier: BSD-3-Clause
#include "linalg/blocks/RankCut.hpp"

#include <algorithm>
#include <mpi.h>
#include <utility>

#include "common/Communicator.hpp"
#include "common/Index.hpp"
#include "common/Parallel.hpp"

namespace tooljoint::linalg {
namespace {

/// Numbers in a message besides those of the cut.
constexpr std::size_t mostNumbers = 16;

/// The larger value; keeps a NaN.
double larger(double a, double b) { return b <= a ? a : (a != a ? a : b); }

}  // namespace

RankCut::RankCut(int interior, std::vector<int> number, int total, std::vector<char> own)
    : ranks_(parallel::size()),
      rank_(parallel::rank()),
      interior_(interior),
      total_(total),
      number_(std::move(number)),
      own_(std::move(own)) {
  mine_.resize(std::max(mostNumbers, at(total)));
  all_.resize(at(ranks_) * mine_.size());
  whole_.resize(at(total));
}

/// mine_ of all ranks, one after the other.
const double* RankCut::gather(std::size_t count) const {
  ++messages_;
  if (all_.size() < at(ranks_) * count) all_.resize(at(ranks_) * count);
  MPI_Allgather(mine_.data(), static_cast<int>(count), MPI_DOUBLE, all_.data(),
                static_cast<int>(count), MPI_DOUBLE, parallel::communicator());
  return all_.data();
}

void RankCut::reduce(double* largest, int maxima, double* sums, int count) const {
  if (!isDivided()) return;
  const int length = maxima + count;
  if (mine_.size() < at(length)) mine_.resize(at(length));
  std::copy_n(largest, maxima, mine_.begin());
  std::copy_n(sums, count, mine_.begin() + maxima);
  const double* all = gather(at(length));
  for (int r = 0; r < ranks_; ++r, all += length) {
    for (int i = 0; i < maxima; ++i) largest[i] = r == 0 ? all[i] : larger(largest[i], all[i]);
    for (int i = 0; i < count; ++i) sums[i] = all[maxima + i] + (r == 0 ? 0.0 : sums[i]);
  }
}

double RankCut::largest(double value) const {
  reduce(&value, 1, nullptr, 0);
  return value;
}

double RankCut::sum(double value) const {
  reduce(nullptr, 0, &value, 1);
  return value;
}

bool RankCut::any(bool value) const {
  return isDivided() ? largest(value ? 1.0 : 0.0) > 0.0 : value;
}

double RankCut::before(double value) const {
  if (!isDivided()) return 0.0;
  mine_[0] = value;
  const double* all = gather(1);
  double sum = 0;
  for (int r = 0; r < rank_; ++r) sum += all[r];
  return sum;
}

std::string RankCut::ofLargest(double size, const std::string& text) const {
  if (!isDivided()) return text;
  mine_[0] = size;
  const double* all = gather(1);
  int root = 0;
  for (int r = 1; r < ranks_; ++r)
    if (all[r] > all[root] || (all[r] != all[r] && all[root] == all[root])) root = r;
  std::string result = text;
  parallel::broadcast(result, root);
  return result;
}

void RankCut::completeCut(double* cut) const {
  if (!isDivided()) return;
  whole_.assign(at(total_), 0.0);
  collect(cut - interior_, whole_.data());
  sumAll(whole_.data(), whole_.size());
  spread(whole_.data(), cut - interior_);
}

void RankCut::collect(const double* x, double* whole) const {
  for (std::size_t i = 0; i < number_.size(); ++i) whole[at(number_[i])] = x[at(interior_) + i];
}

void RankCut::spread(const double* whole, double* x) const {
  for (std::size_t i = 0; i < number_.size(); ++i) x[at(interior_) + i] = whole[at(number_[i])];
}

void RankCut::divide(double* x) const {
  for (std::size_t i = 0; i < own_.size(); ++i)
    if (own_[i] == 0) x[at(interior_) + i] = 0.0;
}

void RankCut::sumAll(double* values, std::size_t count) const {
  if (!isDivided()) return;
  if (mine_.size() < count) mine_.resize(count);
  std::copy_n(values, count, mine_.begin());
  const double* all = gather(count);
  std::copy_n(all, count, values);
  for (int r = 1; r < ranks_; ++r)
    for (std::size_t i = 0; i < count; ++i) values[i] += all[at(r) * count + i];
}

}  // namespace tooljoint::linalg
