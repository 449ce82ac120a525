// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Step size for friction that weakens with speed. Sliding that reverses passes the peak of the
/// friction at low speed, which may hold the point. A step across it sees the forces at its ends
/// only, and the point slides on where it should stick. With f_1 the friction at the end of the
/// step, at the velocity v_1 against that at its start, a step of length h resolves the peak if
///
///     h W max_s (f(s v_1) - f_1) <= a |v_1|,   0 < s < 1,   W = r M^-1 r'
///
/// Friction that does not weaken has no such step: it stops the point in the next one. Nor has a
/// force that is larger before the reversal, such as that of a bit whose drilling speed varies.
#pragma once

#include <vector>

#include "transient/compiled/CompiledModel.hpp"
#include "transient/compiled/MassFactor.hpp"

namespace tooljoint::transient {

struct State;

class FrictionPeaks {
 public:
  /// Binds with an inverted mass. Collective.
  void bind(CompiledModel& model, const MassFactor& mass);
  /// Whether the step from `from` to `to` of length h, just taken, resolves the peaks that it
  /// passes. Collective.
  bool resolved(const State& from, const State& to, double h);

 private:
  bool passes(int batch, int point, const State& from, const State& to, double h);

  CompiledModel* model_ = nullptr;
  bool any_ = false;                           ///< any rank has laws without walls
  std::vector<std::vector<double>> mobility_;  ///< W per row, for each batch; empty: has walls
  std::vector<double> velocity_, force_;       ///< of one point
};

}  // namespace tooljoint::transient
