// SPDX-License-Identifier: BSD-3-Clause
#include <string>
#include <vector>

#include "app/commands/Command.hpp"
#include "common/report/PythonScript.hpp"

namespace tooljoint::app {

namespace {

/// Values as texts; empty: the default of the script.
struct ParaviewOptions {
  std::string folder;
  std::string output;
  std::string magnify;
  std::string pictures;
};

void paraview(const ParaviewOptions& options) {
  std::vector<std::string> arguments{options.folder};
  const auto add = [&](const char* name, const std::string& value) {
    if (!value.empty()) arguments.push_back(std::string(name) + "=" + value);
  };
  add("--output", options.output);
  add("--magnify", options.magnify);
  add("--pictures", options.pictures);
  runScript("paraview", "The files for ParaView were not written", arguments);
}

Action prepareParaview(CLI::App& line) {
  auto options = std::make_shared<ParaviewOptions>();
  line.add_option("DIR", options->folder, "folder of a run")->type_name("DIR")->required();
  line.add_option("--output,-o", options->output, "folder to write (default: DIR/paraview)")
      ->type_name("DIR");
  line.add_option("--magnify", options->magnify,
                  "factor of the displacements and of the clearance (default 1)")
      ->check(aboveZero());
  line.add_option("--pictures", options->pictures, "pictures of the motion, at most (default 200)")
      ->check(aboveZero());
  return [options] { paraview(*options); };
}

const bool paraviewRegistered = addCommand(
    {Group::Results, "paraview",
     "files of ParaView of a run: the motion in space with forces and stresses", prepareParaview});

}  // namespace

}  // namespace tooljoint::app
