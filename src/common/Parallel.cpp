// SPDX-License-Identifier: BSD-3-Clause
#include "common/Parallel.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <iostream>
#include <mpi.h>
#include <string>
#include <thread>
#include <vector>

#include "common/Communicator.hpp"
#include "common/Message.hpp"
#include "common/report/Terminal.hpp"

namespace tooljoint::parallel {
namespace {

/// Time for which a failing rank waits for the others: they may still be writing results.
constexpr std::chrono::seconds patience{8};

/// The communicator in use.
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

/// Completes the messages of a failing rank. If the other ranks do not answer, only this rank has
/// failed, and all ranks end with this error.
void awaitOthers(std::vector<MPI_Request>& messages, ExitCode code, const std::string& sentence) {
  const auto start = std::chrono::steady_clock::now();
  for (int answered = 0; answered == 0;) {
    MPI_Testall(static_cast<int>(messages.size()), messages.data(), &answered, MPI_STATUSES_IGNORE);
    if (answered != 0) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    if (std::chrono::steady_clock::now() - start < patience) continue;
    std::cerr << terminal::wrapped("tooljoint: rank " + std::to_string(rank()) +
                                   " alone: " + sentence)
              << "\n"
              << "tooljoint: The other ranks did not fail with it; all are ended." << std::endl;
    MPI_Abort(world, static_cast<int>(code));
  }
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

/// MPI counts are int: long messages are sent in pieces.
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
  std::vector<MPI_Request> request(1);
  MPI_Iallreduce(&mine, &lowest, 1, MPI_INT, MPI_MIN, world, request.data());
  if (code != 0)
    awaitOthers(request, static_cast<ExitCode>(code), sentence);
  else
    MPI_Wait(request.data(), MPI_STATUS_IGNORE);
  if (lowest == ranks) return;
  broadcast(code, lowest);
  broadcast(sentence, lowest);
  throwError(static_cast<ExitCode>(code), sentence);
}

void meetFailing(ExitCode code, const std::string& sentence) {
  if (alone()) return;
  constexpr int tag = 32001;  // not used by other messages
  const int me = rank(), others = size() - 1;
  std::vector<MPI_Request> requests;
  for (int r = 0; r <= others; ++r) {
    if (r == me) continue;
    requests.emplace_back();
    MPI_Irecv(nullptr, 0, MPI_BYTE, r, tag, world, &requests.back());
    requests.emplace_back();
    MPI_Isend(nullptr, 0, MPI_BYTE, r, tag, world, &requests.back());
  }
  awaitOthers(requests, code, sentence);
}

}  // namespace tooljoint::parallel
