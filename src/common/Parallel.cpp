// SPDX-License-Identifier: BSD-3-Clause
#include "common/Parallel.hpp"

#include <algorithm>
#include <cstdint>
#include <mpi.h>

namespace tooljoint::parallel {
namespace {

bool active() {
  int initialised = 0;
  int finalised = 0;
  MPI_Initialized(&initialised);
  MPI_Finalized(&finalised);
  return initialised != 0 && finalised == 0;
}

bool alone() { return size() == 1; }

/// MPI counts are int: long data go in pieces.
void broadcastBytes(void* data, std::uint64_t bytes, int root) {
  constexpr std::uint64_t piece = 1U << 30U;
  auto* at = static_cast<char*>(data);
  for (std::uint64_t done = 0; done < bytes; done += piece) {
    MPI_Bcast(at + done, static_cast<int>(std::min(piece, bytes - done)), MPI_BYTE, root,
              MPI_COMM_WORLD);
  }
}

std::uint64_t broadcastCount(std::uint64_t count, int root) {
  MPI_Bcast(&count, 1, MPI_UINT64_T, root, MPI_COMM_WORLD);
  return count;
}

template <class Container>
void broadcastContainer(Container& value, int root) {
  if (alone()) return;
  value.resize(broadcastCount(value.size(), root));
  if (!value.empty()) broadcastBytes(&value[0], value.size() * sizeof(value[0]), root);
}

double reduce(double value, MPI_Op operation) {
  if (alone()) return value;
  double result = 0.0;
  MPI_Allreduce(&value, &result, 1, MPI_DOUBLE, operation, MPI_COMM_WORLD);
  return result;
}

}  // namespace

int rank() {
  if (!active()) return 0;
  int value = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &value);
  return value;
}

int size() {
  if (!active()) return 1;
  int value = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &value);
  return value;
}

void broadcast(std::string& value, int root) { broadcastContainer(value, root); }
void broadcast(std::vector<double>& value, int root) { broadcastContainer(value, root); }
void broadcast(std::vector<int>& value, int root) { broadcastContainer(value, root); }

void broadcast(Vector& value, int root) {
  if (alone()) return;
  value.resize(
      static_cast<Eigen::Index>(broadcastCount(static_cast<std::uint64_t>(value.size()), root)));
  broadcastBytes(value.data(), static_cast<std::uint64_t>(value.size()) * sizeof(double), root);
}

void broadcast(Matrix& value, int root) {
  if (alone()) return;
  const auto rows = broadcastCount(static_cast<std::uint64_t>(value.rows()), root);
  const auto cols = broadcastCount(static_cast<std::uint64_t>(value.cols()), root);
  value.resize(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(cols));
  broadcastBytes(value.data(), rows * cols * sizeof(double), root);
}

void broadcast(double& value, int root) {
  if (!alone()) MPI_Bcast(&value, 1, MPI_DOUBLE, root, MPI_COMM_WORLD);
}

void broadcast(int& value, int root) {
  if (!alone()) MPI_Bcast(&value, 1, MPI_INT, root, MPI_COMM_WORLD);
}

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
  MPI_Allreduce(&mine, &lowest, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
  if (lowest == ranks) return;
  broadcast(code, lowest);
  broadcast(sentence, lowest);
  throwError(static_cast<ExitCode>(code), sentence);
}

}  // namespace tooljoint::parallel
