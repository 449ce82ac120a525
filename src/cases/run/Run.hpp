// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The whole way of the data of one case, from rest to results.
#pragma once

#include <string>

#include "cases/Case.hpp"
#include "cases/run/RunFiles.hpp"

namespace tooljoint::cases {

/// Runs a case into a folder: state at rest, reduction where the deck has the list Reduction,
/// motion where it has the list Transient; results.h5, summary.json and tables,
/// docs/file-formats.md describes them. With `restart` the motion continues from a checkpoint.
/// Collective. DeckError, ModelError, ConvergenceError, FileError, InterruptedError; an error
/// leaves what is there readable.
/// \return the folder
std::string run(const Case& one, const RunOptions& options);

/// Logs what the case is, and warns of its remarks.
void announce(const Case& one);

/// The line that compares the cost of a step of the full and of the reduced model.
/// \param ratio set to reduced over full cost
std::string predictCost(const Case& one, const model::SecondOrderModel& full,
                        const model::SecondOrderModel& reduced, double* ratio = nullptr);

}  // namespace tooljoint::cases
