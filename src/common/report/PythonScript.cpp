// SPDX-License-Identifier: BSD-3-Clause
#include "common/report/PythonScript.hpp"

#include <array>
#include <cstdlib>
#include <dlfcn.h>
#include <filesystem>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "common/Error.hpp"
#include "common/Parallel.hpp"
#include "common/Text.hpp"
#include "common/report/Log.hpp"

extern char** environ;  // name given by POSIX

namespace tooljoint {

namespace {

/// Exits with 0 if all modules exist; they are not loaded, which would take a second.
constexpr const char* kModulesAreThere =
    "import importlib.util as u, sys; "
    "sys.exit(any(u.find_spec(m) is None for m in ('h5py', 'matplotlib', 'numpy')))";

std::string readAll(int descriptor) {
  std::string text;
  std::array<char, 4096> buffer{};
  for (ssize_t count = 0; (count = read(descriptor, buffer.data(), buffer.size())) > 0;)
    text.append(buffer.data(), static_cast<std::size_t>(count));
  return text;
}

/// Runs a program found in PATH and keeps its standard error; code -1 if it cannot be started or is
/// killed.
ScriptEnd start(const std::vector<std::string>& words) {
  std::vector<char*> arguments;
  for (const auto& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  int ends[2];
  if (pipe(ends) != 0) return {};
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDERR_FILENO);
  posix_spawn_file_actions_addclose(&actions, ends[0]);
  posix_spawn_file_actions_addclose(&actions, ends[1]);
  pid_t child = 0;
  const int failed =
      posix_spawnp(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);
  ScriptEnd end;
  if (failed == 0) end.errors = readAll(ends[0]);
  close(ends[0]);
  int status = 0;
  if (failed != 0 || waitpid(child, &status, 0) != child || !WIFEXITED(status)) return end;
  end.started = true;
  end.code = WEXITSTATUS(status);
  return end;
}

std::string interpreter() {
  for (const char* candidate : {"/usr/bin/python3", "python3"})
    if (start({candidate, "-c", kModulesAreThere}).code == 0) return candidate;
  return "";
}

/// Folders that may contain share/tooljoint: those of the program (bin/..), then those of this
/// library (lib/.. or lib/<architecture>/../..), for other programs and interpreters.
std::vector<std::filesystem::path> roots() {
  namespace fs = std::filesystem;
  std::error_code error;
  const auto program = fs::read_symlink("/proc/self/exe", error).parent_path();
  std::vector<fs::path> all{program.parent_path(), program};
  Dl_info library{};
  if (dladdr(reinterpret_cast<const void*>(&interpreter), &library) != 0 &&
      library.dli_fname != nullptr) {
    const auto folder = fs::weakly_canonical(library.dli_fname, error).parent_path();
    for (const auto& root : {folder, folder.parent_path(), folder.parent_path().parent_path()})
      all.push_back(root);
  }
  return all;
}

}  // namespace

PythonScript::PythonScript(const std::string& name) : name_(name) {
  std::error_code error;
  for (const auto& root : roots()) {
    const auto path = root / "share/tooljoint/tools" / name;
    if (std::filesystem::exists(path, error)) {
      path_ = path.string();
      return;
    }
  }
}

std::string PythonScript::command(const std::vector<std::string>& arguments) const {
  return "python3 " + (path_.empty() ? name_ : path_) + " " + join(arguments, " ");
}

ScriptEnd PythonScript::run(const std::vector<std::string>& arguments) const {
  const auto python = path_.empty() ? std::string() : interpreter();
  if (python.empty())
    return {false, -1,
            "it needs python3 with h5py, numpy and matplotlib" +
                (path_.empty() ? ", and the script " + name_ + " of this project" : "")};
  std::vector<std::string> words{python, path_};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return start(words);
}

void runScript(const std::string& name, const std::string& what,
               const std::vector<std::string>& arguments) {
  parallel::agree([&] {
    if (parallel::rank() != 0) return;
    const auto end = PythonScript(name).run(arguments);
    if (!end.started) throw FileError(what + ": " + end.errors + ".");
    auto said = end.errors;
    said.erase(said.find_last_not_of('\n') + 1);
    if (end.code == 0 && !said.empty()) log::warn(said);
    if (end.code == static_cast<int>(ExitCode::Usage)) throw UsageError(said);
    if (end.code == static_cast<int>(ExitCode::Files)) throw FileError(said);
    if (end.code != 0) throw Error(ExitCode::Internal, what + ": " + said);
  });
}

}  // namespace tooljoint
