// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Lines of the log have at most 100 columns; warnings of many runs are printed once.
#include "common/report/Log.hpp"

#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "common/Parallel.hpp"
#include "common/Text.hpp"
#include "common/report/WarnOnce.hpp"

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

TEST(Log, WarningsAreWrappedInPrintAndWholeInTheCollection) {
  log::clearWarnings();
  std::string sentence = "The clearance is small at node";
  for (int node = 0; node < 30; ++node) sentence += " " + std::to_string(1000 + node);
  testing::internal::CaptureStderr();
  log::warn(sentence);
  const auto text = testing::internal::GetCapturedStderr();
  EXPECT_EQ(log::warnings(), std::vector<std::string>{sentence});
  log::clearWarnings();
  if (parallel::rank() != 0) GTEST_SKIP() << "rank 0 prints";
  const auto lines = split(text, '\n');
  ASSERT_EQ(lines.size(), 3U) << text;
  EXPECT_LE(lines[0].size(), 100U);
  EXPECT_EQ(lines[0].substr(0, 13), "warning: The ");
  EXPECT_EQ(lines[0] + lines[1].substr(1), "warning: " + sentence);
}

TEST(Log, WarningsOfManyRunsThatDifferInNumbersAreToldOnce) {
  log::clearWarnings();
  testing::internal::CaptureStderr();
  {
    const log::WarnOnce once;
    log::warn("The step (0.001 s) is coarse: 12 %.");
    log::warn("The step (0.001 s) is coarse: 12 %.");  // the same again does not count
    log::warn("The step (2.5e-3 s) is coarse: 8.1 %.");
    log::warn("A load is missing.");
    log::warn("The step (0.001 s) is coarse: -3 %.");
  }
  log::warn("The step (0.001 s) is coarse: 7 %.");  // outside, each is printed
  const auto text = testing::internal::GetCapturedStderr();
  const std::vector<std::string> expected{
      "The step (0.001 s) is coarse: 12 %. (2 further likewise)", "A load is missing.",
      "The step (0.001 s) is coarse: 7 %."};
  EXPECT_EQ(log::warnings(), expected);
  log::clearWarnings();
  if (parallel::rank() != 0) GTEST_SKIP() << "rank 0 prints";
  EXPECT_NE(text.find("warning: The step (0.001 s) is coarse: 12 %.\n"), std::string::npos);
  EXPECT_EQ(text.find("2.5e-3"), std::string::npos);
  EXPECT_NE(text.find("12 %. (2 further likewise)\n"), std::string::npos);
}

}  // namespace LogTest
