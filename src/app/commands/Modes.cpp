// SPDX-License-Identifier: BSD-3-Clause
#include <optional>

#include "app/commands/Command.hpp"
#include "cases/ModesReport.hpp"

namespace tooljoint::app {

namespace {

struct ModesOptions : DeckOptions {
  int count = 20;              ///< frequencies that are listed
  bool coupledOnly = false;    ///< without the full model
  bool bases = false;          ///< with the vectors of the bases
  std::optional<double> time;  ///< of the laws of time [s]; none: the end of the motion
};

void modes(const ModesOptions& options) {
  const auto one = readCase(options);
  cases::listModes(
      *one, {options.count, options.time, options.output, options.coupledOnly, options.bases});
  if (!options.output.empty()) endAnalysis("modes", *one, options.output);
}

Action prepareModes(CLI::App& line) {
  auto options = std::make_shared<ModesOptions>();
  addDeckOptions(line, *options, Output::Wanted);
  addVerbose(line, *options);
  line.add_option("--count", options->count, "number of frequencies to list")->check(aboveZero());
  line.add_flag("--coupled", options->coupledOnly,
                "undamped modes of the coupled model and their estimated errors only: the full "
                "model is not solved");
  line.add_flag("--bases", options->bases,
                "the vectors of the basis of each part too, behind the frequencies");
  line.add_option("--time", options->time,
                  "time at which damped modes take the laws of time (rotary speed) [s] (default: "
                  "the end of the motion)")
      ->check(anyNumber());
  return [options] { modes(*options); };
}

const bool modesRegistered =
    addCommand({Group::Analyses, "modes",
                "eigenfrequencies and damping of the full and the coupled model; bases on request",
                prepareModes});

}  // namespace

}  // namespace tooljoint::app
