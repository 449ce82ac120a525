// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Which step an error needs. Steps are the longest one cut into halves `level` times; an error
/// of third order falls to an eighth per halving. Longer steps come only when they will last: each
/// change of the step costs a factorisation.
#pragma once

#include <vector>

#include "common/Types.hpp"
#include "transient/compiled/CompiledModel.hpp"

namespace tooljoint::transient {

/// Size of a displacement as a length, the same for a model and its reductions: mean square over
/// the mass,
///
///     |e|^2 = e'M e / m,   m = sum_j M_jj / sum_j g_j
///
/// with g_j the mean over the nodes of |translation|^2 for a unit of coordinate j, so that m is
/// about the mass that moves. Without nodes that move along (shafts that only turn, models without
/// output) each coordinate counts as a length.
class MassNorm {
 public:
  void bind(const CompiledModel& model);
  double operator()(const Vector& e) const;
  double mass() const { return mass_; }  ///< m

 private:
  const CompiledModel* model_ = nullptr;
  double mass_ = 1;
};

class StepControl {
 public:
  /// Errors up to `tolerance` are accepted; halvings up to `deepest`, on a grid of `finest`
  /// halvings.
  void set(double tolerance, int deepest, int finest);

  /// Halvings the step has to be tried with after one of this error at this level; beyond deepest()
  /// when nothing helps.
  int shorter(double error, int level);
  /// Level that the next step may have after an accepted one; `done` sub-steps of 2^-finest of the
  /// longest step lie behind, so that longer steps start at multiples of themselves. What is not
  /// taken is offered again.
  int next(double error, int level, long done);
  /// The step was lengthened.
  void lengthened();
  /// The level was changed for another reason.
  void forget() { calm_ = 0, largest_ = 0; }
  int deepest() const { return deepest_; }
  bool accepts(double error) const { return error <= tolerance_; }

  void save(std::vector<double>& memory) const;
  void restore(const double*& memory);

 private:
  double tolerance_ = 0;
  int deepest_ = 0, finest_ = 0;
  int patience_ = 0;    ///< steps in a row that have to be calm
  int calm_ = 0;        ///< steps since the level changed or the error was large
  double largest_ = 0;  ///< error of these
  bool tried_ = false;  ///< the step was lengthened and has not yet proved itself
  int since_ = 0;       ///< steps since then
};

}  // namespace tooljoint::transient
