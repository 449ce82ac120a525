// SPDX-License-Identifier: BSD-3-Clause
#include "study/map/Map.hpp"

#include "app/commands/Command.hpp"

namespace tooljoint::app {

namespace {

void map(const RowOptions& options) {
  const auto one = readCase(options);
  study::MapOptions own{options.output, options.fresh, options.ranksPerRow};
  if (!options.plan.empty()) {
    study::planMapRows(*one, options.plan, programPath(), own);
  } else if (!options.collect.empty()) {
    own.output = options.collect;
    study::collectMap(*one, own);
    endAnalysis("map", *one, own.output);
  } else if (!options.row.empty()) {
    study::computeMapRow(*one, options.row, own);
  } else {
    study::runMap(*one, own);
    endAnalysis("map", *one, own.output);
  }
}

Action prepareMap(CLI::App& line) {
  auto options = std::make_shared<RowOptions>();
  addDeckOptions(line, *options, Output::Always, "_map");
  addVerbose(line, *options);
  addRowOptions(line, *options, "its number in map.csv (the commands of --plan)");
  return [options] { map(*options); };
}

const bool mapRegistered =
    addCommand({Group::Runs, "map",
                "figures over a grid of parameters: the deck's Map list as table and coloured maps",
                prepareMap});

}  // namespace

}  // namespace tooljoint::app
