// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <iostream>
#include <string>

#include "common/Parallel.hpp"
#include "common/report/Log.hpp"
#include "common/report/PythonScript.hpp"
#include "study/engine/StudyFiles.hpp"

namespace tooljoint::study {

void drawStudy(const std::string& folder) { drawPictures("plot_study.py", "study_", folder); }

void drawPictures(const std::string& scriptName, const std::string& prefix,
                  const std::string& folder) {
  if (parallel::rank() != 0) return;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    // removes pictures of an earlier run
    const auto name = entry.path().filename().string();
    const auto kind = entry.path().extension();
    if (name.rfind(prefix, 0) == 0 && (kind == ".png" || kind == ".svg"))
      std::filesystem::remove(entry.path());
  }
  const PythonScript script(scriptName);
  const auto end = script.run({folder});
  const auto later = ". Draw them later with: " + script.command({folder});
  if (!end.started) {
    log::warn("The plots were not drawn: " + end.errors + later);
    return;
  }
  std::cerr << end.errors << std::flush;
  if (end.code != 0) log::warn("The plots were not drawn; the script says why above" + later);
}

}  // namespace tooljoint::study
