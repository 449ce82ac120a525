// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What a newcomer reads first.
#pragma once

namespace tooljoint::app {

/// What the program says without a command.
constexpr const char* firstWords =
    "Tooljoint: component mode synthesis, and the drillstring simulator built on it.\n\n"
    "Begin with a folder of your own:\n\n"
    "  tooljoint new my_well           a deck that runs, its survey and a README\n"
    "  cd my_well\n"
    "  tooljoint check my_well.xml     what is modelled\n"
    "  tooljoint run my_well.xml       static state and motion, into results/my_well\n"
    "  xdg-open results/my_well/report.html    figures, plots and the motion in a browser\n\n"
    "or with a deck to edit:\n\n"
    "  tooljoint template well > mine.xml\n\n"
    "tooljoint --help lists the commands, tooljoint COMMAND --help what each takes, and\n"
    "tooljoint doc the parameters of a deck.\n";

}  // namespace tooljoint::app
