// SPDX-License-Identifier: BSD-3-Clause
#include "study/RowStore.hpp"

#include <filesystem>
#include <fstream>
#include <unistd.h>

#include "common/Error.hpp"
#include "common/Text.hpp"
#include "io/ResultsFile.hpp"
#include "io/ResultsReader.hpp"

namespace tooljoint::study {

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
  if (!active() || !std::filesystem::exists(file("reference", key, ".h5"))) return std::nullopt;
  try {
    const io::ResultsReader reader(file("reference", key, ".h5"));
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
  if (!active()) return;
  const std::size_t samples = history.time.size();
  io::ResultsFile out(file("reference", key, ".h5"), {});
  out.write("/time", history.time, {samples}, "s", "Time of the samples");
  out.write("/displacement", history.displacement, {samples, history.nodes, history.components},
            "m", "Displacements of the nodes of the reference run");
  out.write("/vibrating", std::vector<double>{static_cast<double>(history.vibrating)}, {1}, "1",
            "Components in front that are the vibration");
  if (!history.bitSpeed.empty())
    out.write("/bit_speed", history.bitSpeed, {samples}, "rad/s", "Rotary speed of the last node");
  out.finish();
}

}  // namespace tooljoint::study
