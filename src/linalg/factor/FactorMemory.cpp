// SPDX-License-Identifier: BSD-3-Clause
#include "linalg/factor/FactorMemory.hpp"

#include <algorithm>
#include <fstream>
#include <malloc.h>
#include <string>
#include <sys/resource.h>
#include <unistd.h>

namespace tooljoint::linalg {
namespace {

constexpr long kilobyte = 1024, megabyte = 1024 * kilobyte;

std::optional<long> freeOfMachine() {
  std::ifstream in("/proc/meminfo");
  for (std::string word; in >> word;)
    if (word == "MemAvailable:") {
      long kilobytes = 0;
      in >> kilobytes;
      return kilobytes / kilobyte;
    }
  return {};
}

std::optional<long> freeAddresses() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return {};
  long pages = 0;
  if (!(std::ifstream("/proc/self/statm") >> pages)) return {};
  const long taken = pages * sysconf(_SC_PAGESIZE);
  return std::max(0L, static_cast<long>(limit.rlim_cur) - taken) / megabyte;
}

/// Free memory of the control group, version 2 as set by containers and job schedulers. Cached
/// files are released on demand and count as free.
std::optional<long> freeOfGroup() {
  const std::string group = "/sys/fs/cgroup/memory.";
  long most = 0, taken = 0, files = 0;
  if (!(std::ifstream(group + "max") >> most)) return {};  // "max": no limit
  if (!(std::ifstream(group + "current") >> taken)) return {};
  std::ifstream stat(group + "stat");
  for (std::string word; stat >> word;)
    if (word == "inactive_file") stat >> files;
  return std::max(0L, most - taken + files) / megabyte;
}

}  // namespace

std::optional<long> freeMegabytes() {
  malloc_trim(0);
  std::optional<long> least;
  for (const auto& free : {freeOfMachine(), freeAddresses(), freeOfGroup()})
    if (free) least = least ? std::min(*least, *free) : *free;
  return least;
}

void refuseMemory(Eigen::Index rows, long needed, std::optional<long> available, bool divided) {
  const bool known = available && *available < needed;
  throw MemoryError(
      "The factors of a matrix of " + std::to_string(rows) + " rows need " +
      std::to_string(needed) + " MB of memory" + (divided ? " on a rank" : "") +
      (known ? ", and " + std::to_string(*available) + " MB are free" : ", more than there is") +
      ". Cut the part into smaller ones, or use a machine with more.");
}

}  // namespace tooljoint::linalg
