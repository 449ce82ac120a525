// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The string of `tooljoint buckling` as a problem with the weight on bit as parameter.
#pragma once

#include "statics/PathContinuation.hpp"
#include "substructures/drillstring/buckling/BucklingState.hpp"
#include "substructures/drillstring/scene/Scene.hpp"
#include "substructures/equilibrium/LoadPath.hpp"
#include "substructures/equilibrium/Settling.hpp"

namespace tooljoint::drillstring {

/// Without friction, laws of bit and drive, and motion. The parameter p of its paths is the weight
/// on bit, or the reduction of the last weight.
class BucklingModel {
 public:
  /// \param last  weight on bit [N]. DeckError: no wall, the bit is held along the hole, or the
  ///              geometric stiffness is switched off.
  BucklingModel(const Scene& scene, double last);
  BucklingModel(const BucklingModel&) = delete;  // its problems point into it
  BucklingModel& operator=(const BucklingModel&) = delete;

  /// Dofs of the static state of the straight string without weight on bit, as accurate as states
  /// of the path: relative to the largest load of the path.
  Vector start(const equilibrium::LoadPath& problem) const;
  /// Makes the string crooked and moves x from the straight to the crooked state without weight on
  /// bit, along a separate path. ConvergenceError.
  void bend(double amplitude, double pitch, statics::PathOptions options, Vector& x);
  /// Makes the string crooked as bend() does, for a known state.
  void setCrooked(double amplitude, double pitch);
  /// After this call p is the reduction of the last weight.
  void unload();
  bool unloads() const { return unloads_; }
  double last() const { return last_; }
  /// Weight on bit [N].
  double weightOnBit(double p) const { return unloads_ ? last_ - p : p; }

  /// The state that the string reaches at p when it leaves the unstable state `x` of the path in
  /// the direction `towards`. ConvergenceError if there is none.
  Vector jump(const equilibrium::LoadPath& problem, const Vector& x, const Vector& towards,
              double p) const;

  equilibrium::LoadPath problem() const { return {input_, load_}; }
  BucklingMeasure measure(const equilibrium::LoadPath& problem) const {
    return {scene_, path_, input_, problem.problem()};
  }

 private:
  Vector pathWeights() const;
  Vector crooked(double amplitude, double pitch) const;
  equilibrium::UnstableMode unstableMode(const equilibrium::LoadPath& problem, const Vector& x,
                                         const Vector& towards) const;
  double scaleOfPath() const { return equilibrium::StaticProblem(input_).largestLoad(); }

  Scene scene_;
  path::PathState path_;
  equilibrium::StaticInput input_;
  equilibrium::GrowingLoad load_;
  double last_;
  bool unloads_ = false;
};

}  // namespace tooljoint::drillstring
