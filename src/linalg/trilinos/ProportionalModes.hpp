// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What the two ways to damped modes share: the scaled matrices of s^2 M + s C + K, and the modes
/// of symmetric matrices with proportional damping. Included by QuadraticEigen.cpp and
/// ProportionalModes.cpp only.
#pragma once

#include <complex>
#include <optional>
#include <vector>

#include "linalg/trilinos/EigenChecks.hpp"
#include "linalg/trilinos/EigenSolver.hpp"
#include "linalg/trilinos/SemidefiniteModes.hpp"

namespace tooljoint::linalg {

using Complex = std::complex<double>;
using ComplexVector = Eigen::VectorXcd;

/// M, C and K with rows and columns scaled by powers of two near 1 / sqrt(M_ii): translations,
/// rotations and modal amplitudes become comparable, and no entry is rounded.
struct ScaledPencil {
  Sparse M, C, K;
  Vector scale;
  bool singularMass = false;
  EnergyRounding rounding;  ///< of shapes in scaled coordinates

  ScaledPencil(const Sparse& m, const Sparse& c, const Sparse& k, const EnergyRounding& given) {
    scale = binaryMassScale(k, m);
    const auto scaled = [&](const Sparse& A) {
      return Sparse(scale.asDiagonal() * A * scale.asDiagonal());
    };
    M = scaled(m);
    C = scaled(c);
    K = scaled(k);
    singularMass = hasSingularMass(m);
    rounding = [this, given, absolute = Sparse(K.cwiseAbs()),
                fraction = roundingOf(K)](const ComplexVector& phi) {
      if (given) return given(scale.cast<Complex>().cwiseProduct(phi));
      const Vector size = phi.cwiseAbs();
      return fraction * size.dot(absolute * size);
    };
  }
  ScaledPencil(const ScaledPencil&) = delete;
  ScaledPencil& operator=(const ScaledPencil&) = delete;
  Eigen::Index size() const { return M.rows(); }
};

/// Values s with Im s >= 0 and scaled vectors.
struct DampedModes {
  std::vector<Complex> values;
  std::vector<ComplexVector> vectors;
};

/// The modes of a pencil with symmetric K and proportional damping, C = alpha M + beta K: those of
/// the symmetric modes, which such damping does not couple. Of a mode with omega^2 >= lambda no |s|
/// is below sqrt(lambda) or, overdamped, lambda / (|alpha| + |beta| lambda): enough modes are
/// computed to know that the lowest `count` |s| are among them. Nothing when the pencil is another,
/// or when these are too many, where stiffness-proportional damping gathers the values of all high
/// modes at 1 / beta.
std::optional<DampedModes> proportionalModes(const ScaledPencil& pencil, int count,
                                             const DofNamer& name);

}  // namespace tooljoint::linalg
