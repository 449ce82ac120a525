// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Whether the energy balance invalidates a motion: more energy generated than supplied, or a
/// larger residual than the deck accepts.
#pragma once

#include <string>

#include "transient/TransientParameters.hpp"
#include "transient/accuracy/EnergyLedger.hpp"

namespace tooljoint::transient {

class EnergyVerdict {
 public:
  explicit EnergyVerdict(const TransientOptions& options) : options_(options) {}

  /// Evaluates a sample: true if the balance has been wrong for so long that the run ends. One
  /// sample is not enough: a start far from equilibrium may overshoot and is damped again.
  bool refuses(const EnergyAccount& account);
  /// At the end of the motion, time t. Throws ConvergenceError, or warns.
  /// \param advice of the integrator
  void judge(const EnergyAccount& account, double t, const std::string& advice) const;
  [[noreturn]] void refuse(const EnergyAccount& account, double t, const std::string& advice) const;

  /// Consecutive wrong samples; a checkpoint stores them.
  int wrongSamples = 0;

 private:
  bool isWrong(const EnergyAccount& account) const;

  const TransientOptions& options_;
};

}  // namespace tooljoint::transient
