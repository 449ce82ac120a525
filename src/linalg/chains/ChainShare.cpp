// SPDX-License-Identifier: BSD-3-Clause
#include "linalg/chains/ChainShare.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <mpi.h>
#include <utility>

#include "common/Communicator.hpp"
#include "common/Index.hpp"
#include "common/Parallel.hpp"

namespace tooljoint::linalg {
namespace {

/// Fewer nodes per rank are not worth a message.
constexpr int fewestNodes = 3;

}  // namespace

std::vector<int> firstRows(const std::vector<int>& nodeOf) {
  std::vector<int> first;
  for (int row = 0; row < sizeOf(nodeOf); ++row)
    if (row == 0 || nodeOf[at(row)] != nodeOf[at(row - 1)]) first.push_back(row);
  first.push_back(sizeOf(nodeOf));
  return first;
}

std::shared_ptr<const ChainShare> ChainShare::of(std::vector<int> first, int fewestRows) {
  const int ranks = parallel::size(), nodes = static_cast<int>(first.size()) - 1;
  if (ranks == 1 || nodes < fewestNodes * ranks || first.back() / ranks < fewestRows)
    return nullptr;
  std::shared_ptr<ChainShare> share(new ChainShare);
  share->rank_ = parallel::rank();
  share->first_ = std::move(first);
  for (long r = 0; r <= ranks; ++r) share->begin_.push_back(static_cast<int>(r * nodes / ranks));
  share->counts_.resize(at(ranks));
  share->places_.resize(at(ranks));
  return share;
}

RowRange ChainShare::rows(int beginNode, int endNode) const {
  return {first_[at(beginNode)], first_[at(endNode)]};
}

RowRange ChainShare::around() const {
  return rows(std::max(0, begin(rank_) - 1), std::min(begin(rank_ + 1) + 1, begin_.back()));
}

/// A message contains the rows of a rank, column by column, and a flag for failure.
bool ChainShare::gather(double* columns, int count, bool failed) const {
  int place = 0;
  for (int r = 0; r < ranks(); ++r) {
    const auto range = rows(begin(r), begin(r + 1));
    counts_[at(r)] = count * (range.end - range.begin) + 1;
    places_[at(r)] = place;
    place += counts_[at(r)];
  }
  mine_.resize(at(counts_[at(rank_)]));
  all_.resize(at(place));
  const auto mine = own();
  const int length = mine.end - mine.begin;
  for (int j = 0; j < count; ++j)
    std::copy_n(columns + at(j) * at(size()) + mine.begin, length, mine_.data() + at(j * length));
  mine_.back() = failed ? 1.0 : 0.0;
  MPI_Allgatherv(mine_.data(), counts_[at(rank_)], MPI_DOUBLE, all_.data(), counts_.data(),
                 places_.data(), MPI_DOUBLE, parallel::communicator());
  bool any = false;
  for (int r = 0; r < ranks(); ++r) {
    const auto range = rows(begin(r), begin(r + 1));
    const double* from = all_.data() + places_[at(r)];
    for (int j = 0; j < count; ++j, from += range.end - range.begin)
      if (r != rank_)
        std::copy_n(from, range.end - range.begin, columns + at(j) * at(size()) + range.begin);
    any = any || *from != 0.0;
  }
  return any;
}

void ChainShare::gatherEnds(double* columns, int count, int row) const {
  const int last = ranks() - 1;
  const std::array lengths{at(count * row), at(count * (size() - row))};
  mine_.clear();
  for (int j = 0; j < count && (rank_ == 0 || rank_ == last); ++j) {
    const double* column = columns + at(j) * at(size());
    mine_.insert(mine_.end(), column + (rank_ == 0 ? 0 : row),
                 column + (rank_ == 0 ? row : size()));
  }
  exchangeEnds(mine_, lengths, all_);
  for (int j = 0; j < count; ++j) {
    double* column = columns + at(j) * at(size());
    if (rank_ != 0) std::copy_n(all_.data() + at(j * row), row, column);
    if (rank_ != last)
      std::copy_n(all_.data() + lengths[0] + at(j * (size() - row)), size() - row, column + row);
  }
}

/// The data of a rank are followed by a flag for failure.
bool ChainShare::exchangeEnds(const std::vector<double>& mine, std::array<std::size_t, 2> lengths,
                              std::vector<double>& all, bool failed) const {
  std::fill(counts_.begin(), counts_.end(), 1);
  counts_.front() += static_cast<int>(lengths[0]);
  counts_.back() += static_cast<int>(lengths[1]);
  places_[0] = 0;
  for (std::size_t r = 1; r < counts_.size(); ++r) places_[r] = places_[r - 1] + counts_[r - 1];
  send_.assign(mine.begin(), mine.end());
  send_.push_back(failed ? 1.0 : 0.0);
  receive_.resize(at(places_.back() + counts_.back()));
  MPI_Allgatherv(send_.data(), counts_[at(rank_)], MPI_DOUBLE, receive_.data(), counts_.data(),
                 places_.data(), MPI_DOUBLE, parallel::communicator());
  bool any = false;
  for (std::size_t r = 0; r < counts_.size(); ++r)
    any = any || receive_[at(places_[r] + counts_[r] - 1)] != 0.0;
  all.assign(receive_.begin(), receive_.begin() + static_cast<std::ptrdiff_t>(lengths[0]));
  const auto second = receive_.begin() + places_.back();
  all.insert(all.end(), second, second + static_cast<std::ptrdiff_t>(lengths[1]));
  return any;
}

void ChainShare::gatherRows(Sparse& A) const {
  const int* start = A.outerIndexPtr();
  for (int r = 0; r < ranks(); ++r) {
    const auto range = rows(begin(r), begin(r + 1));
    places_[at(r)] = start[range.begin];
    counts_[at(r)] = start[range.end] - start[range.begin];
  }
  MPI_Allgatherv(MPI_IN_PLACE, 0, MPI_DATATYPE_NULL, A.valuePtr(), counts_.data(), places_.data(),
                 MPI_DOUBLE, parallel::communicator());
}

double ChainShare::largest(double value) const { return parallel::maximum(value); }

}  // namespace tooljoint::linalg
