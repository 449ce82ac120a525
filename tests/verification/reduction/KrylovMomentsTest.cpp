// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Krylov vectors: the stiffness at the boundary and the response of the interior have the
/// derivatives of the full part at the expansion point.
#include <Eigen/Dense>
#include <Teuchos_ParameterList.hpp>
#include <gtest/gtest.h>

#include "common/Constants.hpp"
#include "linalg/DenseDecompositions.hpp"
#include "reduction/Reduce.hpp"
#include "tests/support/CoupledChecks.hpp"
#include "tests/support/SampleParts.hpp"

namespace KrylovMomentsTest {

using namespace tooljoint;
using namespace tooljoint::reduction;

using constants::twoPi;

/// A part as dense blocks: boundary dofs C, interior I.
struct Blocks {
  Matrix CC, CI, IC, II;
  Blocks(const Sparse& A, const Partition& p)
      : CC(block(A, p.boundary, p.boundary)),
        CI(block(A, p.boundary, p.interior)),
        IC(block(A, p.interior, p.boundary)),
        II(block(A, p.interior, p.interior)) {}
};

/// Taylor coefficients in delta of X(s0 + delta) = -Z_II^-1 Z_IC and of Z_CC + Z_CI X, with Z = Z0
/// + delta Z1 + delta^2 Z2: from sum_j Z_j X_k-j = 0.
struct Series {
  std::vector<Matrix> interior, felt;
  Series(const Blocks& z0, const Blocks& z1, const Blocks& z2, int count) {
    const linalg::DenseLu factor(z0.II);
    const Blocks* z[3] = {&z0, &z1, &z2};
    for (int k = 0; k < count; ++k) {
      Matrix right = k < 3 ? z[k]->IC : Matrix(Matrix::Zero(z0.IC.rows(), z0.IC.cols()));
      for (int j = 1; j <= std::min(k, 2); ++j)
        right += z[j]->II * interior[static_cast<std::size_t>(k - j)];
      interior.push_back(factor.solve(Matrix(-right)));
      Matrix force = k < 3 ? z[k]->CC : Matrix(Matrix::Zero(z0.CC.rows(), z0.CC.cols()));
      for (int j = 0; j <= std::min(k, 2); ++j)
        force += z[j]->CI * interior[static_cast<std::size_t>(k - j)];
      felt.push_back(force);
    }
  }
};

model::Substructure beam(bool spinning) {
  auto part = samples::loopFrame(12, spinning)[2];  // both ends are interfaces: 6 boundary dofs
  return part;
}

struct Pair {
  Series full, small;
};

/// Series of a part and of its reduction to `modes` vectors; Z = K - omega^2 M in delta of lambda,
/// or K + s C + s^2 M in delta of s.
Pair series(const model::Substructure& part, int modes, double hertz, bool damped, int count) {
  Teuchos::ParameterList list("Reduction");
  list.sublist("Krylov").set("Expansion Frequency", hertz).set("Damped", damped).set("Time", 0.4);
  ModeRequest request;
  request.kind = ModeRequest::Kind::Count;
  request.count = modes;
  const Basis basis = makeBasis("Krylov", list)->build(part, request);
  EXPECT_EQ(basis.modes(), modes);
  const Sparse& Phi = basis.vectors;
  const double s0 = twoPi * hertz;
  const Sparse K = constantStiffness(part.model), M = part.model.mass,
               C = part.model.dampingAt(0.4);
  const Sparse none(K.rows(), K.cols());
  const Sparse z0 = damped ? Sparse(K + s0 * C + s0 * s0 * M) : Sparse(K - s0 * s0 * M),
               z1 = damped ? Sparse(C + 2.0 * s0 * M) : M, z2 = damped ? M : none;
  const Partition& p = basis.partition;
  Partition q;
  for (int i = 0; i < static_cast<int>(p.boundary.size()); ++i) q.boundary.push_back(i);
  for (int i = 0; i < modes; ++i) q.interior.push_back(static_cast<int>(p.boundary.size()) + i);
  const auto projected = [&](const Sparse& A) {
    return Blocks(Sparse(Phi.transpose() * (A * Phi).eval()), q);
  };
  Pair pair{Series(Blocks(z0, p), Blocks(z1, p), Blocks(z2, p), count),
            Series(projected(z0), projected(z1), projected(z2), count)};
  // Interior of the reduced part in its dofs: psi delta_k0 + V X_k
  const Matrix V = block(Phi, p.interior, q.interior), psi = block(Phi, p.interior, q.boundary);
  for (std::size_t k = 0; k < pair.small.interior.size(); ++k)
    pair.small.interior[k] =
        V * pair.small.interior[k] + (k == 0 ? psi : Matrix(Matrix::Zero(psi.rows(), psi.cols())));
  return pair;
}

double difference(const Matrix& a, const Matrix& b) {
  double worst = 0;  // by columns: motions of translations and rotations have different units
  for (Eigen::Index j = 0; j < a.cols(); ++j)
    worst = std::max(worst, (a - b).col(j).cwiseAbs().maxCoeff() / b.col(j).cwiseAbs().maxCoeff());
  return worst;
}

int matched(const std::vector<Matrix>& small, const std::vector<Matrix>& full, double tolerance) {
  int count = 0;
  while (count < static_cast<int>(full.size()) &&
         difference(small[static_cast<std::size_t>(count)], full[static_cast<std::size_t>(count)]) <
             tolerance)
    ++count;
  return count;
}

// Undamped and symmetric, k blocks of 6: k derivatives of the interior, 2k of the boundary
// stiffness (Galerkin on both sides); at lambda_0 = 0, where the excitation is proportional to
// lambda and psi gives the first term, one and two more. Matched derivatives differ by 1e-13, the
// first other ones by 1e-8 or more; with two blocks the next ones of the boundary stiffness, an
// error squared, are within rounding again.
TEST(KrylovMoments, AreMatchedAtAFrequency) {
  for (const int blocks : {1, 2}) {
    const Pair pair = series(beam(false), 6 * blocks, 40.0, false, 2 * blocks + 2);
    EXPECT_EQ(matched(pair.small.interior, pair.full.interior, 1e-10), blocks);
    const int felt = matched(pair.small.felt, pair.full.felt, 1e-10);
    EXPECT_GE(felt, 2 * blocks);
    if (blocks == 1) {
      EXPECT_EQ(felt, 2);
    }
  }
}

TEST(KrylovMoments, OneMoreAtZero) {
  for (const int blocks : {1, 2}) {
    const Pair pair = series(beam(false), 6 * blocks, 0.0, false, 2 * blocks + 4);
    EXPECT_EQ(matched(pair.small.interior, pair.full.interior, 1e-10), blocks + 1);
    const int felt = matched(pair.small.felt, pair.full.felt, 1e-10);
    EXPECT_GE(felt, 2 * blocks + 2);
    if (blocks == 1) {
      EXPECT_EQ(felt, 4);
    }
  }
}

// Damped and gyroscopic: blocks of 12 (mass and damping both excite), one derivative of the
// interior and of the boundary stiffness for each; K and C are unsymmetric, so that nothing is
// gained on the other side.
TEST(KrylovMoments, OfAGyroscopicPartAreMatchedOnTheRealAxis) {
  const Pair pair = series(beam(true), 12, 20.0, true, 4);
  EXPECT_GE(matched(pair.small.interior, pair.full.interior, 1e-10), 1);
  const Pair two = series(beam(true), 24, 20.0, true, 4);
  EXPECT_GE(matched(two.small.interior, two.full.interior, 1e-10), 2);
  EXPECT_GE(matched(two.small.felt, two.full.felt, 1e-10), 2);
}

/// Largest error of the boundary stiffness at a frequency near 40 Hz.
double feltError(const std::string& basisName, double hertz) {
  const auto part = beam(false);
  Teuchos::ParameterList list("Reduction");
  list.sublist("Krylov").set("Expansion Frequency", 40.0);
  ModeRequest request;
  request.kind = ModeRequest::Kind::Count;
  request.count = 12;
  const Basis basis = makeBasis(basisName, list)->build(part, request);
  const double omega = twoPi * hertz;
  const Sparse Z = constantStiffness(part.model) - omega * omega * part.model.mass;
  const auto felt = [](const Matrix& A, Eigen::Index kept) {
    const auto rest = A.rows() - kept;
    return Matrix(A.topLeftCorner(kept, kept) -
                  A.topRightCorner(kept, rest) *
                      linalg::DenseLu(A.bottomRightCorner(rest, rest))
                          .solve(Matrix(A.bottomLeftCorner(rest, kept))));
  };
  const Partition& p = basis.partition;
  std::vector<int> order = p.boundary;
  order.insert(order.end(), p.interior.begin(), p.interior.end());
  return difference(felt(Matrix(basis.vectors.transpose() * (Z * basis.vectors).eval()), 6),
                    felt(Matrix(block(Z, order, order)), 6));
}

TEST(KrylovMoments, BeatModesNearTheExpansionPoint) {
  for (const double hertz : {36.0, 44.0})
    EXPECT_LT(feltError("Krylov", hertz), 0.1 * feltError("Craig-Bampton", hertz)) << hertz;
}

}  // namespace KrylovMomentsTest
