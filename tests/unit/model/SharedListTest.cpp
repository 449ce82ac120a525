// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Lists of models: copies share their elements, changes do not reach the copies.
#include "model/SharedList.hpp"

#include <gtest/gtest.h>
#include <string>

namespace SharedListTest {

using tooljoint::model::SharedList;
using Names = SharedList<std::string>;

TEST(SharedList, ReadsAsTheVectorItIsMadeFrom) {
  const Names names{"u", "v", "w"};
  const std::vector<std::string>& same = names;
  EXPECT_EQ(same, (std::vector<std::string>{"u", "v", "w"}));
  EXPECT_EQ(names.size(), 3u);
  EXPECT_EQ(names.front() + names[1] + names.back(), "uvw");
  EXPECT_EQ(std::string(names.begin()->c_str()) + *(names.end() - 1), "uw");
  EXPECT_THROW(names.at(3), std::out_of_range);
  EXPECT_TRUE(names == same);
  EXPECT_TRUE(names != Names());
}

TEST(SharedList, CopiesShareUntilOneIsChanged) {
  Names a{"u", "v"};
  Names b = a, c = a;
  EXPECT_EQ(&a.front(), &b.front()) << "no copy of the elements";
  b.push_back("w");
  c.own()[0] = "x";
  EXPECT_EQ(a, (Names{"u", "v"})) << "nobody else has changed";
  EXPECT_EQ(b, (Names{"u", "v", "w"}));
  EXPECT_EQ(c, (Names{"x", "v"}));
  const std::string* alone = &b.front();
  b.own().front() = "y";
  EXPECT_EQ(&b.front(), alone) << "elements nobody shares are changed in place";
  a.clear();
  EXPECT_EQ(c.size(), 2u);
}

TEST(SharedList, IsEmptyWhenMovedFromAndFillsAgain) {
  Names a{"u"};
  const Names b = std::move(a);
  EXPECT_EQ(b.size(), 1u);
  EXPECT_TRUE(a.empty());  // NOLINT(bugprone-use-after-move): the test is about this use
  Names none;
  EXPECT_TRUE(none.empty() && none.begin() == none.end() && none == a);
  none.push_back("v");
  EXPECT_TRUE(a.empty()) << "what is empty is not shared for writing";
  EXPECT_EQ(none.size(), 1u);
}

}  // namespace SharedListTest
