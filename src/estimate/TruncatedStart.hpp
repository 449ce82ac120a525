// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Free vibration of the part of an initial state that a basis does not represent.
#pragma once

#include <vector>

#include "estimate/PartResidual.hpp"

namespace tooljoint::estimate {

/// w(t) of M_II w'' + K_II w = 0 from the interior displacement and velocity outside the basis,
/// boundary dofs held, without damping. Solved on a Krylov space of M-orthonormal columns from
/// both, with the residual flexibility F: {w(0), w'(0), F M w(0), F M w'(0), ...}; its Ritz values
/// weight the frequencies according to their excitation by the start.
class TruncatedStart {
 public:
  /// Vectors in the dofs of the part, zero at its boundary dofs. Their components in its modes (in
  /// the mass norm) are excluded.
  void begin(const PartResidual& part, const Vector& displacement, const Vector& velocity);
  /// Adds w to a vector in the dofs of the part, t after the start; adds nothing before begin() or
  /// for a start in the basis.
  void add(double t, Vector& w) const;

 private:
  std::vector<int> interior_;
  Matrix shapes_;                   ///< M-orthonormal Ritz vectors, interior x modes
  Vector omega_;                    ///< [rad/s]
  Vector displacement_, velocity_;  ///< of the modes at the start
};

}  // namespace tooljoint::estimate
