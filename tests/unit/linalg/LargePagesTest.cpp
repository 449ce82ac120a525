// SPDX-License-Identifier: BSD-3-Clause
#include "linalg/blocks/LargePages.hpp"

#include <gtest/gtest.h>
#if defined(__GLIBC__)
#include <malloc.h>
#endif
#include <cstdint>
#include <fstream>
#include <sstream>
#include <string>
#include <unistd.h>
#include <vector>

namespace tooljoint::linalg {
namespace LargePagesTest {

/// Whether the mapping that holds an address asks for large pages ("hg" among its flags).
bool asksForLargePages(const void* address) {
  const auto at = reinterpret_cast<std::uintptr_t>(address);
  std::ifstream maps("/proc/self/smaps");
  bool inside = false;
  for (std::string line; std::getline(maps, line);) {
    std::istringstream words(line);
    std::uintptr_t begin = 0, end = 0;
    char dash = 0;
    if (words >> std::hex >> begin >> dash >> end && dash == '-') inside = begin <= at && at < end;
    if (inside && line.rfind("VmFlags:", 0) == 0) return line.find(" hg") != std::string::npos;
  }
  return false;
}

/// For less than two large pages the allocator does not change, and a long array gets its own
/// mapping.
TEST(LargePages, LeaveTheAllocatorAloneForALittle) {
#if !defined(__GLIBC__) || defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "another allocator";
#else
  const char* heap = static_cast<char*>(sbrk(0));
  ASSERT_EQ(mallopt(M_MMAP_THRESHOLD, 128 * 1024), 1);  // the default of glibc
  shareLargePages(0);
  shareLargePages(2 * LargePages<char>::page - 1);
  EXPECT_EQ(static_cast<char*>(sbrk(0)), heap);
  const std::vector<char> array(std::size_t{24} << 20);
  EXPECT_GE(array.data(), static_cast<char*>(sbrk(0)));
#endif
}

TEST(LargePages, AreAskedForByWhatTheHeapGrowsBy) {
  if (!std::ifstream("/sys/kernel/mm/transparent_hugepage/enabled"))
    GTEST_SKIP() << "a kernel without large pages";
#if !defined(__GLIBC__) || defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "another allocator";
#endif
  malloc_trim(0);  // what earlier tests left at the end of the heap would be used first
  const char* before = static_cast<char*>(sbrk(0));
  constexpr std::size_t bytes = std::size_t{16} << 20, page = LargePages<char>::page;
  shareLargePages(bytes);
  const char* end = static_cast<char*>(sbrk(0));
  ASSERT_GE(static_cast<std::size_t>(end - before), bytes);
  EXPECT_TRUE(asksForLargePages(before + page));
  EXPECT_TRUE(asksForLargePages(end - page));
}

TEST(LargePages, AlignLongArrays) {
  for (const std::size_t bytes : {std::size_t{1}, std::size_t{5} << 20}) {
    std::vector<char, LargePages<char>> array(bytes, 1);
    const std::size_t unit =
        bytes > LargePages<char>::page ? LargePages<char>::page : LargePages<char>::line;
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(array.data()) % unit, 0u);
  }
}

}  // namespace LargePagesTest
}  // namespace tooljoint::linalg
