// SPDX-License-Identifier: BSD-3-Clause
#include "study/engine/RowCommands.hpp"

#include <filesystem>
#include <system_error>

#include "common/Error.hpp"
#include "common/Parallel.hpp"
#include "io/TextFile.hpp"

namespace tooljoint::study {

namespace {

/// In single quotes, as a shell reads it.
std::string quoted(const std::string& text) {
  std::string out = "'";
  for (char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

std::string absolute(const std::string& path) {
  return quoted(std::filesystem::absolute(path).lexically_normal().string());
}

}  // namespace

std::string rowCommand(const cases::Case& one, const RowCommand& what) {
  std::string command =
      quoted(what.program) + " " + what.command + " " + absolute(one.deck().file());
  if (what.ranksPerRow > 1)
    command = "mpiexec -n " + std::to_string(what.ranksPerRow) + " " + command;
  for (const auto& item : one.deck().overrides())
    command += item[0] == '!' ? " --without " + quoted(item.substr(1)) : " --set " + quoted(item);
  return command + what.options + " --output " + absolute(what.folder) + " --row ";
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
