// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The damped modes nearest zero by Krylov subspaces, against all modes of a dense solver.
#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstdlib>
#include <gtest/gtest.h>
#include <string>
#include <utility>
#include <vector>

#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "common/Index.hpp"
#include "linalg/DenseDecompositions.hpp"
#include "linalg/GeneralEigen.hpp"
#include "linalg/trilinos/EigenSolver.hpp"

namespace LowestDampedModesTest {

using namespace tooljoint;
using namespace tooljoint::linalg;

struct Shaft {
  Sparse M, C, K;
};

/// `n` masses with two lateral coordinates each in a chain of springs between walls (or free),
/// gyroscopic coupling g and damping c.
Shaft shaft(int n, double g, double c, bool free) {
  Triplets m, d, k;
  for (int i = 0; i < n; ++i)
    for (int x = 0; x < 2; ++x) {
      const int row = 2 * i + x;
      m.emplace_back(row, row, 1.0 + 0.01 * i);
      d.emplace_back(row, row, c * (1.0 + 0.1 * x));
      d.emplace_back(row, 2 * i + 1 - x, x == 0 ? g : -g);
      const double ends = free ? (i > 0) + (i + 1 < n) : 2.0;
      k.emplace_back(row, row, 100.0 * (1.0 + 0.1 * x) * ends);
      if (i + 1 < n) {
        k.emplace_back(row, row + 2, -100.0 * (1.0 + 0.1 * x));
        k.emplace_back(row + 2, row, -100.0 * (1.0 + 0.1 * x));
      }
    }
  const auto matrix = [n](const Triplets& t) {
    Sparse A(2 * n, 2 * n);
    A.setFromTriplets(t.begin(), t.end());
    return A;
  };
  return {matrix(m), matrix(d), matrix(k)};
}

/// The values with Im s >= 0 of all, by |s|.
std::vector<std::complex<double>> lowest(const Shaft& s, std::size_t count) {
  const auto all = dampedModes(Matrix(s.M), Matrix(s.C), Matrix(s.K));
  std::vector<std::complex<double>> values;
  for (Eigen::Index i = 0; i < all.values.size(); ++i)
    if (all.values[i].imag() >= 0) values.push_back(all.values[i]);
  std::sort(values.begin(), values.end(), [](auto a, auto b) { return std::abs(a) < std::abs(b); });
  values.resize(count);
  return values;
}

TEST(LowestDampedModes, AreTheOnesNearestZeroOfAll) {
  for (double g : {0.0, 0.4})
    for (double c : {0.0, 0.05, 3.0}) {
      const Shaft s = shaft(50, g, c, false);
      const auto expected = lowest(s, 10);
      const auto modes = lowestDampedModes(s.M, s.C, s.K, 10);
      ASSERT_EQ(modes.values.size(), 10);
      for (Eigen::Index i = 0; i < 10; ++i) {
        EXPECT_NEAR(std::abs(modes.values[i] - expected[static_cast<std::size_t>(i)]), 0.0,
                    1e-8 * std::abs(expected[static_cast<std::size_t>(i)]))
            << "g " << g << ", c " << c << ", mode " << i;
        EXPECT_LE(modes.residuals[i], 1e-8);
      }
    }
}

/// s and -s of a divergence have the same size as the lowest vibration: a shift of that size would
/// equal the growing value.
TEST(LowestDampedModes, BesideOneThatGrowsWithoutVibrationAreAllAccurate) {
  for (const double share : {1.02, 1.3, 3.0}) {
    Shaft s = shaft(50, 0.0, 0.0, false);
    const auto rest = lowest(s, 1).front();
    s.K -= Sparse(share * std::norm(rest) * s.M);
    for (int i = 0; i < 50; ++i)
      s.K.coeffRef(2 * i, 2 * i + 1) += 1e-3, s.K.coeffRef(2 * i + 1, 2 * i) -= 1e-3;
    const auto expected = lowest(s, 8);
    const auto modes = lowestDampedModes(s.M, s.C, s.K, 8);
    ASSERT_EQ(modes.values.size(), 8);
    for (Eigen::Index i = 0; i < 8; ++i)
      EXPECT_NEAR(std::abs(modes.values[i]), std::abs(expected[at(i)]), 1e-8 * std::abs(rest))
          << share << ", mode " << i;
    EXPECT_GT(modes.values.real().maxCoeff(), 0.0);
  }
}

TEST(LowestDampedModes, AFreeBodyHasItsRigidMotionsAtZero) {
  const Shaft s = shaft(90, 0.0, 0.05, true);
  const auto modes = lowestDampedModes(s.M, s.C, s.K, 6);
  EXPECT_LT(std::abs(modes.values[0]), 1e-6);
  EXPECT_LT(std::abs(modes.values[1]), 1e-6);
}

TEST(LowestDampedModes, RefusesWhatIsNoPencil) {
  const Shaft s = shaft(5, 0.1, 0.1, false);
  EXPECT_THROW(lowestDampedModes(s.M, s.C, Sparse(3, 3), 2), ModelError);
  EXPECT_THROW(lowestDampedModes(s.M, s.C, s.K, 21), ModelError);
}

Sparse sparse(const Matrix& A) { return A.sparseView(0.0, 0.0); }

/// Grid of nx x ny equal masses on equal springs that move normal to it: omega^2 = k/m (4 - 2 cos a
/// - 2 cos b), most values twice.
Shaft membrane(int nx, int ny, bool free) {
  const int n = nx * ny;
  Triplets k;
  const auto number = [&](int i, int j) { return i + nx * j; };
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i)
      for (const auto& [di, dj] :
           {std::pair{1, 0}, std::pair{-1, 0}, std::pair{0, 1}, std::pair{0, -1}}) {
        const bool inside = i + di >= 0 && i + di < nx && j + dj >= 0 && j + dj < ny;
        if (inside || !free) k.emplace_back(number(i, j), number(i, j), 400.0);
        if (inside) k.emplace_back(number(i, j), number(i + di, j + dj), -400.0);
      }
  Shaft s;
  s.K.resize(n, n);
  s.K.setFromTriplets(k.begin(), k.end());
  s.M.resize(n, n);
  s.M.setIdentity();
  s.C.resize(n, n);
  return s;
}

