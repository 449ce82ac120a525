// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Modes of the full and of the coupled reduced model side by side: frequencies, shapes (MAC), and
/// true against estimated errors.
#pragma once

#include <complex>
#include <string>
#include <vector>

#include "coupling/Synthesis.hpp"
#include "estimate/ModeMatching.hpp"
#include "linalg/trilinos/EigenSolver.hpp"

namespace tooljoint::estimate {

/// A full mode and the coupled mode of the same shape (matchModes); each coupled mode is paired
/// with at most one full mode.
struct ModeComparison {
  int coupledMode = -1;  ///< 0-based number among the physical coupled modes; -1: no partner, and
                         ///< the error is 1
  std::complex<double> full;  ///< undamped: i omega (omega < 0: omega^2 < 0); damped: s [1/s]; 0
                              ///< for a rigid-body mode (zero up to rounding)
  std::complex<double> coupled;
  double mac = 0;  ///< ModeMatch::mac of the full shape and the recovered coupled one
  double error =
      0;  ///< undamped: f / f_full - 1; damped: |s - s_full| / |s_full|; 0 for a rigid-body mode
  double estimate = 0;    ///< of `error`, without the full model
  bool estimated = true;  ///< false: no estimate for this basis (MacNeal, dual Craig-Bampton)
  bool definite = true;   ///< see FrequencyEstimate
  double fullHz() const;  ///< |s| / 2 pi; undamped modes with omega^2 < 0: negative
  double coupledHz() const;
  double fullImHz() const;  ///< Im s / 2 pi
  double coupledImHz() const;
  double fullDamping() const {
    return full == 0.0 ? 0.0 : 0.0 - full.real() / std::abs(full);
  }  ///< damping ratio
  double coupledDamping() const {
    return coupled == 0.0 ? 0.0 : 0.0 - coupled.real() / std::abs(coupled);
  }
};

/// The model about its initial state with the laws and point laws of time t.
struct Linearised {
  Sparse mass, damping, stiffness;  ///< damping and stiffness unsymmetric
};
/// With held states of point laws.
Linearised linearise(const model::SecondOrderModel& model, double t);
/// With moving states (model::tangentByStates) in motions e^{s t} [1/s]: their contribution to K +
/// s C, as real K and C (for a real s all in K).
Linearised linearise(const model::SecondOrderModel& model, double t, Complex s);
/// The same for s = i omega, omega >= 0 [rad/s].
Linearised linearise(const model::SecondOrderModel& model, double t, double omega);

/// Motions of the coupled model in the dofs of the full one, column by column. Dofs are matched by
/// their labels or, if the full model was itself coupled from unreduced parts with D_p = maps[p] z,
/// by least squares over all parts. Throws ModelError if a dof of the full model is in no part.
Eigen::MatrixXcd recover(const model::SecondOrderModel& full,
                         const std::vector<model::Substructure>& parts,
                         const coupling::Synthesis& synthesis, const Eigen::MatrixXcd& shapes,
                         const std::vector<Sparse>& maps = {});

/// Full modes for a comparison of the `count` lowest ones, some more so that no repeated value is
/// cut: coupling::lowestModes.
linalg::EigenPairs modesToCompare(const model::SecondOrderModel& full, int count);

/// i omega of each eigenvalue omega^2 (omega < 0 if omega^2 < 0); 0 if phi'K phi = omega^2 phi'M
/// phi is zero up to rounding (linalg::isRounding), as for rigid-body modes.
Eigen::VectorXcd undampedValues(const Sparse& K, const Sparse& M, const Vector& eigenvalues,
                                const Matrix& shapes);

/// The lowest `count` undamped modes (coupling::undampedStiffness: symmetric part of K at t = 0,
/// closed contacts linear, no friction), without the spurious modes of a dual model with residual
/// mass. Collective.
std::vector<ModeComparison> compareModes(const model::SecondOrderModel& full,
                                         const std::vector<model::Substructure>& parts,
                                         const coupling::Synthesis& synthesis, int count,
                                         const std::vector<Sparse>& maps = {});

/// The same with `exact` from modesToCompare(full, count), which many reduced models can share.
std::vector<ModeComparison> compareModes(const model::SecondOrderModel& full,
                                         const linalg::EigenPairs& exact, int count,
                                         const std::vector<model::Substructure>& parts,
                                         const coupling::Synthesis& synthesis,
                                         const std::vector<Sparse>& maps = {});

/// The `count` damped modes of smallest |s|, gyroscopic and circulatory matrices of time t
/// included. Their errors are estimated with left and right modes, z and y, of the coupled model: s
/// - s_full = -sum_p l_I' F_p r_I / z' (2 s m + c) y with the residuals r = Q(s) Phi y and l =
/// Q(s)' Phi z, Q = s^2 M + s C + K. Without estimate if the basis is not of Rayleigh-Ritz type
/// (MacNeal, dual Craig-Bampton). Collective.
std::vector<ModeComparison> compareDampedModes(const model::SecondOrderModel& full,
                                               const std::vector<model::Substructure>& parts,
                                               const coupling::Synthesis& synthesis, int count,
                                               double t, const std::vector<Sparse>& maps = {});

/// The same for the full modes of a target; a coupled mode may be slightly outside it.
std::vector<ModeComparison> compareDampedModes(const model::SecondOrderModel& full,
                                               const std::vector<model::Substructure>& parts,
                                               const coupling::Synthesis& synthesis,
                                               const linalg::DampedTarget& target, double t,
                                               const std::vector<Sparse>& maps = {});

/// A table; with |s|, Im s and damping ratios if `damped`.
std::string comparisonTable(const std::vector<ModeComparison>& modes, bool damped);

}  // namespace tooljoint::estimate
