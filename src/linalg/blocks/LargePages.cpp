// SPDX-License-Identifier: BSD-3-Clause
#include "linalg/blocks/LargePages.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>
#if defined(__GLIBC__)
#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>
#endif

namespace tooljoint::linalg {

#if defined(__GLIBC__) && defined(MADV_HUGEPAGE)
void shareLargePages(std::size_t bytes) {
  constexpr std::size_t page = LargePages<char>::page;
  constexpr int usualPad = 128 * 1024;
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
    bytes = std::min<std::size_t>(bytes, limit.rlim_cur / 8);
  if (bytes < 2 * page) return;
  // Arrays of up to 32 MB (the largest possible setting) are placed in the heap, and memory freed
  // there stays in the heap.
  mallopt(M_MMAP_THRESHOLD, 16 * page);
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
  // The heap grows by the whole size at once, of which only the beginning has been written: the
  // kernel selects pages at the first write.
  mallopt(M_TOP_PAD,
          static_cast<int>(std::min<std::size_t>(bytes, std::numeric_limits<int>::max())));
  const auto end = [] { return reinterpret_cast<std::uintptr_t>(sbrk(0)); };
  const std::uintptr_t before = end();
  // Memory that is already free is taken first. If the heap does not grow (a limit, another
  // allocator), nothing is requested.
  std::vector<void*> held;
  for (std::size_t size = 0; size < bytes && end() == before; size += page) {
    held.push_back(std::malloc(page));
    if (held.back() == nullptr || reinterpret_cast<std::uintptr_t>(held.back()) >= before) break;
  }
  const std::uintptr_t begin = (before + page - 1) / page * page;
  if (begin < end())
    madvise(reinterpret_cast<void*>(begin), end() - begin, MADV_HUGEPAGE);  // advice
  for (void* each : held) std::free(each);
  mallopt(M_TOP_PAD, usualPad);
}
#else
void shareLargePages(std::size_t) {}
#endif

}  // namespace tooljoint::linalg
