// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Output of `tooljoint modes` for any case.
#pragma once

#include <optional>
#include <string>

#include "cases/Case.hpp"

namespace tooljoint::cases {

struct ModesOptions {
  int count = 20;              ///< modes listed
  std::optional<double> time;  ///< of the matrices of the damped modes [s]; none: the end of the
                               ///< motion
  std::string output;          ///< folder of the tables, modes.h5 and summary.json; empty: no files
  bool coupledOnly = false;    ///< undamped modes of the coupled model only, with estimated errors
  bool bases = false;          ///< also the vectors of all bases, after the frequencies
};

/// Default time at which the laws of time are evaluated: the end of the motion [s], 0 without one.
double timeOfLaws(const Case& one);

/// Lists the undamped and damped modes of the full model and, if the deck reduces, those of the
/// coupled model beside them with MAC values, true and estimated errors; or only those of the
/// coupled model. The shapes are those of the undamped modes of the full model. DeckError,
/// ModelError, ConvergenceError, FileError. Collective.
void listModes(const Case& one, const ModesOptions& options);

}  // namespace tooljoint::cases