/// Values with Im s >= 0 of s^2 + (alpha + beta omega^2) s + omega^2 = 0 for every omega^2 of the
/// membrane, by |s|.
std::vector<std::complex<double>> proportionallyDamped(int nx, int ny, double alpha, double beta) {
  using constants::pi;
  std::vector<std::complex<double>> values;
  for (int i = 1; i <= nx; ++i)
    for (int j = 1; j <= ny; ++j) {
      const double omega2 = 400.0 *
                            (4 - 2 * std::cos(i * pi / (nx + 1)) - 2 * std::cos(j * pi / (ny + 1))),
                   c = alpha + beta * omega2;
      const std::complex<double> root = std::sqrt(std::complex<double>(c * c / 4 - omega2));
      for (const auto& s : {-c / 2 + root, -c / 2 - root})
        if (s.imag() >= 0) values.push_back(s);
    }
  std::sort(values.begin(), values.end(), [](auto a, auto b) { return std::abs(a) < std::abs(b); });
  return values;
}

void expectAmong(const QuadraticModes& modes, std::vector<std::complex<double>> exact,
                 double tolerance, const std::string& what) {
  for (Eigen::Index j = 0; j < modes.values.size(); ++j) {
    const auto nearest = std::min_element(exact.begin(), exact.end(), [&](auto a, auto b) {
      return std::abs(a - modes.values[j]) < std::abs(b - modes.values[j]);
    });
    ASSERT_NE(nearest, exact.end());
    EXPECT_LT(std::abs(*nearest - modes.values[j]), tolerance * std::abs(modes.values[j]))
        << what << ", mode " << j + 1;
    exact.erase(nearest);
  }
}

// Repeated values, with every kind of damping; a double value must be listed twice.
TEST(LowestDampedModes, FindEveryCopyOfARepeatedValue) {
  struct Case {
    const char* name;
    double alpha, beta, tolerance;
  };
  const double first = std::sqrt(400.0 * (4 - 4 * std::cos(constants::pi / 13)));  // of 12 x 12
  for (const Case& c :
       {Case{"undamped", 0, 0, 1e-10}, Case{"light", 1e-6, 1e-9, 1e-10},
        Case{"proportional", 0.4, 1e-3, 1e-10}, Case{"overdamped", 5 * first, 0, 1e-10},
        Case{"critical", 2 * first, 0, 1e-6}}) {
    Shaft s = membrane(12, 12, false);
    s.C = c.alpha * s.M + c.beta * s.K;
    const auto exact = proportionallyDamped(12, 12, c.alpha, c.beta);
    const auto modes = lowestDampedModes(s.M, s.C, s.K, 20);
    ASSERT_EQ(modes.values.size(), 20) << c.name;
    expectAmong(modes, {exact.begin(), exact.begin() + 24}, c.tolerance, c.name);
    EXPECT_LT(modes.residuals.maxCoeff(), 1e-11) << c.name;
  }
}

