// SPDX-License-Identifier: BSD-3-Clause
#include "app/commands/Command.hpp"
#include "substructures/drillstring/analyses/bottom_hole/BottomHole.hpp"

namespace tooljoint::app {

namespace {

Action prepareBha(CLI::App& line) {
  return analysis(line, "states", [](const cases::Case& one, const std::string& out, bool fresh) {
    drillstring::reportBottomHole(stringOf(one, "a bottom-hole assembly"), out, fresh);
  });
}

const bool bhaRegistered =
    addCommand({Group::Analyses, "bha",
                "side force and tilt at the bit, contacts, bending and sag of a bottom-hole "
                "assembly against weight on bit, inclination and tool face",
                prepareBha});

}  // namespace

}  // namespace tooljoint::app
