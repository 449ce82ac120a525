// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Communicator of the cooperating ranks.
#pragma once

#include <mpi.h>

namespace tooljoint::parallel {

/// The communicator in use.
MPI_Comm communicator();

/// During its lifetime Parallel.hpp uses the ranks of `comm` instead of MPI_COMM_WORLD. `comm` is
/// duplicated to separate its messages from those of the caller. Scopes may be nested; all ranks of
/// `comm` create and destroy them together. Without MPI it has no effect.
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
