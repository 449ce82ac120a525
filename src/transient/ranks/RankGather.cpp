// SPDX-License-Identifier: BSD-3-Clause
#include "transient/ranks/RankGather.hpp"

#include <mpi.h>
#include <numeric>

#include "common/Communicator.hpp"
#include "common/Index.hpp"
#include "common/Parallel.hpp"

namespace tooljoint::transient {

RankGather::RankGather(int size, const std::vector<int>& entries)
    : size_(size),
      count_(entries.size()),
      lengths_(at(parallel::size())),
      begins_(lengths_.size()) {
  const int count = sizeOf(entries);
  std::vector<int> counts(lengths_.size()), begins(lengths_.size());
  MPI_Gather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, 0, parallel::communicator());
  std::exclusive_scan(counts.begin(), counts.end(), begins.begin(), 0);
  std::vector<int> all(at(begins.back() + counts.back()));
  MPI_Gatherv(entries.data(), count, MPI_INT, all.data(), counts.data(), begins.data(), MPI_INT, 0,
              parallel::communicator());
  if (parallel::rank() != 0) return;
  for (std::size_t r = 0; r < counts.size(); ++r)
    ofRank_.emplace_back(all.begin() + begins[r], all.begin() + begins[r] + counts[r]);
}

double* RankGather::mine(std::size_t vectors) {
  mine_.resize(vectors * count_);
  return mine_.data();
}

void RankGather::gather(Vector* const* whole, std::size_t vectors) {
  for (std::size_t r = 0; r < ofRank_.size(); ++r)
    lengths_[r] = static_cast<int>(vectors * ofRank_[r].size());
  std::exclusive_scan(lengths_.begin(), lengths_.end(), begins_.begin(), 0);
  all_.resize(at(begins_.back() + lengths_.back()));
  MPI_Gatherv(mine_.data(), sizeOf(mine_), MPI_DOUBLE, all_.data(), lengths_.data(), begins_.data(),
              MPI_DOUBLE, 0, parallel::communicator());
  if (ofRank_.empty()) return;
  for (std::size_t k = 0; k < vectors; ++k) whole[k]->setZero(size_);
  const double* next = all_.data();
  for (const auto& entries : ofRank_)
    for (std::size_t k = 0; k < vectors; ++k)
      for (int entry : entries) (*whole[k])[entry] = *next++;
}

}  // namespace tooljoint::transient
