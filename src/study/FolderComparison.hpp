// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Errors of a finished run relative to another one, from their results folders.
#pragma once

#include <string>
#include <vector>

#include "study/Metrics.hpp"

namespace tooljoint::study {

struct ComparedFolders {
  std::string folder;
  std::string reference;
};

/// Errors of a motion relative to a reference inside a window of time.
struct MotionErrors {
  std::vector<double> times;  ///< of the samples that were compared [s]
  ErrorProfile overTime;      ///< eps_t, (45) of Nguyen et al. 2020
  ErrorProfile overNodes;     ///< eps_n, (46)
  double vibration = 0.0;     ///< error of the vibration
};

/// Compares all components of the nodes of a string, and the measured ones of imported parts.
/// FileError; UsageError: the folders hold different scenes or different times in the window, or
/// the reference does not move in it.
MotionErrors compareFolders(const ComparedFolders& folders, const Window& window);

}  // namespace tooljoint::study
