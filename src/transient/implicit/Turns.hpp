// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The strategy Turns. Where four relaxations of all points leave more than a part of the error,
/// every fourth point moves while the others stand, in turns: neighbours, which drive each other
/// apart when they move at once, then come to rest one after the other.
#pragma once

#include "transient/Strategies.hpp"
#include "transient/Tuned.hpp"

namespace tooljoint::transient {

class Turns {
 public:
  /// \param mostSweeps  over all points, before they are given up
  Turns(Strategies& strategies, int mostSweeps)
      : strategies_(&strategies), mostSweeps_(mostSweeps) {}

  bool areTaken() const { return turn_ >= 0; }
  /// Colour of the points that move next.
  int next() { return turn_++ % Tuned::colours; }
  /// After an iteration, counted from 1, that left an error; false where nothing is left to try.
  bool goOn(int iteration, double error) {
    if (areTaken()) return turn_ == 0 || turn_ % (2 * Tuned::colours) != 0 || progresses(error);
    if (iteration % Tuned::colours != 0) return true;
    const bool slow = iteration > Tuned::colours && error > Tuned::slowestRelaxation * last_;
    last_ = error;
    if (slow && !strategies_->use(Strategy::Turns)) return false;
    if (slow) turn_ = 0;
    return true;
  }

 private:
  /// After two sweeps.
  bool progresses(double error) {
    idle_ = error > Tuned::progress * last_ ? idle_ + 1 : 0;
    last_ = error;
    return turn_ < Tuned::colours * mostSweeps_ && idle_ <= Tuned::mostIdle;
  }

  Strategies* strategies_;
  int mostSweeps_;
  int turn_ = -1;    ///< -1: all points move at once
  int idle_ = 0;     ///< pairs of sweeps in a row without progress
  double last_ = 0;  ///< error where it was last compared
};

}  // namespace tooljoint::transient
