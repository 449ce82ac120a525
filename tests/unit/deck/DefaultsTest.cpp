// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Objects made by a registry get the defaults of their parameters, also without a deck.
#include "deck/Defaults.hpp"

#include <Teuchos_ParameterList.hpp>
#include <gtest/gtest.h>

#include "common/Error.hpp"
#include "deck/Registry.hpp"

namespace DefaultsTest {

using namespace tooljoint;
using namespace tooljoint::deck;

struct Damper {
  double factor = 0;
  bool viscous = false;
  bool temperature = false;  ///< given
};
using Dampers = Registry<Damper, const Teuchos::ParameterList&>;

ListSpec parameters() {
  ListSpec list("Damper", "A damper.");
  list.real("Factor", "", 2.5, Range::positive(), "How much it damps.");
  list.choice("Law", std::string("Viscous"), {"Viscous", "Dry"}, "How it damps.");
  list.real("Temperature", "K", Optional{}, Range::positive(), "Where it damps.");
  return list;
}

const bool registered = Dampers::instance().add(
    "Damper", {"A damper.", parameters(), [](const Teuchos::ParameterList& list) {
                 auto damper = std::make_unique<Damper>();
                 damper->factor = list.get<double>("Factor");
                 damper->viscous = list.get<std::string>("Law") == "Viscous";
                 damper->temperature = list.isParameter("Temperature");
                 return damper;
               }});

TEST(Defaults, AreFilledInByTheRegistry) {
  ASSERT_TRUE(registered);
  const auto damper = Dampers::instance().make("Damper", Teuchos::ParameterList());
  EXPECT_EQ(damper->factor, 2.5);
  EXPECT_TRUE(damper->viscous);
  EXPECT_FALSE(damper->temperature) << "an optional parameter stays absent";
}

TEST(Defaults, LeaveWhatIsGiven) {
  Teuchos::ParameterList list;
  list.set("Factor", 4.0).set("Law", "Dry").set("Temperature", 300.0);
  const auto damper = Dampers::instance().make("Damper", list);
  EXPECT_EQ(damper->factor, 4.0);
  EXPECT_FALSE(damper->viscous);
  EXPECT_TRUE(damper->temperature);
}

TEST(Defaults, RefuseAnUnknownChoice) {
  Teuchos::ParameterList list;
  list.set("Law", "Wet");
  try {
    Dampers::instance().make("Damper", list);
    FAIL() << "an unknown choice was accepted";
  } catch (const DeckError& error) {
    EXPECT_NE(std::string(error.what()).find("\"Law\" is \"Wet\"; available: \"Viscous\""),
              std::string::npos)
        << error.what();
  }
}

}  // namespace DefaultsTest
