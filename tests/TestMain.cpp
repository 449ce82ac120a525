// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// GoogleTest main for one or several ranks. Rank 0 prints the versions, its own log and, at the
/// end, the failures of the other ranks; the exit code is the worst of all ranks. A failed ASSERT_*
/// on one rank alone before a collective call would hang the others: use EXPECT_* in tests of
/// several ranks.
#include <Tpetra_Core.hpp>
#include <gtest/gtest.h>
#include <iostream>
#include <mpi.h>
#include <sstream>
#include <string>
#include <vector>

#include "common/Version.hpp"

namespace {

/// Keeps the text of the failures of this rank.
class FailureCollector : public ::testing::EmptyTestEventListener {
 public:
  const std::string& text() const { return text_; }

 private:
  void OnTestStart(const ::testing::TestInfo& test) override {
    test_ = std::string(test.test_suite_name()) + "." + test.name();
  }
  void OnTestEnd(const ::testing::TestInfo& /*test*/) override { test_ = "outside of a test"; }
  // GoogleTest holds its lock here: a request for the current test would wait forever.
  void OnTestPartResult(const ::testing::TestPartResult& result) override {
    if (!result.failed()) return;
    std::ostringstream entry;
    entry << (result.file_name() ? result.file_name() : "unknown file") << ":"
          << result.line_number() << ": " << test_ << "\n"
          << result.message() << "\n";
    text_ += entry.str();
  }

  std::string test_ = "outside of a test";
  std::string text_;
};

/// Prints on rank 0 the failures of the other ranks. Collective.
void printFailuresOfOthers(const std::string& mine, int rank, int ranks) {
  const int length = static_cast<int>(mine.size());
  std::vector<int> lengths(static_cast<std::size_t>(ranks));
  MPI_Gather(&length, 1, MPI_INT, lengths.data(), 1, MPI_INT, 0, MPI_COMM_WORLD);
  if (rank != 0) {
    if (length > 0) MPI_Send(mine.data(), length, MPI_CHAR, 0, 0, MPI_COMM_WORLD);
    return;
  }
  for (int other = 1; other < ranks; ++other) {
    std::string text(static_cast<std::size_t>(lengths[static_cast<std::size_t>(other)]), ' ');
    if (text.empty()) continue;
    MPI_Recv(text.data(), static_cast<int>(text.size()), MPI_CHAR, other, 0, MPI_COMM_WORLD,
             MPI_STATUS_IGNORE);
    std::cout << "\n[  FAILED  ] on rank " << other << " of " << ranks << ":\n"
              << text << std::flush;
  }
}

}  // namespace

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  const Tpetra::ScopeGuard scope(&argc, &argv);
  int rank = 0;
  int ranks = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);

  auto& listeners = ::testing::UnitTest::GetInstance()->listeners();
  auto* failures = new FailureCollector;  // owned by GoogleTest
  listeners.Append(failures);
  if (rank == 0)
    std::cout << tooljoint::versionText() << "ranks     " << ranks << "\n" << std::flush;
  else
    delete listeners.Release(listeners.default_result_printer());

  const int failed = RUN_ALL_TESTS();
  const int selected = ::testing::UnitTest::GetInstance()->test_to_run_count();
  printFailuresOfOthers(failures->text(), rank, ranks);
  int worst = 0;
  MPI_Allreduce(&failed, &worst, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  if (worst == 0 && selected == 0 && !::testing::GTEST_FLAG(list_tests)) {
    if (rank == 0) std::cerr << "No test was selected: an empty test program proves nothing.\n";
    return 1;
  }
  return worst;
}
