// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <system_error>

#include "app/commands/Command.hpp"
#include "common/Error.hpp"
#include "common/Parallel.hpp"
#include "common/Text.hpp"
#include "common/report/Log.hpp"
#include "io/TextFile.hpp"
#include "texts/Templates.hpp"

namespace tooljoint::app {

namespace {

namespace fs = std::filesystem;

/// True for a name that needs no quotes in a shell or in XML, as file name and as list name.
bool isPlain(const std::string& name) {
  return !name.empty() && name.front() != '-' && name.front() != '.' &&
         name.find_first_not_of(
             "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_.-") ==
             std::string::npos;
}

std::string named(std::string text, const std::string& mark, const std::string& name) {
  for (auto at = text.find(mark); at != std::string::npos; at = text.find(mark, at + name.size()))
    text.replace(at, mark.size(), name);
  return text;
}

void write(const fs::path& folder, const std::string& name) {
  std::error_code failed;
  if (fs::exists(folder, failed) && !fs::is_empty(folder, failed))
    throw FileError(folder.string() +
                    " is there already and not empty. Choose another name, or remove it.");
  fs::create_directories(folder, failed);
  if (failed) throw FileError(folder.string() + " cannot be made: " + failed.message() + ".");
  const auto& files = texts::templateFiles();
  const std::string list = "<ParameterList name=\"";
  io::writeText((folder / (name + ".xml")).string(),
                named(files.at("well.xml"), list + "well\"", list + name + "\""));
  io::writeText((folder / "survey.csv").string(), files.at("survey.csv"));
  io::writeText((folder / "README.md").string(), named(files.at("README.md"), "@NAME@", name));
}

/// Makes a folder with a deck of its name, survey.csv and README.md. UsageError: the name is not
/// valid for a deck; FileError: the folder is not empty, or cannot be written. Collective.
void newFolder(const std::string& path) {
  fs::path folder = fs::path(path).lexically_normal();
  if (!folder.has_filename()) folder = folder.parent_path();  // removes a final slash
  const std::string name = folder.filename().string();
  if (!isPlain(name))
    throw UsageError("The name " + inQuotes(name) +
                     " cannot be that of a deck. Use letters, digits, \"_\", \".\" and \"-\".");
  parallel::agree([&] {
    if (parallel::rank() == 0) write(folder, name);
  });
  log::info("folder      " + folder.string() + ": " + name + ".xml, survey.csv, README.md");
  log::info("next        cd " + folder.string() + " && tooljoint run " + name + ".xml");
}

Action prepareNew(CLI::App& line) {
  auto folder = std::make_shared<std::string>();
  line.add_option("NAME", *folder, "folder to make; its deck has the same name")
      ->type_name("DIR")
      ->required();
  return [folder] { newFolder(*folder); };
}

const bool newRegistered =
    addCommand({Group::Begin, "new",
                "write a folder with a deck that runs, its survey and a README", prepareNew});

}  // namespace

}  // namespace tooljoint::app
