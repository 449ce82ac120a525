// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// MPI operations for code outside src/linalg, over MPI_COMM_WORLD. Without MPI (not initialised,
/// or already finalised) there is one rank, 0, and every operation is local.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "common/Error.hpp"
#include "common/Types.hpp"

namespace tooljoint::parallel {

int rank();
int size();

/// Ranks that do a piece of work: this rank alone, or all ranks together. The latter call is
/// collective; every rank passes the same and gets the same.
enum class Ranks { Own, All };

/// Every rank gets the value of `root`, sizes included. Collective. Available for std::string,
/// std::vector<double>, std::vector<int>, Vector, Matrix, double and int; include
/// common/Message.hpp for any other type that cereal can serialise.
template <class T>
void broadcast(T& value, int root = 0);
void broadcastBytes(std::string& bytes, int root);

/// Sum over the ranks, maximum over the ranks; the result is the same on each. Collective.
double sum(double value);
double maximum(double value);

/// Runs `work` on every rank. If it throws on any of them, every rank throws an Error of the same
/// kind, with the exit code and sentence of the lowest failing rank (an exception other than
/// tooljoint::Error becomes ExitCode::Internal). Collective. `work` must not contain a collective
/// call that a failing rank would miss; otherwise all ranks are ended, as by meetFailing().
void agree(const std::function<void()>& work);

/// Ends the work of this rank with an error. Returns when the error has ended all other ranks, too.
/// If they do not end within a while, only this rank has failed: the error is printed with the
/// rank, and all ranks end with its code. Called by every failing rank, and by no other.
void meetFailing(ExitCode code, const std::string& sentence);

/// Throws the type that belongs to `code` (DeckError for InvalidDeck, ...), so that it can be
/// caught by type.
[[noreturn]] void throwError(ExitCode code, const std::string& sentence);

}  // namespace tooljoint::parallel
