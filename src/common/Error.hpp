// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Kinds of errors for users, with their exit codes (listed in docs/user-manual.md).
#pragma once

#include <stdexcept>
#include <string>

namespace tooljoint {

/// Exit codes of every tooljoint command; the same on every rank.
enum class ExitCode : int {
  Done = 0,
  Usage = 1,
  InvalidDeck = 2,
  ModelNotBuilt = 3,
  NotConverged = 4,
  Files = 5,
  Internal = 70,
  Interrupted = 130,
};

/// An error that a user can correct: a full sentence with the value found, the value expected and
/// the remedy.
class Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& sentence) : std::runtime_error(sentence), code_(code) {}
  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

/// Wrong command line (exit code 1).
struct UsageError : Error {
  explicit UsageError(const std::string& sentence) : Error(ExitCode::Usage, sentence) {}
};
/// Invalid deck, or a file named in a deck that is missing or malformed (exit code 2).
struct DeckError : Error {
  explicit DeckError(const std::string& sentence) : Error(ExitCode::InvalidDeck, sentence) {}
};
/// The deck is valid but no model can be built from it: a floating part, a singular matrix (exit
/// code 3).
struct ModelError : Error {
  explicit ModelError(const std::string& sentence) : Error(ExitCode::ModelNotBuilt, sentence) {}
};
/// A solver did not converge; the sentence states the attempt and the remedy (exit code 4).
struct ConvergenceError : Error {
  explicit ConvergenceError(const std::string& sentence)
      : Error(ExitCode::NotConverged, sentence) {}
};
/// Deck missing, folder not writable, disk full (exit code 5).
struct FileError : Error {
  explicit FileError(const std::string& sentence) : Error(ExitCode::Files, sentence) {}
};
/// The run was interrupted; results written so far are readable (exit code 130).
struct InterruptedError : Error {
  explicit InterruptedError(const std::string& sentence) : Error(ExitCode::Interrupted, sentence) {}
};

}  // namespace tooljoint
