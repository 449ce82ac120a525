// SPDX-License-Identifier: BSD-3-Clause
#include "texts/UnknownWords.hpp"

#include <CLI/CLI.hpp>

#include "common/Text.hpp"

namespace tooljoint::texts {

namespace {

/// Options of the program and of the command that is given.
std::vector<std::string> optionsOf(const CLI::App& program) {
  std::vector<std::string> names;
  const auto add = [&](const CLI::App& app) {
    for (const auto* option : app.get_options())
      for (const auto& name : option->get_lnames()) names.push_back("--" + name);
  };
  add(program);
  for (const auto* command : program.get_subcommands()) add(*command);
  return names;
}

}  // namespace

std::string describeUnknown(const CLI::App& program, const std::vector<std::string>& unknown) {
  if (!program.get_subcommands().empty() || unknown.front().front() == '-') {
    const auto meant = closest(split(unknown.front(), '=').front(), optionsOf(program));
    return (unknown.size() == 1 ? "Unknown argument: " : "Unknown arguments: ") +
           join(unknown, " ") + "." + (meant.empty() ? "" : " Did you mean " + meant + "?") +
           " Options and what they take are listed by --help.";
  }
  std::vector<std::string> commands;
  for (const auto* command : program.get_subcommands([](const CLI::App*) { return true; }))
    commands.push_back(command->get_name());
  const auto meant = closest(unknown.front(), commands);
  return "Unknown command \"" + unknown.front() + "\"." +
         (meant.empty() ? "" : " Did you mean \"" + meant + "\"?") +
         " Available: " + quotedList(commands) + ".";
}

}  // namespace tooljoint::texts
