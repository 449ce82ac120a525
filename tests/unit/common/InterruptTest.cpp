// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Effect of signals on a program that handles them.
#include "common/Interrupt.hpp"

#include <chrono>
#include <csignal>
#include <gtest/gtest.h>
#include <thread>

namespace InterruptTest {

using namespace tooljoint;

/// The first SIGTERM sets the flag, one immediately after it is ignored, and a later one ends a
/// program that does not check the flag.
TEST(InterruptDeathTest, ALaterTermEndsTheProgram) {
  EXPECT_EXIT(
      {
        installInterruptHandlers();
        std::raise(SIGTERM);
        std::raise(SIGTERM);
        if (!interruptRequested()) std::exit(1);
        std::this_thread::sleep_for(std::chrono::milliseconds(1050));
        std::raise(SIGTERM);
        std::exit(2);
      },
      testing::KilledBySignal(SIGTERM), "");
}

}  // namespace InterruptTest
