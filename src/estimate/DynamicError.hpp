// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A-posteriori errors of damped modes and of harmonic responses of a coupled reduced model, from
/// residuals part by part.
#pragma once

#include <complex>
#include <optional>
#include <vector>

#include "coupling/Synthesis.hpp"
#include "estimate/ModeComparison.hpp"
#include "estimate/ResidualFlexibility.hpp"
#include "linalg/trilinos/EigenSolver.hpp"

namespace tooljoint::estimate {

/// Every part, linearised about its initial state, with the laws and point laws of time t.
std::vector<Linearised> linearise(const std::vector<model::Substructure>& parts, double t);
/// The same for motions e^{i omega t} with moving states of point laws.
std::vector<Linearised> linearise(const std::vector<model::Substructure>& parts, double t,
                                  double omega);

/// Rounding error of the energy of a coupled shape, from the parts it was projected from.
linalg::EnergyRounding roundingOfParts(const std::vector<model::Substructure>& parts,
                                       const coupling::Synthesis& synthesis);

/// The `count` damped modes of smallest |s| of a coupled model that are not spurious
/// (coupling::spuriousShapes); errors as linalg::lowestDampedModes.
linalg::QuadraticModes physicalDampedModes(const model::SecondOrderModel& coupled,
                                           const Linearised& m, int count,
                                           const linalg::EnergyRounding& rounding);

/// The same for a target (linalg::dampedModesNear).
linalg::QuadraticModes physicalDampedModes(const model::SecondOrderModel& coupled,
                                           const Linearised& m, const linalg::DampedTarget& target,
                                           const linalg::EnergyRounding& rounding);

/// Goal-oriented errors: with the solution Phi y of a Rayleigh-Ritz problem, its adjoint Phi z and
/// the residuals r and l of both, the error of the goal is l' F r to first order, F the
/// residual flexibility of the parts (two terms of its expansion in s^2, summed as a geometric
/// series).
class DynamicError {
 public:
  /// Factors the interior of every part once, with the symmetric part of these stiffnesses. `parts`
  /// and `synthesis` must outlive the object. The basis must be a Ritz one (isRitz).
  DynamicError(const std::vector<model::Substructure>& parts, const coupling::Synthesis& synthesis,
               const std::vector<Linearised>& matrices);

  /// s - s_full = -sum_p l_I' F_p r_I / z' (2 s m + c) y of modes of the coupled matrices `m`, with
  /// the left modes z of the nearest values, r = Q(s) Phi y and l = Q(s)' Phi z, Q = s^2 M + s C +
  /// K. \param matrices of the parts at the same speed \param target of the mode search; empty: the
  /// lowest modes
  Eigen::VectorXcd ofModes(const std::vector<Linearised>& matrices, const Linearised& m,
                           const linalg::QuadraticModes& right,
                           const std::optional<linalg::DampedTarget>& target = {}) const;

  /// c'x_full - c'x = sum_p l_I' F_p r_I of responses Q(s) x = f, with r = Q Phi y - f, l = Q'
  /// Phi z - c.
  /// \param y, loads      coupled dofs x cases; of each part dofs x cases
  /// \param z, outputs    coupled dofs x outputs; of each part dofs x outputs
  /// \return outputs x cases
  Eigen::MatrixXcd ofResponses(const std::vector<Linearised>& matrices, std::complex<double> s,
                               const Eigen::MatrixXcd& y,
                               const std::vector<Eigen::MatrixXcd>& loads,
                               const Eigen::MatrixXcd& z,
                               const std::vector<Eigen::MatrixXcd>& outputs) const;

 private:
  const std::vector<model::Substructure>& parts_;
  const coupling::Synthesis& synthesis_;
  std::vector<ResidualFlexibility> flexibilities_;
  std::vector<Sparse> masses_;  ///< of the interiors
};

}  // namespace tooljoint::estimate
