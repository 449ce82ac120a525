// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Free vibration of what a basis does not represent of the start of a motion.
#pragma once

#include <vector>

#include "estimate/PartResidual.hpp"

namespace tooljoint::estimate {

/// w(t) of M_II w'' + K_II w = 0 from the interior displacement and velocity that are not in the
/// basis, boundary dofs held, without damping. Solved on a Krylov space of M-orthonormal columns
/// from both, with the residual flexibility F: {w(0), w'(0), F M w(0), F M w'(0), ...}; its Ritz
/// values weigh the frequencies as the start excites them.
class TruncatedStart {
 public:
  /// Vectors in the dofs of the part, zero at its boundary dofs; what its modes represent of them
  /// (in the mass norm) is left out.
  void begin(const PartResidual& part, const Vector& displacement, const Vector& velocity);
  /// Adds w to a vector in the dofs of the part, t after the start; nothing before begin() or for a
  /// start in the basis.
  void add(double t, Vector& w) const;

 private:
  std::vector<int> interior_;
  Matrix shapes_;                   ///< M-orthonormal Ritz vectors, interior x modes
  Vector omega_;                    ///< [rad/s]
  Vector displacement_, velocity_;  ///< of the modes at the start
};

}  // namespace tooljoint::estimate
