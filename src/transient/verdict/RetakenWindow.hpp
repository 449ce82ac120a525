// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Repeats some steps of a run in steps of half the length. A second object of the integrator does
/// this with its own points, factor, counters and memory and leaves the model unchanged, so that
/// the run is not affected.
///
/// The velocity of a scheme for a given motion depends on the step. A window repeated with the
/// velocity of the run would start with an error of the scheme's order that the run does not have.
/// The velocity is therefore corrected until the first step ends where that of the run does.
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
  /// Starts a window at the current state of the run.
  void begin(const Integrator& run, const State& from);
  /// Displacement at the end of the first step of the run in the window.
  void endFirst(const Vector& q) { first_ = q; }
  /// Repeats the window. False if its equations have no solution.
  bool take(double endOfFirst, double end);
  const Vector& start() const { return from_.q; }
  const Vector& end() const { return state_.q; }  ///< at the end of the halves

  /// Memory of the second object, and of the window if `underWay`.
  void save(std::vector<double>& memory, bool underWay) const;
  void restore(const double*& memory, bool underWay);

 private:
  template <class Work>
  void withModel(const Work& work);
  void takeUntil(double t);

  CompiledModel* model_;
  std::unique_ptr<Integrator> second_;
  std::vector<PointBatch> points_;  ///< of the second object
  TimedTerms::Snapshot snapshot_;   ///< of the run
  double h_;
  State from_;                   ///< start of the window
  Vector first_;                 ///< displacement at the end of its first step
  std::vector<double> history_;  ///< saved by the integrator at the start of the window
  std::vector<double> scales_;   ///< scales of all points there
  State state_, to_;
};

}  // namespace tooljoint::transient
