// SPDX-License-Identifier: BSD-3-Clause
#include "linalg/LargePages.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
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
  if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY) bytes = std::min<std::size_t>(bytes, limit.rlim_cur / 8);
  if (bytes < 2 * page) return;
  // Arrays of up to 32 MB (no more can be set) stand side by side in the heap, and what is given back to it stays there.
  mallopt(M_MMAP_THRESHOLD, 16 * page);
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
  // The heap grows by all of it at once, of which only the beginning has been written to: pages are chosen at the first write.
  mallopt(M_TOP_PAD, static_cast<int>(std::min<std::size_t>(bytes, std::numeric_limits<int>::max())));
  void* first = std::malloc(page);
  const auto begin = (reinterpret_cast<std::uintptr_t>(first) + page - 1) / page * page;
  const auto end = reinterpret_cast<std::uintptr_t>(sbrk(0));
  if (first != nullptr && begin < end) madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);  // a wish
  std::free(first);
  mallopt(M_TOP_PAD, usualPad);
}
#else
void shareLargePages(std::size_t) {}
#endif

}  // namespace tooljoint::linalg
