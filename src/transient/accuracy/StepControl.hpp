// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Step size for a given error. Steps are the longest step halved `level` times; an error of third
/// order decreases to an eighth per halving. The step is lengthened only if the longer step is
/// likely to last, because each change costs a factorisation.
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
/// about the moving mass. Without nodes that translate (shafts that only rotate, models without
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
  /// Accepts errors up to `tolerance`. Steps are halved up to `deepest` times, on a grid of
  /// `finest` halvings.
  void set(double tolerance, int deepest, int finest);

  /// Halvings for the next try after a step with this error at this level; above deepest() if
  /// halving does not help.
  int shorter(double error, int level);
  /// Level of the next step after an accepted one. `done` counts the finished sub-steps of
  /// 2^-finest of the longest step; longer steps start only at multiples of their length. A longer
  /// step that cannot start yet is proposed again later.
  int next(double error, int level, long done);
  /// The step has been lengthened.
  void lengthened();
  /// The level has been changed for another reason.
  void forget() { calm_ = 0, largest_ = 0; }
  int deepest() const { return deepest_; }
  bool accepts(double error) const { return error <= tolerance_; }

  void save(std::vector<double>& memory) const;
  void restore(const double*& memory);

 private:
  double tolerance_ = 0;
  int deepest_ = 0, finest_ = 0;
  int patience_ = 0;    ///< required number of consecutive calm steps
  int calm_ = 0;        ///< steps since the level changed or the error was large
  double largest_ = 0;  ///< largest error in these steps
  bool tried_ = false;  ///< the step was lengthened and is on trial
  int since_ = 0;       ///< steps since then
};

}  // namespace tooljoint::transient
