// SPDX-License-Identifier: BSD-3-Clause
#include "deck/reading/FileName.hpp"

#include <Teuchos_ParameterList.hpp>
#include <gtest/gtest.h>

#include "deck/Deck.hpp"

namespace FileNameTest {

using namespace tooljoint;

std::string fileOf(const std::string& deck, const std::string& name) {
  deck::ListSpec spec("scene", "A scene.");
  spec.list(deck::ListSpec("Reduction", "Parts.")
                .list(deck::ListSpec("User Vectors", "Vectors.")
                          .text("File", deck::Required{}, "A file.")));
  const std::string text =
      "<ParameterList name=\"scene\">\n<ParameterList name=\"Reduction\">\n<ParameterList "
      "name=\"User Vectors\">\n<Parameter name=\"File\" type=\"string\" value=\"" +
      name + "\"/>\n</ParameterList>\n</ParameterList>\n</ParameterList>\n";
  const auto read = deck::Deck::parse(text, deck, spec);
  const Teuchos::ParameterList copy(read.list().sublist("Reduction").sublist("User Vectors"));
  return deck::fileName(copy, "File");
}

TEST(FileName, IsRelativeToTheDeck) {
  EXPECT_EQ(fileOf("scenes/one.xml", "vectors.mtx"), "scenes/vectors.mtx");
  EXPECT_EQ(fileOf("/home/scenes/one.xml", "data/vectors of %.mtx"),
            "/home/scenes/data/vectors of %.mtx");
  EXPECT_EQ(fileOf("one.xml", "vectors.mtx"), "vectors.mtx");
  EXPECT_EQ(fileOf("scenes/one.xml", "/data/vectors.mtx"), "/data/vectors.mtx");
}

TEST(FileName, OfAProgramsListStaysAsItIs) {
  Teuchos::ParameterList list("User Vectors");
  list.set("File", std::string("vectors.mtx"));
  EXPECT_EQ(deck::fileName(list, "File"), "vectors.mtx");
}

}  // namespace FileNameTest
