// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Groups of ranks that work independently and take numbers from a common counter.
#pragma once

#include <functional>
#include <mpi.h>

namespace tooljoint::parallel {

class RankGroups {
 public:
  /// All ranks, in groups of this many (ranks 0 to ranksPerGroup - 1 are the first); 0 makes one
  /// group of all. Collective. UsageError unless ranksPerGroup divides the number of ranks.
  explicit RankGroups(int ranksPerGroup);
  ~RankGroups();
  RankGroups(const RankGroups&) = delete;
  RankGroups& operator=(const RankGroups&) = delete;

  int count() const { return count_; }
  /// Number of the group of this rank.
  int mine() const { return mine_; }
  /// Largest number of groups on one machine, minus one. The same on every rank.
  int beside() const { return beside_; }

  /// Runs `work` in every group separately; Parallel.hpp then uses only the ranks of the group.
  /// Collective. An Error in one of the groups is thrown on all ranks when all groups have ended.
  void apart(const std::function<void()>& work);
  /// Inside apart(): 0, 1, 2 ..., each number to exactly one of the groups; -1 when a group has
  /// failed. Collective in the group.
  int next();

 private:
  /// The value of this word of the window before the operation. Not collective.
  int fetch(int word, int value, MPI_Op operation) const;

  int count_ = 1, mine_ = 0, beside_ = 0;
  int dealt_ = 0;  ///< for a single group
  MPI_Comm group_ = MPI_COMM_NULL;
  MPI_Win shared_ = MPI_WIN_NULL;  ///< on the first rank: numbers taken, groups that have failed
};

/// Lets MPI answer other ranks during a long computation. Not collective.
void progress();

}  // namespace tooljoint::parallel
