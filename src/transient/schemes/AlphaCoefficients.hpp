// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Coefficients of the generalized-alpha scheme (J. Chung and G. M. Hulbert, J. Appl. Mech. 60
/// (1993) 371-375) for a spectral radius at infinite frequency, and of its phase correction.
#pragma once

#include "transient/implicit/StepScheme.hpp"

namespace tooljoint::transient {

struct AlphaCoefficients {
  AlphaCoefficients(double radius, bool phaseCorrection);

  /// Scheme for steps of length h. If contact `rests`, forces of impacts enter the displacement as
  /// 1/2 h^2 M^-1 f.
  StepScheme scheme(double h, bool rests) const;
  /// Local error of the displacement in a step, over h^2 times the change of A.
  double localError() const { return (m - f) / 2 + beta - 1.0 / 6; }

  double m, f, beta, gamma;      ///< alpha_m, alpha_f
  double filter = 0, phase = 0;  ///< s, k of the phase correction

 private:
  void setPhaseCorrection();
};

}  // namespace tooljoint::transient
