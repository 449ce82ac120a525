// SPDX-License-Identifier: BSD-3-Clause
#include "linalg/trilinos/EigenSolver.hpp"

#include <Teuchos_ParameterList.hpp>
#include <cstdlib>
#include <gtest/gtest.h>
#include <tuple>

#include "Models.hpp"
#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "common/Interrupt.hpp"
#include "linalg/Deterministic.hpp"
#include "linalg/trilinos/SemidefiniteModes.hpp"
#include "tests/support/ErrorText.hpp"

namespace tooljoint::linalg {
namespace EigenSolverTest {

using testing::beam;
using testing::Pencil;
using testing::springChain;

constexpr double k = 1e7, m = 2.0;

double heldChain(int n, int j) {
  return 4.0 * k / m * std::pow(std::sin((j + 1) * constants::pi / (2.0 * (n + 1))), 2);
}
double freeChain(int n, int j) {
  return 4.0 * k / m * std::pow(std::sin(j * constants::pi / (2.0 * n)), 2);
}

bool isDense(const EigenPairs& modes) { return modes.method.find("dense") != std::string::npos; }

/// Checks all properties stated in the documentation of EigenPairs.
void expectModes(const Pencil& pencil, const EigenPairs& modes, int count) {
  ASSERT_EQ(modes.count(), count);
  ASSERT_EQ(modes.vectors.cols(), count);
  ASSERT_EQ(modes.vectors.rows(), pencil.K.rows());
  ASSERT_EQ(modes.residuals.size(), count);
  if (count == 0) return;
  const Matrix gram = modes.vectors.transpose() * (pencil.M * modes.vectors);
  EXPECT_LT((gram - Matrix::Identity(count, count)).cwiseAbs().maxCoeff(), 1e-11);
  EXPECT_LT(modes.orthogonality, 1e-11);
  for (int j = 0; j < count; ++j) {
    EXPECT_LT(modes.residuals[j], 1e-10) << "mode " << j;
    EXPECT_LE(modes.values[std::max(0, j - 1)], modes.values[j]);
    EXPECT_GT(modes.vectors(largestEntry(modes.vectors.col(j)), j), 0.0);
  }
}

const DofNamer spoken = [](int i) { return "<" + std::to_string(i) + ">"; };

TEST(EigenSolver, SpringChain) {
  for (const int n : {1, 2, 7, 150, 500, 808})
    for (const int count : {1, 6, 40, 300}) {
      if (count > n) continue;
      const Pencil chain = springChain(n, k, m);
      const EigenPairs modes = lowestModes(chain.K, chain.M, count);
      expectModes(chain, modes, count);
      EXPECT_EQ(isDense(modes), n < 200 || 3 * count > n) << modes.method;
      for (int j = 0; j < count; ++j)
        EXPECT_NEAR(modes.values[j] / heldChain(n, j), 1.0, 1e-9) << n << " " << count << " " << j;
    }
}

TEST(EigenSolver, AllModesAllButOneAndThreeHundredOfEightHundredAndEight) {
  for (const int n : {60, 230, 808})
    for (const int count : {n, n - 1, n == 808 ? 300 : n / 2}) {
      const Pencil chain = springChain(n, k, m);
      const EigenPairs modes = lowestModes(chain.K, chain.M, count);
      expectModes(chain, modes, count);
      EXPECT_NEAR(modes.values[count - 1] / heldChain(n, count - 1), 1.0, 1e-10);
    }
}

TEST(EigenSolver, KrylovAndDenseAgree) {
  const Pencil two = beam(75, 170.3, 3e6, 2);  // 300 dofs, every eigenvalue twice
  EigenOptions krylov, dense;
  krylov.denseBelow = 1;
  dense.denseBelow = 100000;
  const EigenPairs a = lowestModes(two.K, two.M, 60, krylov),
                   b = lowestModes(two.K, two.M, 60, dense);
  EXPECT_FALSE(isDense(a));
  EXPECT_TRUE(isDense(b));
  expectModes(two, a, 60);
  expectModes(two, b, 60);
  // Dense eigenvalues are accurate to the rounding of the largest one.
  const double rounding = 1e-15 * eigenvaluesBelow(two.K, two.M, 1.0) +
                          1e-13 * 12.0 * 3e6 / std::pow(170.3 / 75, 4) * 100.0;
  for (int j = 0; j < 60; ++j) EXPECT_NEAR(a.values[j], b.values[j], 1e-9 * a.values[j] + rounding);
  // Pairs span the same planes: the singular values of Phi_a' M Phi_b over all 60 modes are one.
  const Matrix overlap = a.vectors.transpose() * (two.M * b.vectors);
  EXPECT_LT((overlap * overlap.transpose() - Matrix::Identity(60, 60)).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(EigenSolver, EndsAfterASignal) {
  const auto chain = springChain(100, k, m);
  EigenOptions krylov;
  krylov.denseBelow = 1;
  requestInterrupt();
  EXPECT_THROW(lowestModes(chain.K, chain.M, 10, krylov), InterruptedError);
  requestInterrupt(false);
  EXPECT_EQ(lowestModes(chain.K, chain.M, 10, krylov).count(), 10);
}

TEST(EigenSolver, SimplySupportedBeamInTwoPlanes) {
  const double L = 170.3, EI = 3e6;
  const Pencil two = beam(150, L, EI, 2);
  const EigenPairs modes = lowestModes(two.K, two.M, 12);
  expectModes(two, modes, 12);
  // consistent mass and cubic elements: lambda is above by (q l)^4/720, and each comes twice
  for (int j = 0; j < 12; ++j) {
    const double q = (j / 2 + 1) * constants::pi / L, l = L / 150;
    EXPECT_NEAR(modes.values[j] / (EI * std::pow(q, 4)), 1.0 + std::pow(q * l, 4) / 720.0, 1e-6)
        << j;
  }
}

TEST(EigenSolver, PairsAreNeverCutWhenAsked) {
  for (const int elements : {30, 150}) {
    const Pencil two = beam(elements, 100.0, 3e6, 2);
    EigenOptions keep;
    keep.keepPairs = true;
    for (const int count : {1, 2, 5, 12}) {
      EXPECT_EQ(lowestModes(two.K, two.M, count).count(), count);
      const EigenPairs modes = lowestModes(two.K, two.M, count, keep);
      expectModes(two, modes, count + count % 2);
    }
  }
  // two chains that differ by 1e-4 are a pair only with a tolerance above that
  for (const int n : {40, 200}) {
    Pencil both = testing::sideBySide({springChain(n, k, m), springChain(n, 1.0001 * k, m)});
    EigenOptions keep;
    keep.keepPairs = true;
    EXPECT_EQ(lowestModes(both.K, both.M, 3, keep).count(), 3);
    keep.pairTolerance = 1e-3;
    EXPECT_EQ(lowestModes(both.K, both.M, 3, keep).count(), 4);
  }
}

TEST(EigenSolver, FindsEveryCopyOfManyfoldEigenvalues) {
  const Pencil seven = beam(20, 50.0, 3e6, 7);  // 280 dofs, every eigenvalue seven times
  const EigenPairs modes = lowestModes(seven.K, seven.M, 14);
  EXPECT_FALSE(isDense(modes));
  expectModes(seven, modes, 14);
  for (int j = 0; j < 14; ++j) EXPECT_NEAR(modes.values[j] / modes.values[7 * (j / 7)], 1.0, 1e-8);
  EXPECT_GT(modes.values[7], 10.0 * modes.values[6]);
  EigenOptions keep;
  keep.keepPairs = true;
  EXPECT_EQ(lowestModes(seven.K, seven.M, 8, keep).count(), 14);
}

TEST(EigenSolver, RigidBodyModesOfFreeBodies) {
  for (const int elements : {20, 60, 150}) {
    const double L = 60.0, EI = 3e6;
    const Pencil free = beam(elements, L, EI, 2, true);
    const EigenPairs modes = lowestModes(free.K, free.M, 8);
    expectModes(free, modes, 8);
    const double first = EI * std::pow(4.730040744862704 / L, 4),
                 second = EI * std::pow(7.853204624095838 / L, 4);
    for (int j = 0; j < 4; ++j) EXPECT_NEAR(modes.values[j] / first, 0.0, 1e-5) << j;
    for (int j = 4; j < 6; ++j) EXPECT_NEAR(modes.values[j] / first, 1.0, 1e-4) << j;
    for (int j = 6; j < 8; ++j) EXPECT_NEAR(modes.values[j] / second, 1.0, 2e-4) << j;
    EigenOptions keep;
    keep.keepPairs = true;
    EXPECT_EQ(lowestModes(free.K, free.M, 1, keep).count(), 4)
        << "all four rigid-body modes have the value zero";
  }
  const Pencil chain = springChain(500, k, m, true);
  const EigenPairs modes = lowestModes(chain.K, chain.M, 30);
  expectModes(chain, modes, 30);
  EXPECT_NEAR(modes.values[0] / freeChain(500, 1), 0.0, 1e-9);
  for (int j = 1; j < 30; ++j) EXPECT_NEAR(modes.values[j] / freeChain(500, j), 1.0, 1e-9);
}

/// A stiff block of masses in a lattice on four soft mounts at the corners of its floor: the lowest
/// value lies nine orders below the next one.
TEST(EigenSolver, OneModeFarBelowTheOthers) {
  constexpr int side = 6, n = side * side * side;
  const double link = 1e9, mass = 0.008;
  for (const double mount : {10.0, 60.0, 130.0, 300.0, 1e3}) {
    Triplets K, M;
    for (int i = 0; i < n; ++i) {
      M.emplace_back(i, i, mass);
      const int place[3] = {i % side, i / side % side, i / side / side};
      for (int axis = 0, step = 1; axis < 3; ++axis, step *= side)
        if (place[axis] + 1 < side)
          for (const auto& [row, column, sign] :
               {std::tuple{i, i, 1}, {i + step, i + step, 1}, {i, i + step, -1}, {i + step, i, -1}})
            K.emplace_back(row, column, sign * link);
    }
    for (const int corner : {0, side - 1, side * (side - 1), side * side - 1})
      K.emplace_back(corner, corner, mount);
    const Pencil block{testing::assembled(n, K), testing::assembled(n, M)};
    const EigenPairs modes = lowestModes(block.K, block.M, 6);
    expectModes(block, modes, 6);
    EXPECT_NEAR(modes.values[0] / (4 * mount / (n * mass)), 1.0, 1e-5) << mount;
    EXPECT_NEAR(modes.values[1] * mass / (4 * link * std::pow(std::sin(constants::pi / 12), 2)),
                1.0, 1e-6)
        << mount;
  }
}

TEST(EigenSolver, NegativeEigenvaluesOfABuckledBeamComeFirst) {
  const double L = 100.0, EI = 3e6, P = 5e4;  // P is beyond the seventh buckling load
  for (const int elements : {60, 200}) {
    const Pencil buckled = beam(elements, L, EI, 1, false, -P);
    std::vector<double> exact;
    for (int j = 1; j < 40; ++j) {
      const double q = j * constants::pi / L;
      exact.push_back(EI * std::pow(q, 4) - P * q * q);
    }
    std::sort(exact.begin(), exact.end());
    const EigenPairs modes = lowestModes(buckled.K, buckled.M, 8);
    expectModes(buckled, modes, 8);
    EXPECT_LT(modes.values[2], 0.0);
    for (int j = 0; j < 8; ++j)
      EXPECT_NEAR(modes.values[j], exact[static_cast<std::size_t>(j)],
                  1e-4 * (std::abs(exact[0]) + std::abs(exact[static_cast<std::size_t>(j)])))
          << j;
  }
}

TEST(EigenSolver, AllModesBelowACutOff) {
  for (const int n : {100, 400}) {
    const Pencil chain = springChain(n, k, m);
    for (const int below : {0, 1, 17, n / 2, n}) {
      const double cut = below == 0   ? 0.5 * heldChain(n, 0)
                         : below == n ? 2.0 * heldChain(n, n - 1)
                                      : 0.5 * (heldChain(n, below - 1) + heldChain(n, below));
      EXPECT_EQ(eigenvaluesBelow(chain.K, chain.M, cut), below);
      const EigenPairs modes = lowestModesBelow(chain.K, chain.M, std::sqrt(cut));
      expectModes(chain, modes, below);
      for (int j = 0; j < modes.count(); ++j)
        EXPECT_NEAR(modes.values[j] / heldChain(n, j), 1.0, 1e-9);
    }
  }
  // negative ones count as below any cut-off
  const Pencil buckled = beam(60, 100.0, 3e6, 1, false, -5e4);
  EXPECT_EQ(lowestModesBelow(buckled.K, buckled.M, 0.0).count(),
            eigenvaluesBelow(buckled.K, buckled.M, 0.0));
  EXPECT_GT(lowestModesBelow(buckled.K, buckled.M, 0.0).count(), 3);
  EXPECT_THROW(lowestModesBelow(buckled.K, buckled.M, -1.0), ModelError);
}

TEST(EigenSolver, CountsAreRightInEveryGapOfTheSpectrum) {
  // In the middle of the spectrum of a chain of equal masses every diagonal entry of K - lambda M
  // vanishes.
  for (const Pencil& pencil :
       {springChain(80, k, m), springChain(81, k, m), beam(40, 170.3, 3e6),
        beam(30, 60.0, 3e6, 2, true), beam(40, 100.0, 3e6, 1, false, -5e4)}) {
    const EigenPairs all = symmetricModes(Matrix(pencil.K), Matrix(pencil.M));
    const double rounding = 1e-12 * all.values.cwiseAbs().maxCoeff();
    for (int j = 1; j < all.count(); ++j) {
      if (all.values[j] - all.values[j - 1] < 100.0 * rounding) continue;
      EXPECT_EQ(eigenvaluesBelow(pencil.K, pencil.M, 0.5 * (all.values[j] + all.values[j - 1])), j);
    }
  }
}

TEST(EigenSolver, IsTheSameInEveryCall) {
  for (const int n : {150, 500}) {
    const Pencil pencil = n == 150 ? beam(75, 170.3, 3e6, 1) : beam(125, 170.3, 3e6, 2);
    std::srand(1);
    const EigenPairs first = lowestModes(pencil.K, pencil.M, 20);
    std::srand(12345);
    for (int draw = 0; draw < 777; ++draw) std::rand();
    const EigenPairs second = lowestModes(pencil.K, pencil.M, 20);
    EXPECT_TRUE(first.values == second.values);
    EXPECT_TRUE(first.vectors == second.vectors);
  }
}

TEST(EigenSolver, AUserShiftBelowTheSpectrumGivesTheSameModes) {
  const Pencil chain = springChain(400, k, m);
  EigenOptions options;
  options.shift = -1e3;
  const EigenPairs modes = lowestModes(chain.K, chain.M, 10, options);
  expectModes(chain, modes, 10);
  for (int j = 0; j < 10; ++j) EXPECT_NEAR(modes.values[j] / heldChain(400, j), 1.0, 1e-9);
  options.shift = 0.5 * (heldChain(400, 2) + heldChain(400, 3));
  EXPECT_NE(
      errorText([&] { lowestModes(chain.K, chain.M, 10, options); }).find("above 3 eigenvalue"),
      std::string::npos);
}

TEST(EigenSolver, ASolveThatClaimsConvergenceButIsNotIsAnError) {
  const Pencil two = beam(150, 170.3, 3e6, 2);
  Teuchos::ParameterList sloppy;
  sloppy.set("Convergence Tolerance", 0.3);
  sloppy.set("Block Size", 2);
  sloppy.set("Num Blocks", 24);
  EigenOptions options;
  options.anasazi = &sloppy;
  EXPECT_THROW(lowestModes(two.K, two.M, 30, options), ConvergenceError);
}

TEST(EigenSolver, AnUnconvergedSolveSaysWhatWasTried) {
  const Pencil two = beam(150, 170.3, 3e6, 2);
  Teuchos::ParameterList starved;
  starved.set("Block Size", 1);
  starved.set("Num Blocks", 36);
  starved.set("Maximum Restarts", 0);
  EigenOptions options;
  options.anasazi = &starved;
  const std::string text = errorText([&] { lowestModes(two.K, two.M, 30, options); });
  EXPECT_NE(text.find("4 attempts"), std::string::npos) << text;
  EXPECT_NE(text.find("Num Blocks"), std::string::npos) << text;
  // parameters that Anasazi refuses
  starved.set("Num Blocks", 5);
  EXPECT_THROW(lowestModes(two.K, two.M, 30, options), ConvergenceError);
}

TEST(EigenSolver, NamesTheDofWithoutMass) {
  EigenOptions options;
  options.name = spoken;
  for (const int n : {20, 300}) {
    Pencil chain = springChain(n, k, m);
    chain.M.coeffRef(7, 7) = 0.0;
    EXPECT_NE(errorText([&] { lowestModes(chain.K, chain.M, 5, options); }).find("<7>"),
              std::string::npos);
    chain.M.coeffRef(7, 7) = -1.0;
    EXPECT_THROW(lowestModes(chain.K, chain.M, 5), ModelError);
  }
  // semidefinite with a positive diagonal: two dofs share one mass
  Pencil chain = springChain(20, k, m);
  chain.M.coeffRef(3, 4) = m;
  chain.M.coeffRef(4, 3) = m;
  EXPECT_THROW(lowestModes(chain.K, chain.M, 5), ModelError);
}

TEST(EigenSolver, RefusesWhatIsNotASymmetricPencil) {
  Pencil chain = springChain(20, k, m);
  EXPECT_THROW(lowestModes(chain.K, chain.M, 21), ModelError);
  EXPECT_THROW(lowestModes(chain.K, chain.M, -1), ModelError);
  EXPECT_EQ(lowestModes(chain.K, chain.M, 0).count(), 0);
  EXPECT_THROW(lowestModes(chain.K, springChain(19, k, m).M, 3), ModelError);
  Sparse unsymmetric = chain.K;
  unsymmetric.coeffRef(4, 5) *= 1.001;
  EigenOptions options;
  options.name = spoken;
  const std::string text = errorText([&] { lowestModes(unsymmetric, chain.M, 3, options); });
  EXPECT_NE(text.find("<4>"), std::string::npos) << text;
  EXPECT_NE(text.find("<5>"), std::string::npos) << text;
  chain.K.coeffRef(2, 2) = std::nan("");
  EXPECT_NE(errorText([&] { lowestModes(chain.K, chain.M, 3, options); }).find("<2>"),
            std::string::npos);
}

/// Light or zero masses on springs at a chain do not change its modes, in any axes.
TEST(EigenSolver, LightDofsLeaveOtherModesTheirDigits) {
  constexpr int n = 60, lights = 3, all = n + lights;
  for (const double light : {1e-6, 1e-10, 1e-14, 0.0})
    for (const double angle : {0.0, 0.6}) {
      const Pencil chain = springChain(n, k, m);
      Matrix K = Matrix::Zero(all, all), M = Matrix::Zero(all, all),
             turn = Matrix::Identity(all, all);
      K.topLeftCorner(n, n) = chain.K;
      M.topLeftCorner(n, n) = chain.M;
      for (int i = 0; i < lights; ++i) {
        const int at = 7 * i + 3, own = n + i;
        K(at, at) += k, K(own, own) = k, K(at, own) = K(own, at) = -k, M(own, own) = light;
        turn(at, at) = turn(own, own) = std::cos(angle);
        turn(own, at) = std::sin(angle), turn(at, own) = -std::sin(angle);
      }
      const Sparse turnedK = Matrix(turn.transpose() * K * turn).sparseView(),
                   turnedM = Matrix(turn.transpose() * M * turn).sparseView();
      const bool rounded =
          light == 0.0 || (angle != 0.0 && light < 1e-7 * m);  // few digits of these masses
      for (const int count : {8, rounded ? n : all}) {
        const EigenPairs modes = light > 0.0 ? lowestModes(turnedK, turnedM, count)
                                             : lowestFiniteModes(turnedK, turnedM, count);
        ASSERT_EQ(modes.count(), count);
        for (int j = 0; j < std::min(count, n); ++j)
          EXPECT_NEAR(modes.values[j] / heldChain(n, j), 1.0, 1e-9 + 3 * light)
              << light << " " << angle << " " << count << " " << j;
        for (int j = n; j < count; ++j)
          EXPECT_NEAR(modes.values[j] * light / k, 1.0, 1e-5) << light;
      }
    }
}

TEST(EigenSolver, AFreeCoordinateBesideStiffOnesIsAccepted) {
  Matrix K = Matrix::Zero(3, 3);
  K.diagonal() << 0.0, 1e6, 4e10;
  Matrix M = Matrix::Identity(3, 3);
  M(0, 1) = M(1, 0) = 0.3;
  const auto modes = linalg::symmetricModes(K, M);
  EXPECT_NEAR(modes.values[0], 0.0, 1e-4);
  EXPECT_NEAR(modes.values[1], 1e6 / (1.0 - 0.09), 1e-3);
}

}  // namespace EigenSolverTest
}  // namespace tooljoint::linalg
