// SPDX-License-Identifier: BSD-3-Clause
#include <cstdlib>
#include <filesystem>
#include <spawn.h>
#include <sys/wait.h>

#include "common/Parallel.hpp"
#include "common/report/Log.hpp"
#include "study/engine/StudyFiles.hpp"

extern char** environ;  // NOLINT: POSIX names it so

namespace tooljoint::study {

namespace {

constexpr const char* kScript = "share/tooljoint/tools/plot_study.py";

/// Exit code of a program found in PATH, its output discarded unless `speaks`; -1 when it cannot be
/// started.
int start(const std::vector<std::string>& words, bool speaks) {
  std::vector<char*> arguments;
  for (const auto& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  for (int stream : {1, 2})
    if (!speaks)
      posix_spawn_file_actions_addopen(&actions, stream, "/dev/null", 1, 0);  // 1: O_WRONLY
  pid_t child = 0;
  const int failed =
      posix_spawnp(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  int status = 0;
  if (failed != 0 || waitpid(child, &status, 0) != child || !WIFEXITED(status)) return -1;
  return WEXITSTATUS(status);
}

/// The script beside this program: in an install tree, or in a build tree.
std::filesystem::path script() {
  std::error_code error;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
  for (const auto& root : {program.parent_path(), program})
    if (std::filesystem::exists(root / kScript, error)) return root / kScript;
  return {};
}

/// An interpreter that has what the script needs; "" for none. The distribution's own comes first,
/// since its packages belong to it.
std::string interpreter() {
  for (const char* candidate : {"/usr/bin/python3", "python3"})
    if (start({candidate, "-c", "import h5py, matplotlib, numpy"}, false) == 0) return candidate;
  return "";
}

}  // namespace

void drawStudy(const std::string& folder) {
  if (parallel::rank() != 0) return;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    // pictures of an earlier study are not ours
    const auto name = entry.path().filename().string();
    const auto kind = entry.path().extension();
    if (name.rfind("study_", 0) == 0 && (kind == ".png" || kind == ".svg"))
      std::filesystem::remove(entry.path());
  }
  const auto where = script();
  const auto python = where.empty() ? std::string() : interpreter();
  const auto command =
      "python3 " + (where.empty() ? std::string("plot_study.py") : where.string()) + " " + folder;
  if (python.empty()) {
    log::warn("The plots were not drawn: that needs python3 with h5py, numpy and matplotlib" +
              std::string(where.empty() ? ", and the script plot_study.py of this project" : "") +
              ". Draw them later with: " + command);
    return;
  }
  if (start({python, where.string(), folder}, true) != 0)
    log::warn("The plots were not drawn; the script says why above. Draw them later with: " +
              command);
}

}  // namespace tooljoint::study
