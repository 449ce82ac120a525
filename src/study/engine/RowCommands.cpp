// SPDX-License-Identifier: BSD-3-Clause
#include "study/engine/RowCommands.hpp"

#include <filesystem>
#include <system_error>

#include "cases/run/DeckCommand.hpp"
#include "common/Error.hpp"
#include "common/Parallel.hpp"
#include "common/Text.hpp"
#include "io/TextFile.hpp"

namespace tooljoint::study {

namespace {

std::string absolute(const std::string& path) {
  return inShellQuotes(std::filesystem::absolute(path).lexically_normal().string());
}

}  // namespace

std::string rowCommand(const cases::Case& one, const RowCommand& what) {
  std::string command =
      inShellQuotes(what.program) + " " + what.command + " " + absolute(one.deck().file());
  if (what.ranksPerRow > 1)
    command = "mpiexec -n " + std::to_string(what.ranksPerRow) + " " + command;
  return command + cases::overrideSwitches(one.deck()) + what.options + " --output " +
         absolute(what.folder) + " --row ";
}

void writePlan(const std::string& folder, const std::string& name, const std::string& text) {
  parallel::agree([&] {
    if (parallel::rank() != 0) return;
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error)
      throw FileError("The folder " + folder + " cannot be made: " + error.message() + ".");
    io::writeText(folder + "/" + name, text);
  });
}

}  // namespace tooljoint::study
