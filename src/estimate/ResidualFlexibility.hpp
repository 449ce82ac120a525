// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Contribution of the truncated modes to the flexibility of the interior of one part: the residual
/// flexibility.
#pragma once

#include <memory>
#include <vector>

#include "linalg/DenseDecompositions.hpp"
#include "linalg/trilinos/DirectSolver.hpp"
#include "model/Substructure.hpp"
#include "reduction/ReductionMethod.hpp"

namespace tooljoint::estimate {

/// F = K_II^-1 - W (W' K_II W)^-1 W', W the modal columns of the basis on the interior (S. Rubin,
/// AIAA Journal 13 (1975) 995-1006; with fixed-interface modes it is the residual flexibility of
/// J.-G. Kim and P.-S. Lee, Int. J. Numer. Meth. Engng 100 (2014) 581-598). F r is the static
/// response outside the basis, with all boundary dofs fixed. One factorisation per part.
class ResidualFlexibility {
 public:
  /// \param stiffness of the part, dofs x dofs
  /// \param ranks All: they divide the factors of a large part, and solve together
  /// Throws ModelError naming the part if its interior is a mechanism other than modes of the
  /// basis.
  ResidualFlexibility(const model::Substructure& part, const reduction::Basis& basis,
                      const model::SharedSparse& stiffness,
                      parallel::Ranks ranks = parallel::Ranks::Own);

  /// Positions in the part of the rows of all vectors.
  const std::vector<int>& interior() const { return interior_; }
  /// Number of interior coordinates outside the basis; 0: nothing to estimate.
  int truncated() const { return truncated_; }

  /// F r, interior x columns.
  Matrix apply(const Matrix& r) const;

  /// Contribution of the part to a Rayleigh-Ritz step from a motion D with the residual r = (K -
  /// lambda M) D and the inertia g = M D, both on the interior: projections on the two Krylov
  /// vectors V = (F r, F M_II F r) of the complement of the basis.
  struct Step {
    Eigen::Vector2d residual = Eigen::Vector2d::Zero();   ///< V' r
    Eigen::Vector2d inertia = Eigen::Vector2d::Zero();    ///< V' g
    Eigen::Matrix2d stiffness = Eigen::Matrix2d::Zero();  ///< V' K_II V
    Eigen::Matrix2d mass = Eigen::Matrix2d::Zero();  ///< V' M_II V; zero rows for missing vectors
    /// b' (V' (K - mu M) V)^-1 b with b = V' (r + (lambda - mu) g), the excess of m (lambda - mu).
    double excess(double lambda, double mu) const;
    /// Lowest eigenvalue of (V' K V, V' M V), the first pole of `excess`. Infinite without vectors.
    double pole() const;
  };
  Step step(const Vector& r, const Vector& g) const;
  /// The same for the columns of R and G, solved together.
  std::vector<Step> steps(const Matrix& R, const Matrix& G) const;

 private:
  /// Factors K_II or, for a floating interior, K_II + s M_II with a small s.
  void factor(const model::Substructure& part, const reduction::Basis& basis,
              parallel::Ranks ranks);

  std::vector<int> interior_;
  int truncated_ = 0;
  model::SharedSparse mass_, stiffness_;  ///< M_II, K_II
  std::unique_ptr<linalg::DirectSolver> solver_;
  Matrix modes_;                 ///< W
  linalg::DenseLu modalFactor_;  ///< of W' K_II W
};

}  // namespace tooljoint::estimate
