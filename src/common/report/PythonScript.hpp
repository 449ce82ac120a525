// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Scripts of the project (share/tooljoint/tools) that draw what the program has written.
#pragma once

#include <string>
#include <vector>

namespace tooljoint {

/// How a script ended.
struct ScriptEnd {
  bool started = false;  ///< false: no interpreter with the modules, or the script is not there
  int code = -1;         ///< exit code of the script
  std::string errors;    ///< what it wrote to standard error, or why it was not started
};

/// A script beside the program or this library, in the build tree as in the install tree
/// (bin/../share).
class PythonScript {
 public:
  /// `name` below share/tooljoint/tools, e.g. "plot_study.py"; a folder has a __main__.py.
  explicit PythonScript(const std::string& name);

  /// Runs it with the first python3 that has h5py, numpy and matplotlib; that of the distribution
  /// comes first. Its standard output is that of this process. Call it on one rank.
  ScriptEnd run(const std::vector<std::string>& arguments) const;
  /// What a person types to run it: "python3 /usr/share/... DIR".
  std::string command(const std::vector<std::string>& arguments) const;

 private:
  std::string name_;
  std::string path_;  ///< empty where the script is missing
};

/// Runs a script with arguments on rank 0. `what` begins the sentence of a failure: "The report was
/// not written". UsageError and FileError as the script ends; FileError when it cannot be started.
/// Collective.
void runScript(const std::string& name, const std::string& what,
               const std::vector<std::string>& arguments);

}  // namespace tooljoint
