// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A complete run of one case, from rest to results.
#pragma once

#include <string>

#include "cases/Case.hpp"
#include "cases/run/RunFiles.hpp"

namespace tooljoint::cases {

/// Runs a case into a folder: state at rest, reduction if the deck has the list Reduction, motion
/// if it has the list Transient. Writes results.h5, summary.json and tables (docs/file-formats.md).
/// With `restart` the motion continues from a checkpoint. Collective. DeckError, ModelError,
/// ConvergenceError, FileError, InterruptedError; after an error the files written so far are
/// readable. \return the folder
std::string run(const Case& one, const RunOptions& options);

/// Logs the kind and size of the case, and warns of its remarks.
void announce(const Case& one);

/// The line that compares the cost of a step of the full and of the reduced model.
/// \param ratio set to reduced over full cost
std::string predictCost(const Case& one, const model::SecondOrderModel& full,
                        const model::SecondOrderModel& reduced, double* ratio = nullptr);

}  // namespace tooljoint::cases
