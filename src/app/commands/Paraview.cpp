// SPDX-License-Identifier: BSD-3-Clause
#include <string>
#include <vector>

#include "app/commands/Commands.hpp"
#include "app/commands/Scripts.hpp"

namespace tooljoint::app {

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

}  // namespace tooljoint::app
