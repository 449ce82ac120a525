// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Verdict on laws of time that change faster than the steps of a run resolve.
#pragma once

#include <vector>

#include "model/SecondOrderModel.hpp"
#include "transient/Integrator.hpp"

namespace tooljoint::transient {

struct JudgedSpan {
  double start, end;      ///< [s]
  double stepErrorLimit;  ///< of the run; no law is refused if it is 1 or more
};

/// Judges steps of equal length: warns if they miss more than 1 % of the integral of a law over
/// time (missedPart()), refuses more than half. Throws ConvergenceError.
void judgeLaws(const model::SecondOrderModel& model, const Integrator& run, const JudgedSpan& span);

/// The same for steps with error control. The error does not show how a law varies between the
/// times at which a step evaluates it, so each step is measured during the run.
class LawWatch {
 public:
  explicit LawWatch(const model::SecondOrderModel& model);
  /// A step, or a part of one. Features shorter than a sixteenth of it may be missed.
  void look(double begin, double end);
  /// As judgeLaws().
  void judge(const Integrator& run, double stepErrorLimit) const;

 private:
  struct Watched {
    const model::ScalarLaw* law;
    double sum = 0;     ///< integral of |f|
    double missed = 0;  ///< by Gauss's rule with three points, about as methods with stages
    double lost = 0;    ///< by the ends of the steps, as methods without stages
  };
  std::vector<Watched> laws_;
};

}  // namespace tooljoint::transient
