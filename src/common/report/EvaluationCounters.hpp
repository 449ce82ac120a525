// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Counts the quantities that a run builds and evaluates on this rank. Tests use them to check that
/// effects absent from a deck are neither built nor evaluated. Names in use: "mud matrices",
/// "contact evaluations", "friction evaluations", "gyroscopic matrices", "geometric stiffness",
/// "unbalance loads", "modes computed", "modes of the static state", "factorisations", "parts
/// reduced".
#pragma once

#include <map>
#include <string>

namespace tooljoint {

/// Add `n` to the counter `what`.
void count(const std::string& what, long n = 1);

/// The counter itself, for frequent counting; the reference remains valid, also across
/// resetEvaluationCounters().
long& counter(const std::string& what);

/// Value of a counter; 0 if it was never used.
long counted(const std::string& what);

/// All counters that are not zero, by name.
std::map<std::string, long> evaluationCounters();

/// Set every counter to zero.
void resetEvaluationCounters();

}  // namespace tooljoint
