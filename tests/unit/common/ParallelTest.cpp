// SPDX-License-Identifier: BSD-3-Clause
// True at any number of ranks.
#include "common/Parallel.hpp"

#include <gtest/gtest.h>
#include <stdexcept>

namespace ParallelTest {

using namespace tooljoint;

TEST(Parallel, RanksAreNumberedFromZero) {
  EXPECT_GE(parallel::rank(), 0);
  EXPECT_LT(parallel::rank(), parallel::size());
}

TEST(Parallel, BroadcastGivesEveryRankTheValueOfTheRoot) {
  const int last = parallel::size() - 1;
  const bool root = parallel::rank() == last;
  std::string text = root ? std::string("deck\0text", 9) : "something else that is longer";
  std::vector<double> reals = root ? std::vector<double>{1.5, -2.0} : std::vector<double>{};
  std::vector<int> wholes = root ? std::vector<int>{} : std::vector<int>{1, 2, 3};
  Vector vector = root ? Vector(Vector::LinSpaced(5, 0.0, 4.0)) : Vector();
  Matrix matrix = root ? Matrix(Matrix::Identity(2, 3)) : Matrix();
  int whole = root ? 7 : 0;
  double real = root ? 0.25 : 0.0;
  parallel::broadcast(text, last);
  parallel::broadcast(reals, last);
  parallel::broadcast(wholes, last);
  parallel::broadcast(vector, last);
  parallel::broadcast(matrix, last);
  parallel::broadcast(whole, last);
  parallel::broadcast(real, last);
  EXPECT_EQ(text, std::string("deck\0text", 9));
  EXPECT_EQ(reals, (std::vector<double>{1.5, -2.0}));
  EXPECT_TRUE(wholes.empty());
  EXPECT_EQ(vector, Vector(Vector::LinSpaced(5, 0.0, 4.0)));
  EXPECT_EQ(matrix, Matrix(Matrix::Identity(2, 3)));
  EXPECT_EQ(whole, 7);
  EXPECT_EQ(real, 0.25);
}

TEST(Parallel, SumAndMaximumGoOverTheRanks) {
  const double n = parallel::size();
  EXPECT_DOUBLE_EQ(parallel::sum(parallel::rank() + 1.0), 0.5 * n * (n + 1.0));
  EXPECT_DOUBLE_EQ(parallel::maximum(parallel::rank()), n - 1.0);
}

TEST(Agree, RunsTheWorkOnEveryRank) {
  int runs = 0;
  parallel::agree([&] { ++runs; });
  EXPECT_EQ(runs, 1);
}

TEST(Agree, AnErrorOnTheLastRankIsThrownOnAll) {
  const auto work = [] {
    if (parallel::rank() == parallel::size() - 1) throw ModelError("dof 7 floats.");
  };
  try {
    parallel::agree(work);
    ADD_FAILURE() << "nothing was thrown";
  } catch (const ModelError& error) {
    EXPECT_EQ(error.code(), ExitCode::ModelNotBuilt);
    EXPECT_STREQ(error.what(), "dof 7 floats.");
  }
}

TEST(Agree, OfSeveralErrorsTheLowestRankIsHeard) {
  try {
    parallel::agree([] { throw DeckError("said by rank " + std::to_string(parallel::rank())); });
    ADD_FAILURE() << "nothing was thrown";
  } catch (const DeckError& error) {
    EXPECT_STREQ(error.what(), "said by rank 0");
  }
}

TEST(Agree, KeepsTheKindOfEachError) {
  EXPECT_THROW(parallel::agree([] { throw UsageError("x"); }), UsageError);
  EXPECT_THROW(parallel::agree([] { throw DeckError("x"); }), DeckError);
  EXPECT_THROW(parallel::agree([] { throw ModelError("x"); }), ModelError);
  EXPECT_THROW(parallel::agree([] { throw ConvergenceError("x"); }), ConvergenceError);
  EXPECT_THROW(parallel::agree([] { throw FileError("x"); }), FileError);
  EXPECT_THROW(parallel::agree([] { throw InterruptedError("x"); }), InterruptedError);
}

TEST(Agree, AForeignExceptionIsAnInternalError) {
  try {
    parallel::agree([] { throw std::out_of_range("index 9"); });
    ADD_FAILURE() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::Internal);
    EXPECT_STREQ(error.what(), "index 9");
  }
}

}  // namespace ParallelTest
