// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Steps taken a second time as two halves: the difference, e_v of the velocity, is a local error
/// measured, contact and iterations included. Beside the velocity it says how much of the motion a
/// step spoils, beside the change of velocity how much of the force is wrong; steps that err
/// independently spoil, in the time |v| / |q''| in which the velocity changes, the geometric mean
/// of both:
///
///     D^2 = <|e_v|^2> / sqrt(<|v|^2> <|v_{n+1} - v_n|^2>)
///
/// with |.| of MassNorm and means over the steps looked at; of |e_v|^2 without its largest quarter,
/// which is what happens once, such as a ball that lands within the step; of |v|^2 = |q_{n+1} -
/// q_n|^2 / h^2 over the run. What a contact that lasts as an impact leaves in v
/// (HalvedStep::clean) depends on the step and is no motion: it is taken out. The halves have
/// points, factor, counters and memory of their own and leave the model as it was: the run does not
/// notice them.
#pragma once

#include <memory>
#include <vector>

#include "transient/accuracy/HalvedStep.hpp"
#include "transient/accuracy/StepControl.hpp"

namespace tooljoint::transient {

class StepDoublingError {
 public:
  /// For steps of length h in a run of this many, which starts at `state`.
  void bind(CompiledModel& model, std::unique_ptr<HalvedStep> halves, const State& state, double h,
            long steps);
  /// Whether the step after so many is to be looked at.
  bool isDue(long steps) const { return steps >= next_; }
  /// The step that the run has just taken; false when its halves say nothing.
  bool look(const State& from, const State& to);
  /// Where the halves of the last look() ended.
  const State& end() const { return end_; }
  /// D, for a root of the mean square of the velocity taken from the whole run; 0 for a run too
  /// short to say.
  double ratio(double speed) const;

  void save(std::vector<double>& memory) const;
  void restore(const double*& memory);

 private:
  template <class Work>
  void withModel(const Work& work);
  void shareImpacts();
  void plan();

  CompiledModel* model_ = nullptr;
  std::unique_ptr<HalvedStep> halves_;
  std::vector<PointBatch> points_;    ///< of the halves
  CompiledModel::Snapshot snapshot_;  ///< of the run
  MassNorm size_;
  State end_;
  Vector before_, velocity_, ofHalves_;
  long stride_ = 0;             ///< mean distance of the steps looked at
  long seen_ = 0;               ///< steps looked at
  long next_ = 0;               ///< the next one
  std::vector<double> errors_;  ///< |e_v|^2 of steps looked at
  double change_ = 0;           ///< sum of |v_{n+1} - v_n|^2 over these
};

}  // namespace tooljoint::transient
