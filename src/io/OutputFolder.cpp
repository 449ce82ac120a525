// SPDX-License-Identifier: BSD-3-Clause
#include "io/OutputFolder.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <sys/file.h>
#include <system_error>
#include <unistd.h>

#include "common/Error.hpp"
#include "common/Parallel.hpp"
#include "common/Text.hpp"
#include "common/report/Log.hpp"
#include "io/TextFile.hpp"
#include "io/summary/Summary.hpp"

namespace tooljoint::io {
namespace {

std::string megabytes(double bytes) {
  const double size = bytes / 1048576.0;
  return (size < 1e3 ? fmt::format("{:.3g}", size) : formatNumber(std::ceil(size))) + " MB";
}

bool isPlain(const std::string& name) {
  return !name.empty() && name.find('/') == std::string::npos;
}

/// Moves these files into a new subfolder.
/// \param what  describes them in messages
std::filesystem::path moved(const std::filesystem::path& here,
                            const std::vector<std::string>& names, const std::string& folder,
                            const std::string& what) {
  namespace fs = std::filesystem;
  fs::path aside = here / folder;
  for (int number = 2; fs::exists(aside); ++number)
    aside = here / (folder + "_" + std::to_string(number));
  std::error_code error;
  fs::create_directory(aside, error);
  for (const auto& name : names)
    if (!error && isPlain(name) && fs::exists(here / name))
      fs::rename(here / name, aside / name, error);
  if (error)
    throw FileError("The output folder " + here.string() + " holds " + what +
                    ", which cannot be moved to " + aside.string() + ": " + error.message() +
                    ". Name another folder with --output.");
  return aside;
}

}  // namespace

OutputFolder::OutputFolder(const std::string& folder, OldCheckpoint old)
    : folder_(folder), active_(parallel::rank() == 0) {
  if (!active_) return;
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error) {
    throw FileError("The output folder " + folder_ + " cannot be made: " + error.message() +
                    ". Name another one with --output.");
  }
  lock_ = ::open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (lock_ < 0) {
    throw FileError("The output folder " + folder_ + " cannot be opened: " + std::strerror(errno) +
                    ". Name another one with --output.");
  }
  // file systems without locks return another error; preventing two runs is then up to the user
  const bool taken = ::flock(lock_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  try {
    if (taken)
      throw FileError("Another run is writing into the output folder " + folder_ +
                      ". Wait for it or name another one with --output.");
    prove();
    const PreviousRun previous = readPreviousRun(folder_ + "/" + summaryName);
    finished_ = previous.status == "finished";
    previousFiles_ = previous.files;
    if (old == OldCheckpoint::SetAside) setAside();
  } catch (...) {
    ::close(lock_);
    throw;
  }
}

OutputFolder::~OutputFolder() {
  if (lock_ >= 0) ::close(lock_);
}

void OutputFolder::prove() const {
  const std::string probe = folder_ + "/.writable";
  try {
    stageText(probe, "tooljoint\n");
  } catch (const FileError& error) {
    ::unlink((probe + ".part").c_str());
    throw FileError("The output folder " + folder_ + " cannot be written to. " + error.what());
  }
  ::unlink((probe + ".part").c_str());
}

/// Moves a checkpoint with its samples. Finished results belong to an earlier run, not to the
/// interrupted one, and remain.
void OutputFolder::setAside() {
  namespace fs = std::filesystem;
  const fs::path here(folder_);
  if (!fs::exists(here / checkpointName)) return;
  std::vector<std::string> names{checkpointName, checkpointSamplesName,
                                 std::string(resultsName) + ".part"};
  if (!finished_) {
    names.insert(names.end(), previousFiles_.begin(), previousFiles_.end());
    names.insert(names.end(), {resultsName, summaryName});
    previousFiles_.clear();
  }
  const fs::path aside = moved(here, names, "interrupted", "the checkpoint of an interrupted run");
  log::warn("The output folder " + folder_ +
            " held the checkpoint of an interrupted run. It is now in " + aside.string() +
            "; that run goes on with --restart " + aside.string() + ".");
}

void OutputFolder::requireSpace(double bytes) const {
  if (!active_) return;
  std::error_code error;
  const auto space = std::filesystem::space(folder_, error);
  if (error || static_cast<double>(space.available) >= bytes) return;
  throw FileError("The output folder " + folder_ + " has room for " +
                  megabytes(static_cast<double>(space.available)) +
                  ", but the results need about " + megabytes(bytes) +
                  ". Make room, record less, or name another folder with --output.");
}

std::string OutputFolder::file(const std::string& name) {
  if (!isPlain(name)) {
    throw Error(ExitCode::Internal, "\"" + name + "\" is no name for a file in the output folder.");
  }
  std::string path = folder_ + "/" + name;
  if (std::find(names_.begin(), names_.end(), name) == names_.end()) {
    names_.push_back(name);
    if (active_)
      ::unlink(
          (path + ".part").c_str());  // left by a run that was killed: never to be taken for ours
  }
  return path;
}

std::vector<std::string> OutputFolder::files() const {
  std::vector<std::string> sorted = names_;
  std::sort(sorted.begin(), sorted.end());
  return sorted;
}

void OutputFolder::renameAll() {
  // summary.json marks a complete set, so it is published last
  std::stable_partition(names_.begin(), names_.end(),
                        [](const std::string& name) { return name != summaryName; });
  for (const auto& name : names_) {
    const std::string path = folder_ + "/" + name;
    if (std::filesystem::exists(path + ".part")) publishStaged(path);
  }
}

void OutputFolder::setEarlierAside() {
  const bool same =
      std::any_of(previousFiles_.begin(), previousFiles_.end(), [&](const auto& name) {
        return name != summaryName && std::find(names_.begin(), names_.end(), name) != names_.end();
      });
  if (!finished_ || previousFiles_.empty() || same) return;
  auto names = previousFiles_;
  names.emplace_back(summaryName);
  const auto aside = moved(folder_, names, "earlier", "results of another command");
  previousFiles_.clear();
  log::info("The output folder " + folder_ + " held results of another command. They are now in " +
            aside.string() + ".");
}

void OutputFolder::publish() {
  if (!active_) return;
  setEarlierAside();
  renameAll();
  for (const auto& name : previousFiles_) {
    if (isPlain(name) && std::find(names_.begin(), names_.end(), name) == names_.end())
      ::unlink((folder_ + "/" + name).c_str());
  }
  finished_ = true;
}

bool OutputFolder::publishUnfinished() {
  if (!active_) return false;
  if (!finished_) {
    renameAll();
    return true;
  }
  const auto staged = [this](const std::string& name) {
    return std::filesystem::exists(folder_ + "/" + name + ".part");
  };
  if (std::none_of(names_.begin(), names_.end(),
                   [&](const auto& name) { return name != summaryName && staged(name); }))
    ::unlink((folder_ + "/" + summaryName + ".part").c_str());
  return false;
}

}  // namespace tooljoint::io
