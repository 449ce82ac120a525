// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What is said of laws of time that change faster than the steps of a run follow.
#pragma once

#include <vector>

#include "model/SecondOrderModel.hpp"
#include "transient/Integrator.hpp"

namespace tooljoint::transient {

struct JudgedSpan {
  double start, end;      ///< [s]
  double stepErrorLimit;  ///< of the run; from 1 on no law is refused
};

/// Of steps of one length that miss more than 1 % of the integral of a law over time it warns
/// (missedPart()); more than half is refused. Throws ConvergenceError.
void judgeLaws(const model::SecondOrderModel& model, const Integrator& run, const JudgedSpan& span);

/// The same of steps that choose their length by their error, which does not see what a law does
/// between the times at which a step evaluates it: each step is measured while the run goes.
class LawWatch {
 public:
  explicit LawWatch(const model::SecondOrderModel& model);
  /// A step, or a part of one. What is shorter than a sixteenth of it may be missed.
  void look(double begin, double end);
  /// As judgeLaws().
  void judge(const Integrator& run, double stepErrorLimit) const;

 private:
  struct Watched {
    const model::ScalarLaw* law;
    double sum = 0;     ///< integral of its size
    double missed = 0;  ///< by Gauss's rule with three points in each step, about what methods with
                        ///< stages see
    double lost = 0;    ///< by the ends of the steps, which is all that others see
  };
  std::vector<Watched> laws_;
};

}  // namespace tooljoint::transient
