// SPDX-License-Identifier: BSD-3-Clause
// Output and counters of a run: log, progress, interrupt flag, census, versions.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <gtest/gtest.h>
#include <thread>

#include "common/Interrupt.hpp"
#include "common/Parallel.hpp"
#include "common/Version.hpp"
#include "common/report/EvaluationCounters.hpp"
#include "common/report/Log.hpp"
#include "common/report/Progress.hpp"

namespace RunTest {

using namespace tooljoint;

std::size_t linesOf(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

TEST(Log, WarningsAreCollectedOnceEach) {
  log::clearWarnings();
  ::testing::internal::CaptureStderr();
  log::warn("the bit turns backwards");
  log::warn("the bit turns backwards");
  log::warn("the string is short");
  const std::string printed = ::testing::internal::GetCapturedStderr();
  EXPECT_EQ(log::warnings(),
            (std::vector<std::string>{"the bit turns backwards", "the string is short"}));
  EXPECT_EQ(printed, parallel::rank() == 0
                         ? "warning: the bit turns backwards\nwarning: the string is short\n"
                         : "");
  log::clearWarnings();
  EXPECT_TRUE(log::warnings().empty());
}

TEST(Log, QuietSilencesInfoOnly) {
  ::testing::internal::CaptureStdout();
  log::info("one");
  log::setQuiet(true);
  log::info("two");
  log::setQuiet(false);
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), parallel::rank() == 0 ? "one\n" : "");
}

TEST(Progress, PrintsALineForEachIntervalAwayFromATerminal) {
  using std::chrono::milliseconds;
  ::testing::internal::CaptureStderr();
  {
    Progress progress("transient", 20.0, 0.0, milliseconds(50));
    progress.update(1.0);
    std::this_thread::sleep_for(milliseconds(60));
    progress.update(5.0, "t");
    progress.update(6.0, "t");
    std::this_thread::sleep_for(milliseconds(60));
    progress.update(10.0, "t");
    progress.finish();
  }
  const std::string printed = ::testing::internal::GetCapturedStderr();
  if (parallel::rank() == 0) {
    EXPECT_EQ(linesOf(printed), 2U) << printed;
    EXPECT_EQ(printed.find("transient:  25 %"), 0U) << printed;
    EXPECT_NE(printed.find("\ntransient:  50 %"), std::string::npos) << printed;
  } else {
    EXPECT_EQ(printed, "");
  }
}

TEST(Progress, IsSilentInShortWork) {
  ::testing::internal::CaptureStderr();
  {
    Progress progress("transient", 20.0);
    for (int step = 0; step <= 1000; ++step) progress.update(0.02 * step, "t");
    progress.finish();
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST(Progress, CountsFromItsBegin) {
  ::testing::internal::CaptureStderr();
  Progress("restart", 20.0, 10.0, std::chrono::milliseconds(0)).update(15.0);
  const std::string printed = ::testing::internal::GetCapturedStderr();
  EXPECT_EQ(printed.find("restart:  50 %"), parallel::rank() == 0 ? 0U : std::string::npos);
}

TEST(Progress, ToleratesAnEmptySpanAndNonsense) {
  const std::chrono::milliseconds always(0);
  ::testing::internal::CaptureStderr();
  Progress empty("nothing", 0.0, 0.0, always);
  empty.update(0.0);
  Progress odd("odd", 1.0, 0.0, always);
  odd.update(std::nan(""));
  odd.update(-5.0);
  odd.update(7.0);
  odd.finish();
  odd.update(8.0);
  const std::string printed = ::testing::internal::GetCapturedStderr();
  EXPECT_EQ(linesOf(printed), parallel::rank() == 0 ? 4U : 0U) << printed;
  EXPECT_EQ(printed.find("nan"), std::string::npos) << printed;
}

TEST(Interrupt, ASignalSetsTheFlag) {
  requestInterrupt(false);
  EXPECT_FALSE(interruptRequested());
  const auto before = std::signal(SIGTERM, SIG_DFL);
  const auto beforeInt = std::signal(SIGINT, SIG_DFL);
  installInterruptHandlers();
  std::raise(SIGTERM);
  EXPECT_TRUE(interruptRequested());
  requestInterrupt(false);
  std::raise(SIGINT);
  EXPECT_TRUE(interruptRequested());
  requestInterrupt(false);
  std::signal(SIGTERM, before);
  std::signal(SIGINT, beforeInt);
}

TEST(EvaluationCounters, CountsByName) {
  resetEvaluationCounters();
  EXPECT_EQ(counted("mud matrices"), 0);
  count("mud matrices");
  count("mud matrices", 4);
  long& evaluations = counter("contact evaluations");
  ++evaluations;
  EXPECT_EQ(counted("mud matrices"), 5);
  EXPECT_EQ(evaluationCounters(),
            (std::map<std::string, long>{{"contact evaluations", 1}, {"mud matrices", 5}}));
  resetEvaluationCounters();
  EXPECT_TRUE(evaluationCounters().empty());
  ++evaluations;
  EXPECT_EQ(counted("contact evaluations"), 1);
  resetEvaluationCounters();
}

TEST(Version, NamesEverythingARunStandsOn) {
  EXPECT_EQ(trilinosVersion().substr(0, 3), "13.");
  EXPECT_EQ(hdf5Version().substr(0, 2), "1.");
  EXPECT_NE(mpiVersion(), "");
  EXPECT_EQ(mpiVersion().find('\n'), std::string::npos);
  EXPECT_NE(gitHash(), "");
  const std::string text = versionText();
  for (const std::string& version : {programVersion(), gitHash(), trilinosVersion(), mpiVersion(),
                                     hdf5Version(), blasLibrary()}) {
    EXPECT_NE(text.find(version), std::string::npos);
  }
  EXPECT_EQ(text.find("SUNDIALS  " + sundialsVersion() + "\n") != std::string::npos,
            !sundialsVersion().empty());
}

}  // namespace RunTest