// More copies than a block of the Krylov space has columns: 20 uncoupled oscillators of each
// frequency.
TEST(LowestDampedModes, FindMoreCopiesThanABlockHas) {
  const int copies = 20, kinds = 8, n = copies * kinds;
  Triplets k, c;
  for (int i = 0; i < n; ++i) {
    const double omega = 1.0 + i / copies;
    k.emplace_back(i, i, omega * omega);
    c.emplace_back(i, i, 0.02 * omega);
  }
  Shaft s{Sparse(n, n), Sparse(n, n), Sparse(n, n)};
  s.M.setIdentity();
  s.K.setFromTriplets(k.begin(), k.end());
  s.C.setFromTriplets(c.begin(), c.end());
  const auto modes = lowestDampedModes(s.M, s.C, s.K, 24);
  ASSERT_EQ(modes.values.size(), 24);
  for (Eigen::Index j = 0; j < 24; ++j)
    EXPECT_NEAR(std::abs(modes.values[j]), j < copies ? 1.0 : 2.0, 1e-9) << j;
}

// A rigid-body motion of a free body is zero twice in a Jordan chain: it is listed once, as zero,
// with and without gyroscopics.
TEST(LowestDampedModes, RigidBodyMotionsAreZeroAndListedOnce) {
  for (const auto& [n, g] : {std::pair(90, 0.0), std::pair(90, 0.4), std::pair(40, 0.4),
                             std::pair(130, 0.3), std::pair(90, 1.3), std::pair(130, 5.0)}) {
    Shaft s = shaft(n, g, 0.0, true);
    const auto modes = lowestDampedModes(s.M, s.C, s.K, 6);
    ASSERT_EQ(modes.values.size(), 6);
    // gyroscopic coupling of free masses turns one chain into a whirl at g / m, far below the first
    // elastic mode here only for the plain shaft
    const int zeros = static_cast<int>((modes.values.cwiseAbs().array() == 0.0).count());
    EXPECT_EQ(zeros, 2) << g;
    const Vector size =
        (s.K * modes.vectors.leftCols(zeros).real()).cwiseAbs().colwise().maxCoeff();
    EXPECT_LT(size.maxCoeff(), 1e-9) << "K phi = 0";
  }
  const auto plate = membrane(14, 14, true);
  const auto modes = lowestDampedModes(plate.M, plate.C, plate.K, 5);
  EXPECT_EQ(modes.values[0], 0.0);
  EXPECT_GT(std::abs(modes.values[1]), 1.0);
}

// u'' + g v' + w^2 u = 0, v'' - g u' + w^2 v = 0 with strong gyroscopics: whirl at sqrt(g^2/4 +
// w^2) -+ g/2, twice each.
TEST(LowestDampedModes, StrongGyroscopicsAreNotDamped) {
  const int nx = 9, n = nx * nx;
  const Shaft plate = membrane(nx, nx, false);
  const double g = 300.0, pi = constants::pi;
  const Matrix K = plate.K;
  Matrix both = Matrix::Zero(2 * n, 2 * n), C = Matrix::Zero(2 * n, 2 * n);
  both.topLeftCorner(n, n) = both.bottomRightCorner(n, n) = K;
  C.topRightCorner(n, n) = g * Matrix::Identity(n, n);
  C.bottomLeftCorner(n, n) = -g * Matrix::Identity(n, n);
  const auto modes =
      lowestDampedModes(sparse(Matrix::Identity(2 * n, 2 * n)), sparse(C), sparse(both), 15);
  std::vector<std::complex<double>> exact;
  for (int i = 1; i <= nx; ++i)
    for (int j = 1; j <= nx; ++j) {
      const double w2 =
          400.0 * (4 - 2 * std::cos(i * pi / (nx + 1)) - 2 * std::cos(j * pi / (nx + 1)));
      exact.emplace_back(0, std::sqrt(g * g / 4 + w2) - g / 2);
    }
  std::sort(exact.begin(), exact.end(), [](auto a, auto b) { return std::abs(a) < std::abs(b); });
  exact.resize(18);
  expectAmong(modes, exact, 1e-9, "gyroscopic");
  for (Eigen::Index j = 0; j < 15; ++j)
    EXPECT_LT(std::abs(modes.values[j].real()), 1e-10 * std::abs(modes.values[j]));
}

