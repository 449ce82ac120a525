// SPDX-License-Identifier: BSD-3-Clause
#include "response/campbell/Campbell.hpp"

#include "app/commands/Command.hpp"

namespace tooljoint::app {

namespace {

Action prepareCampbell(CLI::App& line) { return analysis(line, "speeds", response::runCampbell); }

const bool campbellRegistered =
    addCommand({Group::Analyses, "campbell",
                "damped modes against the rotary speed, and critical speeds (list Campbell)",
                prepareCampbell});

}  // namespace

}  // namespace tooljoint::app
