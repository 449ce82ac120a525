// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Truncated motion of one part and its load on the coupled model.
#pragma once

#include <functional>
#include <vector>

#include "coupling/Synthesis.hpp"
#include "estimate/ResidualFlexibility.hpp"

namespace tooljoint::estimate {

/// Estimates need the residuals of a Rayleigh-Ritz method: throws ModelError, naming the basis, if
/// mass or interfaces of a part are not those of the space (MacNeal, dual Craig-Bampton).
void requireRitz(const coupling::Synthesis& synthesis);
/// False if requireRitz throws.
bool isRitz(const coupling::Synthesis& synthesis);
/// Calls `estimate` if the basis has estimates. False if it has none or, with a warning, if a part
/// has none because its interior is a mechanism: modes can be compared without estimates.
/// Collective.
bool estimable(const coupling::Synthesis& synthesis, const std::function<void()>& estimate);

/// State of a part, or means over an interval.
struct PartMotion {
  Vector displacement, velocity, acceleration;
};

/// One part with truncated modes.
class PartResidual {
 public:
  /// \param map coordinates of the part = map * coupled dofs + mapOffset
  PartResidual(const model::Substructure& part, const reduction::ReducedSubstructure& reduced,
               const Sparse& map, const Vector& mapOffset);

  bool complete() const { return flexibility_.truncated() == 0; }
  const model::Substructure& part() const { return part_; }
  const reduction::ReducedSubstructure& reduced() const { return reduced_; }

  const ResidualFlexibility& flexibility() const { return flexibility_; }

  /// D = offset + Phi q and its derivatives from coupled coordinates.
  PartMotion motion(const Vector& q, const Vector& qDot, const Vector& qDDot) const;
  /// w = -F r, r = M D'' + C(t) D' + K(t) D - F(t) - point forces; dofs of the part, zero at
  /// boundary dofs.
  Vector truncated(double t, const PartMotion& mean, const Vector& pointForce) const;
  /// Phi' (M w), Phi' (K(t) w) and so on, in coupled dofs.
  void scatter(const Vector& force, Vector& coupled) const;
  /// Sum of the terms at time t, times x.
  Vector stiffnessTimes(double t, const Vector& x) const;
  Vector dampingTimes(double t, const Vector& x) const;
  /// Strain energy of w.
  double energy(const Vector& w) const { return w.dot(constant_ * w); }

 private:
  double law(int index, double t) const {
    return part_.model.laws[static_cast<std::size_t>(index)].value(t);
  }

  const model::Substructure& part_;
  const reduction::ReducedSubstructure& reduced_;
  Sparse constant_;
  Sparse basis_;       ///< Phi map: dofs of the part x coupled dofs
  Sparse transposed_;  ///< its transpose
  Vector offset_;      ///< displacement for zero coupled dofs
  ResidualFlexibility flexibility_;
};

}  // namespace tooljoint::estimate
