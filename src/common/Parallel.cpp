// SPDX-License-Identifier: BSD-3-Clause
#include "common/Parallel.hpp"

#include <algorithm>
#include <cstdint>
#include <mpi.h>

#include "common/Communicator.hpp"
#include "common/Message.hpp"

namespace tooljoint::parallel {
namespace {

/// The ranks that work together.
MPI_Comm world = MPI_COMM_WORLD;

bool active() {
  int initialised = 0;
  int finalised = 0;
  MPI_Initialized(&initialised);
  MPI_Finalized(&finalised);
  return initialised != 0 && finalised == 0;
}

bool alone() { return size() == 1; }

double reduce(double value, MPI_Op operation) {
  if (alone()) return value;
  double result = 0.0;
  MPI_Allreduce(&value, &result, 1, MPI_DOUBLE, operation, world);
  return result;
}

}  // namespace

CommunicatorScope::CommunicatorScope(MPI_Comm comm) : before_(world), own_(MPI_COMM_NULL) {
  if (!active()) return;
  MPI_Comm_dup(comm, &own_);
  world = own_;
}

CommunicatorScope::~CommunicatorScope() {
  world = before_;
  if (own_ != MPI_COMM_NULL && active()) MPI_Comm_free(&own_);
}

MPI_Comm communicator() { return world; }

int rank() {
  if (!active()) return 0;
  int value = 0;
  MPI_Comm_rank(world, &value);
  return value;
}

int size() {
  if (!active()) return 1;
  int value = 1;
  MPI_Comm_size(world, &value);
  return value;
}

/// MPI counts are int: long messages go in pieces.
void broadcastBytes(std::string& bytes, int root) {
  constexpr std::size_t piece = 1U << 30U;
  std::uint64_t length = bytes.size();
  MPI_Bcast(&length, 1, MPI_UINT64_T, root, world);
  bytes.resize(length);
  for (std::size_t done = 0; done < bytes.size(); done += piece)
    MPI_Bcast(bytes.data() + done, static_cast<int>(std::min(piece, bytes.size() - done)), MPI_BYTE,
              root, world);
}

template void broadcast(std::string&, int);
template void broadcast(std::vector<double>&, int);
template void broadcast(std::vector<int>&, int);
template void broadcast(Vector&, int);
template void broadcast(Matrix&, int);
template void broadcast(double&, int);
template void broadcast(int&, int);

double sum(double value) { return reduce(value, MPI_SUM); }
double maximum(double value) { return reduce(value, MPI_MAX); }

void throwError(ExitCode code, const std::string& sentence) {
  switch (code) {
    case ExitCode::Usage:
      throw UsageError(sentence);
    case ExitCode::InvalidDeck:
      throw DeckError(sentence);
    case ExitCode::ModelNotBuilt:
      throw ModelError(sentence);
    case ExitCode::NotConverged:
      throw ConvergenceError(sentence);
    case ExitCode::Files:
      throw FileError(sentence);
    case ExitCode::Interrupted:
      throw InterruptedError(sentence);
    default:
      throw Error(code, sentence);
  }
}

void agree(const std::function<void()>& work) {
  int code = 0;
  std::string sentence;
  try {
    work();
  } catch (const Error& error) {
    code = static_cast<int>(error.code());
    sentence = error.what();
  } catch (const std::exception& error) {
    code = static_cast<int>(ExitCode::Internal);
    sentence = error.what();
  } catch (...) {
    code = static_cast<int>(ExitCode::Internal);
    sentence = "an exception of unknown type was thrown.";
  }
  if (alone()) {
    if (code != 0) throwError(static_cast<ExitCode>(code), sentence);
    return;
  }
  const int ranks = size();
  const int mine = code != 0 ? rank() : ranks;
  int lowest = ranks;
  MPI_Allreduce(&mine, &lowest, 1, MPI_INT, MPI_MIN, world);
  if (lowest == ranks) return;
  broadcast(code, lowest);
  broadcast(sentence, lowest);
  throwError(static_cast<ExitCode>(code), sentence);
}

}  // namespace tooljoint::parallel
