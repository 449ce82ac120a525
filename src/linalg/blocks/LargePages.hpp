// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Allocator for arrays that are read from end to end in every step. They are aligned for vector
/// loads, and on large pages (2 MB, if the system provides them) once they exceed the caches, which
/// makes reading a fifth faster.
#pragma once

#include <cstdlib>
#include <new>
#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace tooljoint::linalg {

template <class T>
struct LargePages {
  using value_type = T;
  static constexpr std::size_t line = 64, page = std::size_t{2} << 20;

  LargePages() = default;
  template <class U>
  LargePages(const LargePages<U>&) {}

  T* allocate(std::size_t count) {
    const std::size_t bytes = count * sizeof(T);
    const std::size_t unit = bytes >= 2 * page ? page : line;
    const std::size_t whole = (bytes + unit - 1) / unit * unit;
    void* memory = std::aligned_alloc(unit, whole == 0 ? unit : whole);
    if (memory == nullptr) throw std::bad_alloc();
#if defined(__linux__) && defined(MADV_HUGEPAGE)
    if (unit == page)
      madvise(memory, whole, MADV_HUGEPAGE);  // advice only: without it the array is slower
#endif
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t) { std::free(memory); }

  friend bool operator==(const LargePages&, const LargePages&) { return true; }
  friend bool operator!=(const LargePages&, const LargePages&) { return false; }
};

/// Shared large pages for arrays too short to have their own. Later allocations of the process, up
/// to this many bytes, come from memory with large pages requested. It is only address space until
/// it is written (at most an eighth of a limit). Many vectors read one after the other are then
/// read a tenth faster. To be called at the start of a program, because memory that is already free
/// is not requested again. Does nothing for a few megabytes, without glibc, or if the heap cannot
/// grow. The default is enough for the vectors of a million dofs.
void shareLargePages(std::size_t bytes = std::size_t{1} << 30);

}  // namespace tooljoint::linalg
