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
  double error = 0;  ///< estimate of (f - f_full) / f_full, positive if the reduced frequency is
                     ///< too high; 0 for a rigid-body mode
  double full = 0;   ///< estimate of omega^2 of the full model [rad^2/s^2]
  double interfaces = 0;     ///< contribution of an interface reduction to `error`
  Vector byPart;             ///< contribution of the truncated modes of each part to `error`, parts
  bool isRigid = false;      ///< rigid-body motion, zero up to rounding
  bool definite = true;      ///< false: modes are missing below this frequency; `error` is then
                             ///< that of the nearest mode, less than the error of this number
  double frequency() const;  ///< sign(omega^2) sqrt(|omega^2|) / 2 pi [Hz], 0 for a rigid body
};

/// Selection of modes.
struct FrequencyWindow {
  int count = 20;      ///< this many of the lowest
  double belowHz = 0;  ///< or, if positive, all below this frequency
};

/// Errors of the lowest coupled modes. With the coupled mode y, D_p = Phi_p y_p and the residual
/// r_p = (K_p - lambda M_p) D_p,
///
///     lambda - lambda_full = sum_p [ r_I' F_p(lambda) r_I - D_p' r_p ] / D' M D
///
/// to first order. F_p(lambda) is the inverse of K_II - lambda M_II outside the basis. With
/// fixed-interface modes the formula is exactly the difference of the condensed dynamic stiffnesses
/// of the reduced and the full part; D_p' r_p sums to zero if the reduced matrices are projections.
/// F_p(lambda) r is computed on two Krylov vectors, and the first-order formula becomes a
/// Rayleigh-Ritz step on D and these vectors of all parts, so that large errors are correct too.
/// One factorisation per part, two solves per part and mode. Compare J.-G. Kim, K.-H. Lee and P.-S.
/// Lee, Comput. Struct. 139 (2014) 54-64, whose estimator is the term with F_p(0).
///
/// The formula gives the distance to the full mode of similar shape, independent of its number.
/// Whether the full model has more modes below is counted by Sylvester's law of inertia
/// (coupling::fullEigenvaluesBelow), once if there are none.
///
/// For a model with reduced interfaces the modes are compared with those of the coupled model
/// before that reduction, shape by shape, and the errors of the latter are estimated. This takes
/// one more eigenproblem, of the coupled model with whole interfaces. Every rank passes the same
/// arguments and gets the same result; parts are divided among the ranks. Collective.
std::vector<FrequencyEstimate> estimateFrequencies(const std::vector<model::Substructure>& parts,
                                                   const coupling::Synthesis& synthesis,
                                                   const FrequencyWindow& window = {});

/// A table: mode, frequency, estimated error, part with the largest contribution.
std::string frequencyTable(const std::vector<FrequencyEstimate>& estimates,
                           const std::vector<model::Substructure>& parts);

}  // namespace tooljoint::estimate