// Dofs without mass follow statically: the same values as the condensed model.
TEST(LowestDampedModes, DofsWithoutMassAreCondensed) {
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
TEST(LowestDampedModes, InfiniteValuesAreNoModes) {
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
TEST(LowestDampedModes, AllMotionsAtZeroOfABodyWithMasslessDofsAreFound) {
  const int n = 46, massless = 4, zeros = 6, count = 10;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    std::srand(seed);
    const Matrix B = Matrix::Random(n - zeros, n);
    const Matrix K = B.transpose() * B;
    Matrix M = Vector::LinSpaced(n, 0.5, 2.0).asDiagonal();
    M.bottomRightCorner(massless, massless).setZero();
    const auto modes = lowestDampedModes(sparse(M), Sparse(n, n), sparse(K), count);
    ASSERT_EQ(modes.values.size(), count) << seed;
    Eigen::MatrixXcd shapes = modes.vectors.leftCols(zeros);
    for (int j = 0; j < count; ++j) {
      if (j >= zeros) {
        EXPECT_GT(std::abs(modes.values[j]), 1e-3) << seed << ", mode " << j;
        continue;
      }
      EXPECT_EQ(modes.values[j], 0.0) << seed << ", mode " << j;
      shapes.col(j).normalize();
      EXPECT_LT((K * shapes.col(j)).norm(), 1e-9 * K.norm()) << seed << ", mode " << j;
    }
    EXPECT_GT(singularValues(shapes).minCoeff(), 1e-3) << seed;  // independent
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

// A dof with damping but no mass has one finite value; its neighbour without both has none. The
// value is real if the dof relaxes alone, and is the larger the smaller the damping is.
TEST(LowestDampedModes, OfMasslessDofsTheDampedOnesHaveFiniteValues) {
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
TEST(LowestDampedModes, FaintDampingOnAMasslessDofIsFound) {
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
TEST(LowestDampedModes, BoundaryDofsWithoutMassMayBeStiffBeyondAllModes) {
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

// A free body, C = beta K: its rigid-body motions must not appear as relaxing modes because of
// rounding in directions that have mass but no damping.
TEST(LowestDampedModes, StiffnessDampingLeavesWhatRestsAtRest) {
  constexpr int n = 40;
  Matrix K = Matrix::Zero(n, n);
  for (int i = 0; i + 1 < n; ++i) {
    const double k = 1e5 * (1 + 0.37 * std::sin(2.0 * i));
    K(i, i) += k, K(i + 1, i + 1) += k, K(i, i + 1) -= k, K(i + 1, i) -= k;
  }
  const Matrix M = Matrix::Identity(n, n);
  const auto found = lowestDampedModes(M.sparseView(), (1e-5 * K).sparseView(), K.sparseView(), 4);
  EXPECT_EQ(found.values[0], Complex(0));
  for (Eigen::Index j = 1; j < 4; ++j) EXPECT_GT(std::abs(found.values[j]), 10.0) << j;
}

// A dof that does not vibrate has two real values: there are more values than dofs.
TEST(LowestDampedModes, OverdampedDofsHaveTwoValuesEach) {
  const Vector c = Eigen::Vector3d(50, 5, 30), k = Eigen::Vector3d(100, 900, 200);
  Matrix C = c.asDiagonal(), K = k.asDiagonal();
  C(0, 1) = C(1, 0) = 1e-9;  // no longer proportional
  const auto found = lowestDampedModes(Matrix(Matrix::Identity(3, 3)).sparseView(), C.sparseView(),
                                       K.sparseView(), 6);
  std::vector<Complex> exact{{-2.5, std::sqrt(900 - 6.25)}};
  for (int i : {0, 2})
    for (const double sign : {1.0, -1.0})
      exact.push_back(-0.5 * c[i] + sign * std::sqrt(0.25 * c[i] * c[i] - k[i]));
  std::sort(exact.begin(), exact.end(),
            [](Complex a, Complex b) { return std::abs(a) < std::abs(b); });
  ASSERT_EQ(found.values.size(), 5);
  for (Eigen::Index j = 0; j < 5; ++j)
    EXPECT_LT(std::abs(found.values[j] - exact[static_cast<std::size_t>(j)]), 1e-7) << j;
}

// Without damping the values are those of the undamped modes: s = i omega, and +-sqrt(-omega^2)
// where omega^2 < 0.
TEST(LowestDampedModes, WithoutDampingTheyAreTheSymmetricModes) {
  Shaft s = membrane(11, 13, false);
  const double shift = 400.0 * 0.4;  // the lowest ones become negative
  s.K = Sparse(s.K - shift * s.M);
  const auto pairs = lowestModes(s.K, s.M, 12);
  const auto modes = lowestDampedModes(s.M, s.C, s.K, 12);
  ASSERT_LT(pairs.values[0], 0.0);
  for (Eigen::Index j = 0; j < 12; ++j) {
    const auto s2 = modes.values[j] * modes.values[j];
    EXPECT_LT((pairs.values.array() + s2.real()).abs().minCoeff(), 1e-9 * std::abs(s2)) << j;
    EXPECT_TRUE(modes.values[j].real() == 0.0 || modes.values[j].imag() == 0.0);
    if (j > 0) {
      EXPECT_GE(std::abs(modes.values[j]), std::abs(modes.values[j - 1]));
    }
  }
}

}  // namespace LowestDampedModesTest
