// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The ranks that work together.
#pragma once

#include <mpi.h>

namespace tooljoint::parallel {

/// The ranks that work together now.
MPI_Comm communicator();

/// While it lives, Parallel.hpp works over the ranks of `comm` instead of MPI_COMM_WORLD; `comm` is
/// duplicated, so that messages of the caller keep apart. Scopes may be nested; made and destroyed
/// by all ranks of `comm`. Without MPI it does nothing.
class CommunicatorScope {
 public:
  explicit CommunicatorScope(MPI_Comm comm);
  ~CommunicatorScope();
  CommunicatorScope(const CommunicatorScope&) = delete;
  CommunicatorScope& operator=(const CommunicatorScope&) = delete;

 private:
  MPI_Comm before_, own_;
};

}  // namespace tooljoint::parallel
