// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What a scheme that damps vibration says of it: DampingSamples calls integrators with this
/// interface.
#pragma once

#include <string>

namespace tooljoint::transient {

struct State;

/// Unresolved contact in a smaller part of the steps changes little.
constexpr double oftenUnresolved = 0.1;

class NumericalDamping {
 public:
  virtual ~NumericalDamping() = default;
  /// Energy [J] that the scheme itself has taken in the step just accepted, beside the work of all
  /// forces.
  virtual double dissipated(const State& from, const State& to) const = 0;
  /// Whether contact rests on walls too stiff for the step just accepted and the one before: its
  /// force acts in full over each step, which damps vibration of the contact. Collective.
  virtual bool hasUnresolvedContact() const = 0;
  /// What to change for less of it; whole sentences.
  virtual std::string dampingAdvice() const = 0;
};

}  // namespace tooljoint::transient
