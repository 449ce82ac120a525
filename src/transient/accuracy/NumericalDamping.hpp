// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Interface of integrators whose scheme damps vibration (see DampingSamples).
#pragma once

#include <string>

namespace tooljoint::transient {

struct State;

/// Fraction of the steps; unresolved contact in fewer steps has little effect.
constexpr double oftenUnresolved = 0.1;

class NumericalDamping {
 public:
  virtual ~NumericalDamping() = default;
  /// Energy [J] dissipated by the scheme itself in the last accepted step, apart from the work of
  /// all forces.
  virtual double dissipated(const State& from, const State& to) const = 0;
  /// Whether contact rests on walls too stiff for the last accepted step and the one before. Its
  /// force then acts in full over each step, which damps vibration of the contact. Collective.
  virtual bool hasUnresolvedContact() const = 0;
  /// How to reduce the damping; whole sentences.
  virtual std::string dampingAdvice() const = 0;
};

}  // namespace tooljoint::transient
