// SPDX-License-Identifier: BSD-3-Clause
#include "common/Interrupt.hpp"

#include <csignal>

#include "common/Error.hpp"

namespace tooljoint {
namespace {

volatile std::sig_atomic_t requested_ = 0;

extern "C" void onSignal(int number) {
  if (requested_ != 0 && number == SIGINT) {
    std::signal(number, SIG_DFL);
    std::raise(number);
    return;
  }
  requested_ = 1;
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
