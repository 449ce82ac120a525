// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Parameters of MUMPS (Users' guide 5.5) and of its use here. Included only by sources of factors.
#pragma once

#include <dmumps_c.h>
#include <mpi.h>

namespace tooljoint::linalg::mumps {

/// Columns solved at once: enough for level-3 BLAS, little memory compared with the factors.
inline constexpr int blockOfColumns = 64;
/// Memory for pivoting in addition to the estimate of the analysis [%], at first and at most.
inline constexpr int firstRoom = 30, mostRoom = 500;

/// Jobs.
inline constexpr int initialise = -1, finish = -2, analyse = 1, decompose = 2, substitute = 3;
/// Errors (section 8).
inline constexpr int realRoom = -8, noRoom = -9, singular = -10, noMemory = -13, notDefinite = -40;

/// An instance of MUMPS that ends with its owner. Indices start at 1, as in the guide.
struct Instance {
  DMUMPS_STRUC_C id{};
  bool open = false;

  Instance() = default;
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;
  ~Instance() { close(); }

  int& control(int number) { return id.icntl[number - 1]; }
  int info(int number) const { return id.infog[number - 1]; }
  int status() const { return info(1); }

  void call(int job) {
    id.job = job;
    dmumps_c(&id);
  }

  /// A new instance without output, with the ordering that this MUMPS selects as best.
  /// \param kind SYM of the guide
  void begin(int kind, MPI_Comm comm) {
    close();
    id = {};
    id.par = 1;
    id.sym = kind;
    id.comm_fortran = static_cast<MUMPS_INT>(MPI_Comm_c2f(comm));
    call(initialise);
    open = true;
    for (const int stream : {1, 2, 3}) control(stream) = -1;
    control(4) = 0;
    control(7) = 7;
    control(14) = firstRoom;
    control(27) = blockOfColumns;
  }

  void close() {
    if (open) call(finish);
    open = false;
  }
};

}  // namespace tooljoint::linalg::mumps
