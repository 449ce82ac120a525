// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace tooljoint::parallel {

/// Keep it alive during the start of MPI. In a process without launcher, Open MPI then starts no
/// daemon and searches no network, which would take a third of a second. Existing environment
/// variables are not changed; the environment is restored afterwards.
class QuickStart {
 public:
  QuickStart();
  ~QuickStart();
  QuickStart(const QuickStart&) = delete;
  QuickStart& operator=(const QuickStart&) = delete;

 private:
  std::vector<const char*> set_;  ///< names
};

}  // namespace tooljoint::parallel
