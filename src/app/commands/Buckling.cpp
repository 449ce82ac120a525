// SPDX-License-Identifier: BSD-3-Clause
#include "app/commands/Command.hpp"
#include "substructures/drillstring/buckling/BucklingPath.hpp"

namespace tooljoint::app {

namespace {

Action prepareBuckling(CLI::App& line) {
  return analysis(line, "path", [](const cases::Case& one, const std::string& out, bool fresh) {
    drillstring::reportBuckling(stringOf(one, "buckling"), out, fresh);
  });
}

const bool bucklingRegistered =
    addCommand({Group::Analyses, "buckling",
                "static states under a growing weight on bit, past buckling into the bore, beside "
                "theory (list Buckling)",
                prepareBuckling});

}  // namespace

}  // namespace tooljoint::app
