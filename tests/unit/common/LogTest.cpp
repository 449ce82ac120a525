// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Lines of the log have at most 100 columns.
#include "common/report/Log.hpp"

#include <gtest/gtest.h>

#include "common/Parallel.hpp"

namespace LogTest {

using namespace tooljoint;

std::string printed(const std::string& line) {
  testing::internal::CaptureStdout();
  log::info(line);
  return testing::internal::GetCapturedStdout();
}

std::string repeated(const std::string& word, int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += word;
  return text;
}

TEST(Log, ShortLinesStayAsTheyAre) {
  if (parallel::rank() != 0) GTEST_SKIP() << "rank 0 prints";
  EXPECT_EQ(printed("static      done  "), "static      done  \n");
  EXPECT_EQ(printed("one\n\ntwo"), "one\n\ntwo\n");
  EXPECT_EQ(printed(std::string(100, 'a')), std::string(100, 'a') + "\n");
}

TEST(Log, LongLinesAreBrokenAtBlanksAndContinuedBehindTheLabel) {
  if (parallel::rank() != 0) GTEST_SKIP() << "rank 0 prints";
  // 12 columns of label, 22 words of 4 columns: 100 columns and the blank behind the last word
  EXPECT_EQ(printed("cost        " + repeated("abc ", 25)), "cost        " + repeated("abc ", 21) +
                                                                "abc\n" + repeated(" ", 12) +
                                                                repeated("abc ", 2) + "abc\n");
  EXPECT_EQ(printed("  yes wall  " + repeated("abc ", 23)).substr(99, 14),
            "\n" + repeated(" ", 12) + "a");
  // without a label, two columns further in
  const std::string text = printed("note: " + repeated("abcd ", 20));
  EXPECT_EQ(text.substr(0, 100), "note: " + repeated("abcd ", 18) + "abcd");
  EXPECT_EQ(text.substr(100), "\n  abcd\n");
}

TEST(Log, AWordThatIsLongerThanALineStaysWhole) {
  if (parallel::rank() != 0) GTEST_SKIP() << "rank 0 prints";
  const std::string path(120, 'p');
  EXPECT_EQ(printed("results     " + path + " basis.csv"),
            "results     " + path + "\n            basis.csv\n");
  EXPECT_EQ(printed(path), path + "\n");
}

}  // namespace LogTest
