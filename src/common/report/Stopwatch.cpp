// SPDX-License-Identifier: BSD-3-Clause
#include "common/report/Stopwatch.hpp"

#include <ctime>

namespace tooljoint {

double Stopwatch::processSeconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace tooljoint
