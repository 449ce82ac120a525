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

/// A full mode and the coupled mode of the same shape (matchModes), each coupled mode beside one
/// full mode at most.
struct ModeComparison {
  int coupledMode = -1;  ///< 0-based number among the physical coupled modes; -1: none is left, and
                         ///< the error is 1
  std::complex<double> full;  ///< undamped: i omega (omega < 0: omega^2 < 0); damped: s [1/s]; 0
                              ///< for a rigid-body mode (zero but for rounding)
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
/// States of point laws stay as they are.
Linearised linearise(const model::SecondOrderModel& model, double t);
/// Motions e^{s t} [1/s], which the states follow (model::tangentByStates): what they add to
/// K + s C, as real K and C (a real s: all in K).
Linearised linearise(const model::SecondOrderModel& model, double t, Complex s);
/// The same of s = i omega, omega >= 0 [rad/s].
Linearised linearise(const model::SecondOrderModel& model, double t, double omega);

/// Motions of the coupled model in the dofs of the full one: column by column, dofs matched by
/// their labels, or, where the full model was itself coupled from unreduced parts, D_p = maps[p] z,
/// by least squares over all parts. Throws ModelError when a dof of the full model is in no part.
Eigen::MatrixXcd recover(const model::SecondOrderModel& full,
                         const std::vector<model::Substructure>& parts,
                         const coupling::Synthesis& synthesis, const Eigen::MatrixXcd& shapes,
                         const std::vector<Sparse>& maps = {});

/// Full modes to compute for a comparison of the `count` lowest ones, some more so that no repeated
/// value is cut: coupling::lowestModes.
linalg::EigenPairs modesToCompare(const model::SecondOrderModel& full, int count);

/// i omega of each eigenvalue omega^2 (omega < 0 where omega^2 < 0); 0 where phi'K phi = omega^2
/// phi'M phi is zero but for rounding (linalg::isRounding), as for rigid-body modes.
Eigen::VectorXcd undampedValues(const Sparse& K, const Sparse& M, const Vector& eigenvalues,
                                const Matrix& shapes);

/// The lowest `count` undamped modes (coupling::undampedStiffness: symmetric part of K at t = 0,
/// closed contacts linear, no friction). Spurious modes of a dual model with residual mass are left
/// out. Collective.
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
/// Q(s)' Phi z, Q = s^2 M + s C + K. Not estimated where the basis is no Rayleigh-Ritz one
/// (MacNeal, dual Craig-Bampton). Collective.
std::vector<ModeComparison> compareDampedModes(const model::SecondOrderModel& full,
                                               const std::vector<model::Substructure>& parts,
                                               const coupling::Synthesis& synthesis, int count,
                                               double t, const std::vector<Sparse>& maps = {});

/// The same for the full modes of a target; a coupled mode may lie a little outside of it.
std::vector<ModeComparison> compareDampedModes(const model::SecondOrderModel& full,
                                               const std::vector<model::Substructure>& parts,
                                               const coupling::Synthesis& synthesis,
                                               const linalg::DampedTarget& target, double t,
                                               const std::vector<Sparse>& maps = {});

/// A table; with |s|, Im s and damping ratios when `damped`.
std::string comparisonTable(const std::vector<ModeComparison>& modes, bool damped);

}  // namespace tooljoint::estimate
