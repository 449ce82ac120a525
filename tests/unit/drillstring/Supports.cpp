// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drillstring/Supports.hpp"

#include <algorithm>
#include <gtest/gtest.h>

#include "tests/unit/drillstring/Decks.hpp"

namespace SupportsTest {

using namespace tooljoint;
using namespace tooljoint::drillstring;
using namespace tooljoint::drillstring::testing;

std::vector<char> held(const std::string& inside, int nodes) {
  deck::ListSpec spec("scene", "A scene.");
  spec.list(supportParameters());
  const deck::Deck deck =
      deck::Deck::parse(list("scene", list("Supports", inside)), "deck.xml", spec);
  return readSupports(deck.list().sublist("Supports")).held(nodes);
}

std::string faultOf(const std::string& inside) {
  try {
    held(inside, 4);
  } catch (const DeckError& error) {
    return error.what();
  }
  return "no error";
}

std::string row(const std::vector<char>& flags, int node) {
  std::string text;
  for (int c = 0; c < 6; ++c)
    text += flags[static_cast<std::size_t>(6 * (node - 1) + c)] != 0 ? '1' : '0';
  return text;
}

TEST(Supports, DefaultsHoldTheTopAndKeepTheBitOnTheAxis) {
  for (const auto& flags : {SupportSettings().held(163), held("", 163)}) {
    EXPECT_EQ(row(flags, 1), "111001");
    EXPECT_EQ(row(flags, 163), "110000");
    EXPECT_EQ(std::count(flags.begin(), flags.end(), 0), 972);  // free dofs of the reference scene
  }
}

TEST(Supports, ReadsDofsAtEndsAndNamedNodes) {
  const auto flags = held(text("Top", "all") + text("Bit", "none") +
                              list("clamp", whole("Node", 3) + text("Dofs", "u, theta_x w")),
                          4);
  EXPECT_EQ(row(flags, 1), "111111");
  EXPECT_EQ(row(flags, 2), "000000");
  EXPECT_EQ(row(flags, 3), "101100");
  EXPECT_EQ(row(flags, 4), "000000");
}

TEST(Supports, FamiliesThatAreNotModelledAreHeldEverywhere) {
  const std::string free = text("Top", "none") + text("Bit", "none");
  EXPECT_EQ(row(held(free + text("Dofs", "lateral"), 4), 2), "001001");
  EXPECT_EQ(row(held(free + text("Dofs", "axial"), 4), 2), "110111");
  EXPECT_EQ(row(held(free + text("Dofs", "torsional"), 4), 2), "111110");
  EXPECT_EQ(row(held(free + text("Dofs", "axial torsional"), 4), 2), "110110");
}

TEST(Supports, FaultsNameTheirPlace) {
  EXPECT_NE(faultOf(text("Top", "u v theta_zz"))
                .find("/scene/Supports/Top: \"theta_zz\" is not a degree of freedom. Did you mean "
                      "\"theta_z\"?"),
            std::string::npos);
  EXPECT_NE(faultOf(text("Dofs", "lateral axail")).find("Did you mean \"axial\"?"),
            std::string::npos);
  EXPECT_NE(faultOf(text("Dofs", "")).find("every family of dofs"), std::string::npos);
  EXPECT_NE(
      faultOf(list("guide", whole("Node", 9) + text("Dofs", "u")))
          .find("/scene/Supports/guide/Node: node 9 does not exist; the string has nodes 1 to 4."),
      std::string::npos);
}

}  // namespace SupportsTest
