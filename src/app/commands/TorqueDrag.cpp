// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drillstring/analyses/TorqueDrag.hpp"

#include "app/commands/Command.hpp"

namespace tooljoint::app {

namespace {

Action prepareTorqueDrag(CLI::App& line) {
  return analysis(line, "depths", [](const cases::Case& one, const std::string& out, bool fresh) {
    drillstring::reportTorqueDrag(stringOf(one, "torque and drag"), out, fresh);
  });
}

const bool torqueDragRegistered = addCommand(
    {Group::Analyses, "torque-drag",
     "hook load, surface torque, buckling and yield margins against the depth of the bit",
     prepareTorqueDrag});

}  // namespace

}  // namespace tooljoint::app
