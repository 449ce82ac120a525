// SPDX-License-Identifier: BSD-3-Clause
#include "app/commands/Scripts.hpp"

#include "common/Error.hpp"
#include "common/Parallel.hpp"
#include "common/report/Log.hpp"
#include "common/report/PythonScript.hpp"

namespace tooljoint::app {

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

}  // namespace tooljoint::app
