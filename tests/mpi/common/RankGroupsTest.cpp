// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Groups of ranks: their members, assignment of each number to one group, and errors of one rank
/// raised on all.
#include "common/ranks/RankGroups.hpp"

#include <gtest/gtest.h>
#include <numeric>
#include <string>
#include <vector>

#include "common/Error.hpp"
#include "common/Parallel.hpp"

namespace RankGroupsTest {

using namespace tooljoint;

TEST(RankGroups, ParallelIsAboutTheGroupInside) {
  const int ranks = parallel::size(), rank = parallel::rank();
  for (int width = 1; width <= ranks; width *= 2) {
    parallel::RankGroups groups(width);
    EXPECT_EQ(groups.count(), ranks / width);
    EXPECT_EQ(groups.mine(), groups.count() == 1 ? 0 : rank / width);
    EXPECT_EQ(groups.beside(), groups.count() - 1) << "all ranks of the test share a machine";
    int size = 0, mine = 0;
    double sum = 0;
    groups.apart([&] {
      size = parallel::size(), mine = parallel::rank();
      sum = parallel::sum(1.0 + groups.mine());
    });
    EXPECT_EQ(size, width);
    EXPECT_EQ(mine, rank % width);
    EXPECT_EQ(sum, width * (1.0 + groups.mine()));
    EXPECT_EQ(parallel::size(), ranks);
  }
}

TEST(RankGroups, EachNumberGoesToOneGroup) {
  constexpr int numbers = 200;
  parallel::RankGroups groups(1);
  std::vector<double> taken(numbers, 0.0);
  groups.apart([&] {
    for (int n = groups.next(); n < numbers; n = groups.next()) {
      EXPECT_GE(n, 0);
      taken[static_cast<std::size_t>(n)] += 1.0;
    }
  });
  for (double count : taken) EXPECT_EQ(parallel::sum(count), 1.0);
}

TEST(RankGroups, AnErrorOfOneGroupIsThatOfAll) {
  const int last = parallel::size() - 1;
  parallel::RankGroups groups(1);
  std::string said;
  try {
    groups.apart([&] {
      if (groups.mine() == last) throw ModelError("of the last group");
      while (parallel::size() == 1 && groups.next() >= 0) parallel::progress();
    });
  } catch (const ModelError& error) {
    said = error.what();
  }
  EXPECT_EQ(said, "of the last group") << "the others are given -1, and all end alike";
}

TEST(RankGroups, GroupsAreWhole) {
  EXPECT_THROW(parallel::RankGroups(parallel::size() + 1), UsageError);
}

}  // namespace RankGroupsTest
