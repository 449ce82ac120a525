// SPDX-License-Identifier: BSD-3-Clause
#include "common/Interrupt.hpp"

#include <csignal>
#include <ctime>

#include "common/Error.hpp"

namespace tooljoint {
namespace {

volatile std::sig_atomic_t requested_ = 0;

/// A SIGTERM sooner than this after the first signal is ignored: mpirun sends one in addition to
/// that of a terminal or a batch system.
constexpr double repeated = 1.0;  // [s]
timespec first_{};

double sinceFirst() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<double>(now.tv_sec - first_.tv_sec) +
         1e-9 * static_cast<double>(now.tv_nsec - first_.tv_nsec);
}

extern "C" void onSignal(int number) {
  if (requested_ == 0) {
    clock_gettime(CLOCK_MONOTONIC, &first_);
    requested_ = 1;
  } else if (number == SIGINT || (number == SIGTERM && sinceFirst() > repeated)) {
    std::signal(number, SIG_DFL);
    std::raise(number);
  }
}

}  // namespace

void installInterruptHandlers() {
  struct sigaction action = {};
  action.sa_handler = onSignal;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  struct sigaction before = {};
  sigaction(SIGHUP, nullptr, &before);  // ignored under nohup
  if (before.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);
  std::signal(SIGXFSZ, SIG_IGN);  // write() then fails with EFBIG
}

bool interruptRequested() { return requested_ != 0; }

void stopIfInterrupted() {
  if (interruptRequested())
    throw InterruptedError("Interrupted before there were results to keep.");
}

void requestInterrupt(bool requested) { requested_ = requested ? 1 : 0; }

}  // namespace tooljoint
