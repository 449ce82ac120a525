// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Tests over all decks ignore a user's own decks.
#include "tests/support/TrackedDecks.hpp"

#include <cstdlib>
#include <fstream>
#include <gtest/gtest.h>

#include "tests/support/SourceFolder.hpp"
#include "tests/unit/io/Scratch.hpp"

namespace TrackedDecksTest {

using namespace tooljoint;
using Names = std::vector<std::string>;

TEST(TrackedDecks, AreThoseGitKnowsAndWithoutGitAll) {
  const test::Scratch scratch;
  const std::string folder = scratch / "decks";
  std::filesystem::create_directories(folder + "/components");
  for (const char* name : {"theirs.xml", "own.xml", "notes.txt", "components/pipe.xml", "gone.xml"})
    std::ofstream(folder + "/" + name) << "<ParameterList/>";
  EXPECT_EQ(testing_::trackedDecks(folder), (Names{"gone.xml", "own.xml", "theirs.xml"}))
      << "git tracks nothing here";
  const std::string git = "git -C '" + folder + "' ";
  ASSERT_EQ(std::system((git + "init -q . && " + git +
                         "add theirs.xml notes.txt components/pipe.xml gone.xml")
                            .c_str()),
            0);
  std::filesystem::remove(folder + "/gone.xml");
  EXPECT_EQ(testing_::trackedDecks(folder), (Names{"theirs.xml"}));
}

TEST(TrackedDecks, OfTheProjectAreThere) {
  const auto names = testing_::trackedDecks(testing_::sourceFolder() + "/xml");
  EXPECT_EQ(std::count(names.begin(), names.end(), "helical_170m.xml"), 1);
  EXPECT_EQ(std::count(names.begin(), names.end(), "frame.xml"), 1);
}

}  // namespace TrackedDecksTest
