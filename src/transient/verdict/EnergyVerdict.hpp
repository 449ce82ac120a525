// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Whether the energy balance of a motion speaks against it: more energy made than was given, or a
/// balance that is open by more than the deck accepts.
#pragma once

#include <string>

#include "transient/TransientParameters.hpp"
#include "transient/accuracy/EnergyLedger.hpp"

namespace tooljoint::transient {

class EnergyVerdict {
 public:
  explicit EnergyVerdict(const TransientOptions& options) : options_(options) {}

  /// Of a sample of the motion: whether the balance has been wrong for so long that the run ends. A
  /// start far from equilibrium may overshoot and is damped again, so one sample is not enough.
  bool refuses(const EnergyAccount& account);
  /// At the time t that the motion ends at. ConvergenceError, or a warning.
  /// \param advice of the integrator
  void judge(const EnergyAccount& account, double t, const std::string& advice) const;
  [[noreturn]] void refuse(const EnergyAccount& account, double t, const std::string& advice) const;

  /// Samples in a row that were wrong: a checkpoint holds them.
  int wrongSamples = 0;

 private:
  bool isWrong(const EnergyAccount& account) const;

  const TransientOptions& options_;
};

}  // namespace tooljoint::transient
