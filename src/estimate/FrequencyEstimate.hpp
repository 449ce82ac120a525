// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A-posteriori error of the eigenfrequencies of a coupled reduced model, from the residuals of its
/// modes part by part.
#pragma once

#include <string>
#include <vector>

#include "common/Types.hpp"
#include "coupling/Synthesis.hpp"

namespace tooljoint::estimate {

/// One coupled mode.
struct FrequencyEstimate {
  double eigenvalue = 0;  ///< omega^2 of the coupled model [rad^2/s^2]
  double error = 0;  ///< estimate of (f - f_full) / f_full, positive where the reduced frequency is
                     ///< too high; 0 for a rigid body
  double full = 0;   ///< estimate of omega^2 of the full model [rad^2/s^2]
  double interfaces = 0;     ///< contribution of an interface reduction to `error`
  Vector byPart;             ///< contribution of the truncated modes of each part to `error`, parts
  bool isRigid = false;      ///< motion of a rigid body, zero but for rounding
  bool definite = true;      ///< false: modes are missing below this frequency, and `error`, that
                             ///< of the nearest one, is less than the error of this number
  double frequency() const;  ///< sign(omega^2) sqrt(|omega^2|) / 2 pi [Hz], 0 of a rigid body
};

/// Which modes.
struct FrequencyWindow {
  int count = 20;      ///< the lowest so many
  double belowHz = 0;  ///< or, when positive, all below this frequency
};

/// Errors of the lowest coupled modes. With the coupled mode y, D_p = Phi_p y_p and the residual
/// r_p = (K_p - lambda M_p) D_p,
///
///     lambda - lambda_full = sum_p [ r_I' F_p(lambda) r_I - D_p' r_p ] / D' M D      to first
///     order,
///
/// F_p(lambda) the inverse of K_II - lambda M_II outside the basis. With fixed-interface
/// modes that is the difference of the condensed dynamic stiffnesses of the reduced and the full
/// part, exactly; D_p' r_p sums up to zero where the reduced matrices are projections. F_p(lambda)
/// r is taken on two Krylov vectors, and the first-order formula becomes a Rayleigh-Ritz step on D
/// and these vectors of all parts, so that large errors are right as well. One factorisation a
/// part, two solves a part and mode. Compare J.-G. Kim, K.-H. Lee and P.-S. Lee, Comput. Struct.
/// 139 (2014) 54-64, whose estimator is the term with F_p(0).
///
/// The formula gives the distance to the full mode that is like it, whatever its number. Whether
/// the full model has more modes below is counted by Sylvester's law of inertia
/// (coupling::fullEigenvaluesBelow), once where there are none.
///
/// Of a model with reduced interfaces the modes are compared with those of the coupled model before
/// that reduction, shape by shape, and the errors are estimated of the latter: one more
/// eigenproblem, of the coupled model with whole interfaces. Every rank passes the same and gets
/// the same; parts are shared out. Collective.
std::vector<FrequencyEstimate> estimateFrequencies(const std::vector<model::Substructure>& parts,
                                                   const coupling::Synthesis& synthesis,
                                                   const FrequencyWindow& window = {});

/// A table: mode, frequency, estimated error, part that contributes most.
std::string frequencyTable(const std::vector<FrequencyEstimate>& estimates,
                           const std::vector<model::Substructure>& parts);

}  // namespace tooljoint::estimate
