// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Some steps of a run, taken again in steps of half the length by a second object of the
/// integrator, which has points, factor, counters and memory of its own and leaves the model as it
/// was: the run does not notice it.
///
/// A scheme has a velocity of its own for a motion, which depends on the step: a window taken again
/// with the velocity of the run would begin with an error of the scheme's order that the run does
/// not have. The velocity is corrected until the first step ends where that of the run does.
#pragma once

#include <memory>
#include <vector>

#include "transient/Integrator.hpp"

namespace tooljoint::transient {

class RetakenWindow {
 public:
  /// \param run     prepared
  /// \param second  made from the same parameters
  /// \param window  of the whole run, with its step h
  RetakenWindow(CompiledModel& model, const Integrator& run, std::unique_ptr<Integrator> second,
                const Window& window, const State& start);
  /// The window begins where the run is.
  void begin(const Integrator& run, const State& from);
  /// Its first step in the run ended there.
  void endFirst(const Vector& q) { first_ = q; }
  /// Takes it again. False when its equations have no solution.
  bool take(double endOfFirst, double end);
  const Vector& start() const { return from_.q; }
  const Vector& end() const { return state_.q; }  ///< of the halves

  /// Of the second object; and of the window, where one is under way.
  void save(std::vector<double>& memory, bool underWay) const;
  void restore(const double*& memory, bool underWay);

 private:
  template <class Work>
  void withModel(const Work& work);
  void takeUntil(double t);

  CompiledModel* model_;
  std::unique_ptr<Integrator> second_;
  std::vector<PointBatch> points_;    ///< of the second object
  CompiledModel::Snapshot snapshot_;  ///< of the run
  double h_;
  State from_;                   ///< where the window began
  Vector first_;                 ///< displacement at the end of its first step
  std::vector<double> history_;  ///< of the integrator where it began
  std::vector<double> scales_;   ///< of all points there
  State state_, to_;
};

}  // namespace tooljoint::transient
