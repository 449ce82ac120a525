// SPDX-License-Identifier: BSD-3-Clause
// Faults that Teuchos 13.2 accepts silently (or reports without useful text): each must be refused
// here.
#include <Teuchos_XMLParameterListCoreHelpers.hpp>
#include <gtest/gtest.h>

#include "SmallScene.hpp"

namespace TeuchosFaultsTest {

using namespace tooljoint::deck;
using namespace tooljoint::deck::test;

std::string transientWith(const std::string& item) { return deckWith(stiffness, endTime + item); }

bool teuchosTakes(const std::string& text) {
  try {
    Teuchos::getParametersFromXmlString(text);
    return true;
  } catch (const std::exception&) {
    return false;
  }
}

struct Silent {
  std::string item, message;
  friend std::ostream& operator<<(std::ostream& out, const Silent& t) { return out << t.item; }
};
class SilentlyTaken : public ::testing::TestWithParam<Silent> {};

/// Teuchos alone reads the deck: only the strict pass detects the fault.
TEST_P(SilentlyTaken, ByTeuchosIsRefusedHere) {
  const std::string text = transientWith(GetParam().item);
  EXPECT_TRUE(teuchosTakes(text));
  const std::string fault = faultOf(text);
  EXPECT_NE(fault.find(GetParam().message), std::string::npos) << fault;
}

INSTANTIATE_TEST_SUITE_P(
    Table, SilentlyTaken,
    ::testing::Values(Silent{parameter("Step", "double", "12abc"), "\"abc\" is left over"},
                      Silent{parameter("Step", "double", "1,5"), "write a decimal point"},
                      Silent{parameter("Step", "double", ""), "is empty"},
                      Silent{parameter("Step", "double", "abc"), "is not a number"},
                      Silent{parameter("Step", "double", "nan"), "is not a finite number"},
                      Silent{parameter("Step", "double", "inf"), "is not a finite number"},
                      Silent{parameter("Samples", "int", "abc"), "is not a whole number"},
                      Silent{parameter("Samples", "int", "3.7"), "is not a whole number"},
                      Silent{parameter("Samples", "int", ""), "is empty"},
                      Silent{parameter("Weights", "Array(double)", "{1, 12abc}"),
                             "the entry \"12abc\" (number 2)"},
                      Silent{"<Parameter name=\"Step\" type=\"double\" value=\"0.1\" units=\"s\"/>",
                             "has the unknown attribute units=\"s\""},
                      Silent{
                          parameter("Step", "double", "0.1") + parameter("Step", "double", "0.2"),
                          "is given twice"},
                      Silent{parameter("Samples", "double", "2.5"), "must be type=\"int\""},
                      Silent{parameter("Samples", "string", "5"), "write type=\"int\" value=\"5\""},
                      Silent{parameter("Smooth", "bool", "yes"), "is not a bool: write \"true\""},
                      Silent{parameter("Smooth", "bool", "1"), "is not a bool: write \"true\""}));

struct Poor {
  std::string item, message;
  friend std::ostream& operator<<(std::ostream& out, const Poor& t) { return out << t.item; }
};
class PoorlyTold : public ::testing::TestWithParam<Poor> {};

/// Faults that Teuchos finds (some only with validators), reported here with line, path and
/// correction.
TEST_P(PoorlyTold, ByTeuchosHasLineAndPathHere) {
  const std::string fault = faultOf(transientWith(GetParam().item));
  EXPECT_EQ(fault.find("deck.xml:6: /well/Transient"), 0U) << fault;
  EXPECT_NE(fault.find(GetParam().message), std::string::npos) << fault;
}

INSTANTIATE_TEST_SUITE_P(
    Table, PoorlyTold,
    ::testing::Values(Poor{parameter("Stepp", "double", "0.1"), "Did you mean \"Step\"?"},
                      Poor{"<ParameterList name=\"Nox\"/>", "Did you mean \"NOX\"?"},
                      Poor{parameter("Step", "double", "5"), "it must be in (0, 1]"},
                      Poor{parameter("Step", "int", "1"), "write type=\"double\" value=\"1\""},
                      Poor{parameter("Step", "string", "0.1"), "has no unit"},
                      Poor{parameter("Fields", "Array(string)", "{U}"), "Did you mean \"u\"?"},
                      Poor{parameter("Smooth", "bool", "TRUEE"), "write \"true\" or \"false\""},
                      Poor{"<ParameterList name=\"NOX\"/><ParameterList name=\"NOX\"/>",
                           "is given twice; the first one is in line 6"},
                      Poor{"<Params name=\"NOX\"/>", "holds a <Params>"},
                      Poor{"<Parameter name=\"Step\" type=\"double\"/>", "has no value"}));

/// The root list's name is lost by Teuchos ("ANONYMOUS"); here it begins every path.
TEST(TeuchosFaults, TheSceneKeepsItsName) {
  EXPECT_EQ(parseSmall(transientWith("")).list().name(), "/well");
}

}  // namespace TeuchosFaultsTest
