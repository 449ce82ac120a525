// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The few MPI operations that code outside src/linalg needs, over MPI_COMM_WORLD. Without MPI (not
/// initialised, or already finalised) there is one rank, 0, and every operation is local.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "common/Error.hpp"
#include "common/Types.hpp"

namespace tooljoint::parallel {

int rank();
int size();

/// Who does a piece of work: this rank alone, or all ranks together, each a share; the call is then
/// collective, every rank passes the same and gets the same.
enum class Ranks { Own, All };

/// Every rank ends with the value of `root`, sizes included. Collective. Ready for std::string,
/// std::vector<double>, std::vector<int>, Vector, Matrix, double and int; include
/// common/Message.hpp for any other type that cereal can serialise.
template <class T>
void broadcast(T& value, int root = 0);
void broadcastBytes(std::string& bytes, int root);

/// Sum over the ranks, maximum over the ranks; the result is the same on each. Collective.
double sum(double value);
double maximum(double value);

/// Run `work` on every rank; when it threw on any of them, every rank throws an Error of the same
/// kind, with the exit code and sentence of the lowest failing rank (an exception that is no
/// tooljoint::Error becomes ExitCode::Internal). Collective, and `work` must not hold a collective
/// call that a failing rank would miss: then, as meetFailing() does, all ranks are ended.
void agree(const std::function<void()>& work);

/// An error has ended the work of this rank. Returns once it has ended that of all others, too;
/// where they do not follow within a while, the error is one of this rank alone: it is printed with
/// the rank, and all ranks end with its code. Called by every rank that fails, and by no other.
void meetFailing(ExitCode code, const std::string& sentence);

/// Throw the type that belongs to `code` (DeckError for InvalidDeck, ...), so that it can be caught
/// as such.
[[noreturn]] void throwError(ExitCode code, const std::string& sentence);

}  // namespace tooljoint::parallel
