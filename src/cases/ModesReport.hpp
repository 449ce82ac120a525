// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What `tooljoint modes` prints and writes of any case.
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
  bool coupledOnly = false;    ///< undamped modes of the coupled model alone, with estimated errors
  bool bases = false;          ///< the vectors of all bases too, behind the frequencies
};

/// When the laws of time are evaluated where nothing else says so: at the end of the motion [s], 0
/// without one.
double timeOfLaws(const Case& one);

/// Lists the undamped and damped modes of the full model and, where the deck reduces, those of the
/// coupled model beside them with MAC values, true and estimated errors; or those of the coupled
/// model alone. The shapes are those of the undamped modes of the full model. DeckError,
/// ModelError, ConvergenceError, FileError. Collective.
void listModes(const Case& one, const ModesOptions& options);

}  // namespace tooljoint::cases
