// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Scripts of the project (share/tooljoint/tools) that plot the files of the program.
#pragma once

#include <string>
#include <vector>

namespace tooljoint {

/// Result of a script.
struct ScriptEnd {
  bool started = false;  ///< false: no interpreter with the modules, or the script is missing
  int code = -1;         ///< exit code of the script
  std::string errors;    ///< its standard error, or the reason why it was not started
};

/// A script installed with the program or this library, in the build tree or in the install tree
/// (bin/../share).
class PythonScript {
 public:
  /// `name` below share/tooljoint/tools, e.g. "plot_study.py"; a folder has a __main__.py.
  explicit PythonScript(const std::string& name);

  /// Runs it with the first python3 that has h5py, numpy and matplotlib, that of the distribution
  /// first. It writes to the standard output of this process. Call it on one rank.
  ScriptEnd run(const std::vector<std::string>& arguments) const;
  /// The command to run it by hand: "python3 /usr/share/... DIR".
  std::string command(const std::vector<std::string>& arguments) const;

 private:
  std::string name_;
  std::string path_;  ///< empty if the script is missing
};

/// Runs a script with arguments on rank 0. `what` begins the sentence of a failure: "The report was
/// not written". UsageError and FileError according to the exit code of the script; FileError when
/// it cannot be started. Collective.
void runScript(const std::string& name, const std::string& what,
               const std::vector<std::string>& arguments);

}  // namespace tooljoint
