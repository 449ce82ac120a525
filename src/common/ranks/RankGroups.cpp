// SPDX-License-Identifier: BSD-3-Clause
#include "common/ranks/RankGroups.hpp"

#include <algorithm>
#include <exception>
#include <optional>
#include <string>
#include <vector>

#include "common/Communicator.hpp"
#include "common/Error.hpp"
#include "common/Parallel.hpp"

namespace tooljoint::parallel {
namespace {

/// Words of the window.
enum Word : int { dealt, failed, words };

/// Largest number of groups with a rank on the same machine.
int mostOnOneMachine(MPI_Comm all, int mine, int groups) {
  MPI_Comm machine = MPI_COMM_NULL;
  MPI_Comm_split_type(all, MPI_COMM_TYPE_SHARED, rank(), MPI_INFO_NULL, &machine);
  std::vector<int> here(static_cast<std::size_t>(groups), 0);
  here[static_cast<std::size_t>(mine)] = 1;
  MPI_Allreduce(MPI_IN_PLACE, here.data(), groups, MPI_INT, MPI_MAX, machine);
  MPI_Comm_free(&machine);
  return static_cast<int>(maximum(static_cast<double>(std::count(here.begin(), here.end(), 1))));
}

}  // namespace

RankGroups::RankGroups(int ranksPerGroup) {
  const int ranks = size(), width = ranksPerGroup == 0 ? ranks : ranksPerGroup;
  if (width < 0 || ranks % width != 0)
    throw UsageError("Groups of " + std::to_string(width) + " ranks cannot be made of " +
                     std::to_string(ranks) + ": the number of ranks must be a multiple.");
  if (width == ranks) return;
  count_ = ranks / width;
  mine_ = rank() / width;
  MPI_Comm_split(communicator(), mine_, rank(), &group_);
  beside_ = mostOnOneMachine(communicator(), mine_, count_) - 1;
  int* memory = nullptr;
  MPI_Win_allocate(rank() == 0 ? words * sizeof(int) : 0, sizeof(int), MPI_INFO_NULL,
                   communicator(), &memory, &shared_);
  MPI_Win_lock_all(0, shared_);
  if (rank() == 0) {
    std::fill_n(memory, static_cast<int>(words), 0);
    MPI_Win_sync(shared_);
  }
  MPI_Barrier(communicator());
}

RankGroups::~RankGroups() {
  if (group_ == MPI_COMM_NULL) return;
  MPI_Win_unlock_all(shared_);
  MPI_Win_free(&shared_);
  MPI_Comm_free(&group_);
}

int RankGroups::fetch(int word, int value, MPI_Op operation) const {
  int before = 0;
  MPI_Fetch_and_op(&value, &before, MPI_INT, 0, word, operation, shared_);
  MPI_Win_flush(0, shared_);
  return before;
}

int RankGroups::next() {
  if (group_ == MPI_COMM_NULL) return dealt_++;
  int number = -1;
  if (rank() == 0 && fetch(failed, 0, MPI_NO_OP) == 0) number = fetch(dealt, 1, MPI_SUM);
  broadcast(number);
  return number;
}

void RankGroups::apart(const std::function<void()>& work) {
  if (group_ == MPI_COMM_NULL) return work();
  std::exception_ptr error;
  {
    const CommunicatorScope scope(group_);
    try {
      work();
    } catch (...) {
      error = std::current_exception();
      fetch(failed, 1, MPI_SUM);
    }
  }
  agree([&] {
    if (error) std::rethrow_exception(error);
  });
}

void progress() {
  if (size() == 1 && communicator() == MPI_COMM_WORLD) return;
  int waiting = 0;
  MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, communicator(), &waiting, MPI_STATUS_IGNORE);
}

}  // namespace tooljoint::parallel
