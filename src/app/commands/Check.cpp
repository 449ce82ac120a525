// SPDX-License-Identifier: BSD-3-Clause
#include "app/commands/Command.hpp"
#include "cases/CaseCheck.hpp"

namespace tooljoint::app {

namespace {

struct CheckOptions : DeckOptions {
  bool cost = false;
};

Action prepareCheck(CLI::App& line) {
  auto options = std::make_shared<CheckOptions>();
  addDeckOptions(line, *options, Output::None);
  line.add_flag("--cost", options->cost,
                "compute static state and reduction too, and predict which model is faster");
  return [options] { cases::check(*readCase(*options), options->cost); };
}

const bool checkRegistered =
    addCommand({Group::Runs, "check", "validate a deck and say what will be modelled; run nothing",
                prepareCheck});

}  // namespace

}  // namespace tooljoint::app
