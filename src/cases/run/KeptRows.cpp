// SPDX-License-Identifier: BSD-3-Clause
#include "cases/run/KeptRows.hpp"

#include <filesystem>
#include <link.h>
#include <sys/stat.h>
#include <utility>
#include <vector>

#include "common/Error.hpp"
#include "common/Parallel.hpp"
#include "common/Version.hpp"
#include "io/TextFile.hpp"

namespace tooljoint::cases {
namespace {

/// Size and time of a file, to detect a new build.
std::string fileStamp(const std::string& path) {
  struct stat info = {};
  if (::stat(path.c_str(), &info) != 0) return "";
  return std::to_string(info.st_size) + "@" + std::to_string(info.st_mtim.tv_sec) + "." +
         std::to_string(info.st_mtim.tv_nsec);
}

/// Loaded libraries: those of the program, and extensions, which belong neither to it nor to the
/// system.
struct Libraries {
  std::string own, extensions;
};

int addLibrary(dl_phdr_info* info, std::size_t, void* data) {
  const std::string name = info->dlpi_name == nullptr ? "" : info->dlpi_name;
  auto& found = *static_cast<Libraries*>(data);
  const auto stands = [&](const char* folder) { return name.rfind(folder, 0) == 0; };
  const bool ours = name.find("libtooljoint") != std::string::npos ||
                    name.find("tooljoint/_core") != std::string::npos;  // the Python package
  if (ours)
    found.own += " " + fileStamp(name);
  else if (name.find('/') != std::string::npos && !stands("/lib") && !stands("/usr/lib"))
    found.extensions += " " + name + " " + fileStamp(name);
  return 0;
}

/// Names of the files of this program in a folder.
std::vector<std::filesystem::path> filesOf(const std::string& folder,
                                           const std::vector<std::string>& kinds) {
  std::vector<std::filesystem::path> ours;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const auto name = entry.path().filename().string();
    for (const auto& kind : kinds)
      if (name.rfind(kind + "_", 0) == 0) ours.push_back(entry.path());
  }
  return ours;
}

}  // namespace

std::string programStamp() {
  std::string stamp = programVersion() + " " + gitHash();
  const bool committed = gitHash() != "unknown" && gitHash().find("dirty") == std::string::npos;
  Libraries libraries;
  dl_iterate_phdr(addLibrary, &libraries);
  stamp += libraries.extensions;
  return committed ? stamp : stamp + " " + fileStamp("/proc/self/exe") + libraries.own;
}

KeptRows::KeptRows(const std::string& folder, std::string kind)
    : folder_(folder + "/cache"), kind_(std::move(kind)), active_(parallel::rank() == 0) {
  if (!active_) return;
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error) throw FileError("The folder " + folder_ + " cannot be made: " + error.message() + ".");
}

void KeptRows::clear() const {
  if (!active_) return;
  for (const auto& path : filesOf(folder_, {kind_, "reference"})) std::filesystem::remove(path);
}

int KeptRows::count() const {
  return active_ ? static_cast<int>(filesOf(folder_, {kind_}).size()) : 0;
}

std::optional<std::string> KeptRows::restoreText(const std::string& key) const {
  const auto path = file(kind_, key, ".json");
  if (!active_ || !std::filesystem::exists(path)) return std::nullopt;
  try {
    return io::readText(path);
  } catch (const FileError&) {
    return std::nullopt;
  }
}

void KeptRows::keepText(const std::string& key, const std::string& text) const {
  if (active_) io::writeText(file(kind_, key, ".json"), text);
}

}  // namespace tooljoint::cases
