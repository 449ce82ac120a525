// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Suggested commands for a deck run as printed.
#include "cases/run/DeckCommand.hpp"

#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "cases/CaseKinds.hpp"
#include "tests/support/SourceFolder.hpp"

namespace DeckCommandTest {

using namespace tooljoint;

const std::string source = testing_::sourceFolder();

std::string full(const std::string& deck, const std::vector<std::string>& overrides = {}) {
  return cases::fullModelSwitches(cases::readCase(source + deck, overrides)->deck());
}

TEST(DeckCommand, TellsTheOverrides) {
  const auto one =
      cases::readCase(source + "/tests/effects/scene.xml", {"!Mud", "Transient/End Time=0.2 s"});
  EXPECT_EQ(cases::overrideSwitches(one->deck()),
            " --without Mud --set 'Transient/End Time=0.2 s'");
}

TEST(DeckCommand, TakesSubstructuresOutWhereTheyAre) {
  const std::string scene = "/tests/effects/scene.xml";
  EXPECT_EQ(full(scene), " --without Reduction --without Substructures");
  EXPECT_EQ(full(scene, {"!Substructures"}), " --without Reduction --without Substructures");
  EXPECT_EQ(full("/xml/templates/parts.xml"), " --without Reduction");
}

TEST(DeckCommand, LeavesOutWhatNeedsTheReduction) {
  EXPECT_EQ(full("/tests/effects/scene.xml", {"Reduction/Mode Selection/Modes=5",
                                              "Transient/End Time=2", "Output/Export Parts=HDF5"}),
            " --without Reduction --without 'Output/Export Parts' --without Substructures --set "
            "'Transient/End Time=2'");
  EXPECT_EQ(full("/xml/templates/parts.xml", {"Coupling/Assembly=Dual"}),
            " --without Reduction --set Coupling/Assembly=Primal");
}

}  // namespace DeckCommandTest
