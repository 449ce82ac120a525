// SPDX-License-Identifier: BSD-3-Clause
#include "response/Response.hpp"

#include "app/commands/Command.hpp"

namespace tooljoint::app {

namespace {

Action prepareResponse(CLI::App& line) { return analysis(line, "points", response::runResponse); }

const bool responseRegistered =
    addCommand({Group::Analyses, "response",
                "amplitude and phase under unbalance or harmonic loads, transfer functions (list "
                "Response)",
                prepareResponse});

}  // namespace

}  // namespace tooljoint::app
