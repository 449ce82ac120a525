// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Modes of the full and of the coupled reduced model side by side: frequencies, shapes (MAC), and true against estimated errors.
#pragma once

#include <complex>
#include <string>
#include <vector>

#include "coupling/Synthesis.hpp"
#include "linalg/EigenSolver.hpp"

namespace tooljoint::estimate {

/// A full mode and the coupled mode of the same shape.
struct ModeComparison {
  int coupledMode = 0;           ///< 0-based number of the coupled mode with the largest MAC
  std::complex<double> full;     ///< undamped: i omega (omega < 0: divergent at |omega|); damped: s [1/s]
  std::complex<double> coupled;
  double mac = 0;                ///< |psi^H M phi|^2 / (psi^H M psi phi^H M phi) of the full shape and the recovered coupled one
  double error = 0;              ///< undamped: f / f_full - 1; damped: |s - s_full| / |s_full|
  double estimate = 0;           ///< of `error`, without the full model
  bool estimated = true;         ///< false: no estimate for this basis (MacNeal, dual Craig-Bampton)
  bool definite = true;          ///< see FrequencyEstimate
  double fullHz() const;         ///< |s| / 2 pi, negative for a divergent mode
  double coupledHz() const;
  double fullDamping() const { return full == 0.0 ? 0.0 : 0.0 - full.real() / std::abs(full); }  ///< damping ratio
  double coupledDamping() const { return coupled == 0.0 ? 0.0 : 0.0 - coupled.real() / std::abs(coupled); }
};

/// The model about its initial state with the laws and point laws of time t.
struct Linearised {
  Sparse mass, damping, stiffness;  ///< damping and stiffness unsymmetric
};
Linearised linearise(const model::SecondOrderModel& model, double t);

/// Motions of the coupled model in the dofs of the full one: column by column, dofs matched by their labels, or, where the full model was itself
/// coupled from unreduced parts, D_p = maps[p] z, by least squares over all parts. Throws ModelError when a dof of the full model is in no part.
Eigen::MatrixXcd recover(const model::SecondOrderModel& full, const std::vector<model::Substructure>& parts,
                         const coupling::Synthesis& synthesis, const Eigen::MatrixXcd& shapes, const std::vector<Sparse>& maps = {});

/// M-weighted modal assurance criterion (R. J. Allemang and D. L. Brown, Proc. IMAC 1 (1982) 110-116), rows: columns of a, columns: of b.
Matrix modalAssurance(const Sparse& M, const Eigen::MatrixXcd& a, const Eigen::MatrixXcd& b);

/// The lowest `count` undamped modes (symmetric part of K at t = 0, closed contacts linear). Collective.
std::vector<ModeComparison> compareModes(const model::SecondOrderModel& full, const std::vector<model::Substructure>& parts,
                                         const coupling::Synthesis& synthesis, int count, const std::vector<Sparse>& maps = {});

/// The same with all modes of `exact`, those of the full model by coupling::lowestModes, which many reduced models can share.
std::vector<ModeComparison> compareModes(const model::SecondOrderModel& full, const linalg::EigenPairs& exact,
                                         const std::vector<model::Substructure>& parts, const coupling::Synthesis& synthesis,
                                         const std::vector<Sparse>& maps = {});

/// The `count` damped modes of smallest |s|, gyroscopic and circulatory matrices of time t included. Their errors are estimated with left and right
/// modes, z and y, of the coupled model: s - s_full = -sum_p l_I' F_p r_I / z' (2 s m + c) y with the residuals r = Q(s) Phi y and
/// l = Q(s)' Phi z, Q = s^2 M + s C + K.
std::vector<ModeComparison> compareDampedModes(const model::SecondOrderModel& full, const std::vector<model::Substructure>& parts,
                                               const coupling::Synthesis& synthesis, int count, double t,
                                               const std::vector<Sparse>& maps = {});

/// A table; with damping ratios when `damped`.
std::string comparisonTable(const std::vector<ModeComparison>& modes, bool damped);

}  // namespace tooljoint::estimate
