// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Damped modes of models with dofs without mass: some values are infinite, others very large.
#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstdlib>
#include <gtest/gtest.h>
#include <utility>
#include <vector>

#include "Models.hpp"
#include "common/Index.hpp"
#include "linalg/DenseDecompositions.hpp"
#include "linalg/GeneralEigen.hpp"
#include "linalg/trilinos/EigenSolver.hpp"

namespace MasslessDampedModesTest {

using namespace tooljoint;
using namespace tooljoint::linalg;
using tooljoint::testing::Shaft, tooljoint::testing::shaft, tooljoint::testing::sparse;

// Dofs without mass follow statically: the same values as the condensed model.
TEST(MasslessDampedModes, DofsWithoutMassAreCondensed) {
  for (int n : {30, 150}) {
    Shaft s = shaft(n, 0.4, 0.05, false);
    Matrix M = s.M, C = s.C, K = s.K;
    std::vector<Eigen::Index> heavy, light;
    for (Eigen::Index i = 0; i < 2 * n; ++i) (i / 2 % 3 == 1 ? light : heavy).push_back(i);
    for (auto i : light) M(i, i) = 0, C.row(i).setZero(), C.col(i).setZero();
    const auto block = [](const Matrix& A, const auto& rows, const auto& columns) {
      return Matrix(A(rows, columns));
    };
    const Matrix condensed =
        block(K, heavy, heavy) -
        block(K, heavy, light) * block(K, light, light).lu().solve(block(K, light, heavy));
    const auto exact = lowestDampedModes(sparse(block(M, heavy, heavy)),
                                         sparse(block(C, heavy, heavy)), sparse(condensed), 8);
    const auto modes = lowestDampedModes(sparse(M), sparse(C), s.K, 8);
    ASSERT_EQ(modes.values.size(), 8);
    for (Eigen::Index j = 0; j < 8; ++j)
      EXPECT_LT(std::abs(modes.values[j] - exact.values[j]), 1e-9 * std::abs(exact.values[j])) << n;
  }
}

// Directions without mass and damping have infinite values. A request for more modes than finite
// ones returns the finite ones, whether the massless directions are dofs or combinations of them.
TEST(MasslessDampedModes, InfiniteValuesAreNoModes) {
  const int n = 6;
  for (double g : {0.0, 0.4, 60.0})
    for (bool turned : {false, true}) {
      Shaft s = shaft(n, g, 0.05, false);
      Matrix M = s.M, C = s.C, K = s.K;
      for (const int i : {2, 3, 8, 9}) M(i, i) = 0, C.row(i).setZero(), C.col(i).setZero();
      if (turned) {
        const Matrix T = Matrix::Identity(2 * n, 2 * n) +
                         0.1 * Vector::LinSpaced(2 * n, -1, 1) * Vector::Ones(2 * n).transpose();
        for (Matrix* A : {&M, &C, &K}) *A = T.transpose() * *A * T;
      }
      const auto modes = lowestDampedModes(sparse(M), sparse(C), sparse(K), 2 * n);
      ASSERT_EQ(modes.values.size(), 8) << g << turned;
      for (Eigen::Index j = 0; j < 8; ++j) {
        EXPECT_LT(modes.values[j].real(), 0.0) << g << turned << j;
        EXPECT_LT(std::abs(modes.values[j]), 100.0) << g << turned << j;
        EXPECT_LT(modes.residuals[j], 1e-10) << g << turned << j;
      }
    }
}

/// K = B'B has as many motions at zero as B has columns more than rows, each twice in a chain: all
/// of them are listed once, with K phi = 0, despite the rounding of the chains.
TEST(MasslessDampedModes, AllMotionsAtZeroOfABodyWithMasslessDofsAreFound) {
  const int n = 46, massless = 4;
  for (const auto& [zeros, count] : {std::pair{6, 10}, std::pair{12, 16}})
    for (unsigned seed = 1; seed <= 10; ++seed) {
      const auto where = ::testing::Message() << zeros << " zeros, seed " << seed;
      std::srand(seed);
      const Matrix B = Matrix::Random(n - zeros, n);
      const Matrix K = B.transpose() * B;
      Matrix M = Vector::LinSpaced(n, 0.5, 2.0).asDiagonal();
      M.bottomRightCorner(massless, massless).setZero();
      const auto modes = lowestDampedModes(sparse(M), Sparse(n, n), sparse(K), count);
      ASSERT_EQ(modes.values.size(), count) << where;
      Eigen::MatrixXcd shapes = modes.vectors.leftCols(zeros);
      for (int j = 0; j < count; ++j) {
        if (j >= zeros) {
          EXPECT_GT(std::abs(modes.values[j]), 1e-3) << where << ", mode " << j;
          continue;
        }
        EXPECT_EQ(modes.values[j], 0.0) << where << ", mode " << j;
        shapes.col(j).normalize();
        EXPECT_LT((K * shapes.col(j)).norm(), 1e-9 * K.norm()) << where << ", mode " << j;
      }
      EXPECT_GT(singularValues(shapes).minCoeff(), 1e-3) << where;  // independent
    }
}

/// All finite s with Im s >= 0, by |s|, of a pencil whose dofs have mass, only damping, or neither:
/// the last ones are condensed, x_l = -K_ll^-1 K_lr x_r, and (x_m, x_m', x_d) obey equations of
/// first order.
std::vector<std::complex<double>> finiteValues(const Matrix& M, const Matrix& C, const Matrix& K) {
  std::vector<Eigen::Index> heavy, damped, light, rest;
  for (Eigen::Index i = 0; i < M.rows(); ++i)
    (M(i, i) > 0 ? heavy : C(i, i) > 0 ? damped : light).push_back(i);
  rest = heavy;
  rest.insert(rest.end(), damped.begin(), damped.end());
  const Matrix k = K(rest, rest) -
                   K(rest, light) * linalg::DenseLu(K(light, light)).solve(Matrix(K(light, rest)));
  const Matrix c = C(rest, rest);
  const auto h = static_cast<Eigen::Index>(heavy.size()),
             d = static_cast<Eigen::Index>(damped.size());
  // C_dd x_d' = -C_dm x_m' - K_dm x_m - K_dd x_d, put into M x_m'' = -C_mm x_m' - C_md x_d' - ...
  const linalg::DenseLu viscous(c.bottomRightCorner(d, d));
  Matrix slow(d, 2 * h + d), A = Matrix::Zero(2 * h + d, 2 * h + d);
  slow << k.bottomLeftCorner(d, h), c.bottomLeftCorner(d, h), k.bottomRightCorner(d, d);
  A.bottomRows(d) = -viscous.solve(slow);
  A.block(0, h, h, h).setIdentity();
  Matrix force(h, 2 * h + d);
  force << k.topLeftCorner(h, h), c.topLeftCorner(h, h), k.topRightCorner(h, d);
  force += c.topRightCorner(h, d) * A.bottomRows(d);
  A.middleRows(h, h) = -linalg::DenseLu(M(heavy, heavy)).solve(force);
  const Eigen::VectorXcd all = linalg::generalPairs(A).values;
  std::vector<std::complex<double>> values;
  for (const auto& s : all)
    if (s.imag() >= 0) values.push_back(s);
  std::sort(values.begin(), values.end(), [](auto a, auto b) { return std::abs(a) < std::abs(b); });
  return values;
}

/// The same of a model with too many dofs to count its finite values beforehand: a chain with few
/// masses.
TEST(MasslessDampedModes, InfiniteValuesOfManyDofsAreNoModes) {
  const int n = 800;
  Matrix M = Matrix::Zero(n, n), C = M, K = M;
  K.diagonal().setConstant(2.0);
  K.diagonal(1).setConstant(-1.0);
  K.diagonal(-1).setConstant(-1.0);
  const std::array<int, 5> heavy{80, 230, 390, 560, 700};
  for (std::size_t j = 0; j < heavy.size(); ++j) {
    M(heavy[j], heavy[j]) = 1.0 + 0.3 * static_cast<double>(j);
    C(heavy[j], heavy[j]) = 0.002 * static_cast<double>(j + 1);
  }
  C(heavy[0], heavy[3]) = 0.01, C(heavy[3], heavy[0]) = -0.01;
  const auto exact = finiteValues(M, C, K);
  const auto modes = lowestDampedModes(sparse(M), sparse(C), sparse(K), 14);
  ASSERT_EQ(exact.size(), heavy.size());
  ASSERT_EQ(at(modes.values.size()), heavy.size());
  for (std::size_t j = 0; j < exact.size(); ++j)
    EXPECT_LT(std::abs(modes.values[static_cast<Eigen::Index>(j)] - exact[j]),
              1e-9 * std::abs(exact[j]));
}

// A dof with damping but no mass has one finite value; its neighbour without both has none. The
// value is real if the dof relaxes alone, and is the larger the smaller the damping is.
TEST(MasslessDampedModes, OfMasslessDofsTheDampedOnesHaveFiniteValues) {
  for (const int n : {6, 50})
    for (const double damping : {0.002, 0.02, 1.0, 50.0})
      for (const bool turned : {false, true}) {
        const Shaft s = shaft(n, 0.4, 0.05, false);
        Matrix M = s.M, C = s.C, K = s.K;
        const std::array<int, 4> light{2, 3, 2 * n - 4, 2 * n - 3};
        for (const int i : light) M(i, i) = 0, C.row(i).setZero(), C.col(i).setZero();
        for (const int i : {4, 7}) {  // beside undamped ones and beside masses
          M(i, i) = 0, C.row(i).setZero(), C.col(i).setZero();
          C(i, i) = damping;
        }
        C(4, 7) = C(7, 4) = -0.3 * damping;
        const auto exact = finiteValues(M, C, K);
        ASSERT_EQ(std::count_if(exact.begin(), exact.end(), [](auto z) { return z.imag() == 0; }),
                  2);
        if (turned) {  // the directions without mass are combinations of dofs
          const Matrix T = Matrix::Identity(2 * n, 2 * n) + 0.1 / n *
                                                                Vector::LinSpaced(2 * n, -1, 1) *
                                                                Vector::Ones(2 * n).transpose();
          for (Matrix* A : {&M, &C, &K}) *A = T.transpose() * *A * T;
        }
        const auto count = n == 6 ? exact.size() : 15;
        const auto modes = lowestDampedModes(sparse(M), sparse(C), sparse(K), n == 6 ? 2 * n : 15);
        const auto where = ::testing::Message() << n << " masses, " << damping << ", " << turned;
        ASSERT_EQ(at(modes.values.size()), count) << where;
        for (std::size_t j = 0; j < count; ++j) {
          const auto found = modes.values[static_cast<Eigen::Index>(j)];
          EXPECT_LT(std::abs(found - exact[j]), 1e-7 * std::abs(exact[j]))
              << where << ": " << found << " is not " << exact[j];
        }
      }
}

// Damping so small that its value, -k/c, is ten orders of magnitude above the vibrations.
TEST(MasslessDampedModes, FaintDampingOnAMasslessDofIsFound) {
  const int n = 6;
  const Shaft s = shaft(n, 0.4, 0.05, false);
  for (const double damping : {5e-5, 2e-5, 1e-5, 5e-6, 2e-6, 1e-6, 1e-7}) {
    Matrix M = s.M, C = s.C, K = s.K;
    for (const int i : {2, 3, 4, 7, 8, 9}) M(i, i) = 0, C.row(i).setZero(), C.col(i).setZero();
    C(4, 4) = 2 * damping, C(7, 7) = damping;
    const auto exact = finiteValues(M, C, K);
    const auto modes = lowestDampedModes(sparse(M), sparse(C), sparse(K), 2 * n);
    ASSERT_EQ(at(modes.values.size()), exact.size()) << damping;
    EXPECT_LT(exact.back().real(), -100 / damping) << damping;
    for (std::size_t j = 0; j < exact.size(); ++j) {
      const auto found = modes.values[static_cast<Eigen::Index>(j)];
      EXPECT_LT(std::abs(found - exact[j]), 1e-5 * std::abs(exact[j]))
          << damping << ": " << found << " is not " << exact[j];
    }
  }
}

// MacNeal's basis with little residual flexibility g^-1 left: boundary dofs u = Phi p without mass,
// k = [g, -g Phi; ., Lambda + g Phi'Phi]. The modes are those of p alone.
TEST(MasslessDampedModes, BoundaryDofsWithoutMassMayBeStiffBeyondAllModes) {
  constexpr int boundary = 6, modes = 110;
  const double g = 1e20;
  Matrix Phi(boundary, modes);
  for (int j = 0; j < modes; ++j)
    for (int i = 0; i < boundary; ++i) Phi(i, j) = 1e-9 * std::sin(1.0 + 0.7 * i + 1.3 * j);
  const Vector w = Vector::LinSpaced(modes, 10, 10.0 * modes);
  const Vector c = 0.02 * w.array() + 0.3 * Eigen::ArrayXd::LinSpaced(modes, 0, 1);
  Matrix M = Matrix::Zero(boundary + modes, boundary + modes), C = M, K = M;
  M.diagonal().tail(modes).setOnes();
  C.diagonal().tail(modes) = c;
  K.topLeftCorner(boundary, boundary) = g * Matrix::Identity(boundary, boundary);
  K.topRightCorner(boundary, modes) = -g * Phi;
  K.bottomLeftCorner(modes, boundary) = -g * Phi.transpose();
  K.bottomRightCorner(modes, modes) = g * Phi.transpose() * Phi;
  K.diagonal().tail(modes) += w.cwiseAbs2();
  const auto found = lowestDampedModes(M.sparseView(), C.sparseView(), K.sparseView(), 12);
  for (Eigen::Index j = 0; j < 12; ++j) {
    EXPECT_NEAR(std::abs(found.values[j]), w[j], 1e-6 * w[j]) << j;
    EXPECT_NEAR(found.values[j].real(), -0.5 * c[j], 1e-5 * c[j]) << j;
  }
}

}  // namespace MasslessDampedModesTest
