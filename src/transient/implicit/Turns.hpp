// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The strategy Turns. If four relaxations of all points leave more than a given part of the error,
/// every fourth point is corrected while the others are held, in turns. Neighbours that disturb
/// each other when corrected at once then converge one after the other.
#pragma once

#include "transient/Strategies.hpp"
#include "transient/Tuned.hpp"

namespace tooljoint::transient {

class Turns {
 public:
  /// \param mostSweeps limit of sweeps over all points
  Turns(Strategies& strategies, int mostSweeps)
      : strategies_(&strategies), mostSweeps_(mostSweeps) {}

  bool areTaken() const { return turn_ >= 0; }
  /// Colour of the points to correct next.
  int next() { return turn_++ % Tuned::colours; }
  /// Call after an iteration, counted from 1, with its error; false if there is nothing left to
  /// try.
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
  /// Evaluates two sweeps.
  bool progresses(double error) {
    idle_ = error > Tuned::progress * last_ ? idle_ + 1 : 0;
    last_ = error;
    return turn_ < Tuned::colours * mostSweeps_ && idle_ <= Tuned::mostIdle;
  }

  Strategies* strategies_;
  int mostSweeps_;
  int turn_ = -1;    ///< -1: all points are corrected at once
  int idle_ = 0;     ///< consecutive pairs of sweeps without progress
  double last_ = 0;  ///< error at the last comparison
};

}  // namespace tooljoint::transient
