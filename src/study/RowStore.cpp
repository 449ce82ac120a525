// SPDX-License-Identifier: BSD-3-Clause
#include "study/RowStore.hpp"

#include <filesystem>
#include <fstream>
#include <link.h>
#include <sys/stat.h>
#include <unistd.h>

#include "common/Error.hpp"
#include "common/Parallel.hpp"
#include "common/Text.hpp"
#include "common/Version.hpp"
#include "io/ResultsFile.hpp"
#include "io/ResultsReader.hpp"
#include "io/TextFile.hpp"

namespace tooljoint::study {
namespace {

/// Size and time of a file, for "has this been built anew?".
std::string fileStamp(const std::string& path) {
  struct stat info = {};
  if (::stat(path.c_str(), &info) != 0) return "";
  return std::to_string(info.st_size) + "@" + std::to_string(info.st_mtim.tv_sec) + "." +
         std::to_string(info.st_mtim.tv_nsec);
}

int addLibrary(dl_phdr_info* info, std::size_t, void* data) {
  const std::string name = info->dlpi_name == nullptr ? "" : info->dlpi_name;
  if (name.find("libtooljoint") != std::string::npos)
    *static_cast<std::string*>(data) += " " + fileStamp(name);
  return 0;
}

}  // namespace

std::string programStamp() {
  std::string stamp = programVersion() + " " + gitHash();
  const bool committed = gitHash() != "unknown" && gitHash().find("dirty") == std::string::npos;
  if (committed) return stamp;
  std::string libraries = " " + fileStamp("/proc/self/exe");
  dl_iterate_phdr(addLibrary, &libraries);
  return stamp + libraries;
}

std::string machineName() {
  char host[256] = "";
  if (gethostname(host, sizeof host - 1) != 0) host[0] = '\0';
  std::ifstream cpu("/proc/cpuinfo");
  std::string line;
  while (std::getline(cpu, line))
    if (line.rfind("model name", 0) == 0 && line.find(':') != std::string::npos)
      return std::string(host) + ", " + trim(line.substr(line.find(':') + 1));
  return host;
}

RowStore::RowStore(const std::string& folder)
    : folder_(folder + "/cache"), active_(parallel::rank() == 0) {
  if (!active_) return;
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error) throw FileError("The folder " + folder_ + " cannot be made: " + error.message() + ".");
}

void RowStore::clear() const {
  if (!active_) return;
  std::vector<std::filesystem::path> ours;
  for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
    const auto name = entry.path().filename().string();
    if (name.rfind("row_", 0) == 0 || name.rfind("reference_", 0) == 0)
      ours.push_back(entry.path());
  }
  for (const auto& path : ours) std::filesystem::remove(path);
}

std::optional<std::string> RowStore::restoreText(const std::string& key) const {
  if (!active_ || !std::filesystem::exists(rowFile(key))) return std::nullopt;
  try {
    return io::readText(rowFile(key));
  } catch (const FileError&) {
    return std::nullopt;
  }
}

void RowStore::keepText(const std::string& key, const std::string& text) const {
  if (active_) io::writeText(rowFile(key), text);
}

bool RowStore::restore(const std::string& key, StudyRow& row) const {
  const auto text = restoreText(key);
  if (!text) return false;
  StudyRow stored = row;
  try {
    stored.fromJson(*text);
  } catch (const FileError&) {
    return false;
  }
  row = stored;
  return true;
}

void RowStore::keep(const std::string& key, const StudyRow& row) const {
  keepText(key, row.toJson());
}

std::optional<RecordedHistory> RowStore::restoreHistory(const std::string& key) const {
  if (!active_ || !std::filesystem::exists(historyFile(key))) return std::nullopt;
  try {
    const io::ResultsReader reader(historyFile(key));
    RecordedHistory history;
    history.time = reader.numbers("/time");
    history.displacement = reader.numbers("/displacement");
    if (reader.has("/bit_speed")) history.bitSpeed = reader.numbers("/bit_speed");
    history.nodes = reader.shape("/displacement").at(1);
    history.components = reader.shape("/displacement").at(2);
    history.vibrating = static_cast<std::size_t>(reader.numbers("/vibrating").at(0));
    return history;
  } catch (const FileError&) {
    return std::nullopt;
  }
}

void RowStore::keepHistory(const std::string& key, const RecordedHistory& history) const {
  if (!active_) return;
  const std::size_t samples = history.time.size();
  io::ResultsFile file(historyFile(key), {});
  file.write("/time", history.time, {samples}, "s", "Time of the samples");
  file.write("/displacement", history.displacement, {samples, history.nodes, history.components},
             "m", "Displacements of the nodes of the reference run");
  file.write("/vibrating", std::vector<double>{static_cast<double>(history.vibrating)}, {1}, "1",
             "Components in front that are the vibration");
  if (!history.bitSpeed.empty())
    file.write("/bit_speed", history.bitSpeed, {samples}, "rad/s", "Rotary speed of the last node");
  file.finish();
}

}  // namespace tooljoint::study
