// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace tooljoint::parallel {

/// Alive while MPI begins: of a process that no launcher started, Open MPI then starts no daemon
/// and seeks no network, which takes it a third of a second. What the environment says already
/// stays; it is as before afterwards.
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
