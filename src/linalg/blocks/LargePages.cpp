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
  // Arrays of up to 32 MB (no more can be set) stand side by side in the heap, and what is given
  // back to it stays there.
  mallopt(M_MMAP_THRESHOLD, 16 * page);
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
  // The heap grows by all of it at once, of which only the beginning has been written to: pages are
  // chosen at the first write.
  mallopt(M_TOP_PAD,
          static_cast<int>(std::min<std::size_t>(bytes, std::numeric_limits<int>::max())));
  const auto end = [] { return reinterpret_cast<std::uintptr_t>(sbrk(0)); };
  const std::uintptr_t before = end();
  // What was free already is taken first. Where the heap does not grow (a limit, another allocator)
  // nothing is requested.
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
