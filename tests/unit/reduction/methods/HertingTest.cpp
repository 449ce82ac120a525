// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Herting's basis: its special cases are Craig and Bampton's and Rubin's; inertia relief is exact
/// for steady acceleration.
#include <Eigen/Dense>
#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <gtest/gtest.h>

#include "linalg/DenseDecompositions.hpp"
#include "linalg/trilinos/DirectSolver.hpp"
#include "tests/support/BasisFamilies.hpp"

namespace HertingTest {

using namespace tooljoint;
using namespace tooljoint::reduction;

ReducedSubstructure reduced(const model::Substructure& part, const std::string& basis,
                            const std::string& support, bool relief, int modes) {
  Teuchos::ParameterList list;
  list.sublist("Herting").set("Mode Supports", support).set("Inertia Relief", relief);
  return reduce(part, makeBasis(basis, list)->build(part, samples::modes(modes)),
                ReductionOptions(), 0);
}

TEST(Herting, ContainsCraigBamptonAndRubin) {
  for (const auto& part : samples::loopFrame(8, false, true)) {
    const Vector cb = samples::eigenvalues(reduced(part, "Craig-Bampton", "Free", true, 5).model);
    const Vector fixed = samples::eigenvalues(reduced(part, "Herting", "Fixed", false, 5).model);
    const Vector rubin = samples::eigenvalues(reduced(part, "Rubin", "Free", true, 5).model);
    const Vector free = samples::eigenvalues(reduced(part, "Herting", "Free", true, 5).model);
    ASSERT_EQ(cb.size(), fixed.size());
    ASSERT_EQ(rubin.size(), free.size());
    for (Eigen::Index i = 0; i < cb.size(); ++i)
      EXPECT_NEAR(cb[i], fixed[i], 1e-9 * cb[i] + 1e-13 * cb[cb.size() - 1]);
    for (Eigen::Index i = 0; i < rubin.size(); ++i)
      EXPECT_NEAR(rubin[i], free[i], 1e-9 * rubin[i] + 1e-13 * rubin[rubin.size() - 1]);
  }
}

TEST(Herting, InertiaReliefAddsOneVectorForEachRigidBodyMode) {
  const auto part = samples::loopFrame(8, false)[2];  // floats: 3
  const auto without = reduced(part, "Herting", "Fixed", false, 4),
             with = reduced(part, "Herting", "Fixed", true, 4);
  EXPECT_EQ(without.modes, 4);
  EXPECT_EQ(with.modes, 7);
  EXPECT_EQ(std::count_if(with.report.rows->begin(), with.report.rows->end(),
                          [](const auto& row) { return row.kind == "inertia-relief"; }),
            3);
  EXPECT_EQ(reduced(samples::loopFrame(8, false)[0], "Herting", "Fixed", true, 4).modes, 4)
      << "a clamped part has none";
}

// The part under its own weight between held interfaces: K_II D_I = (M Phi_r a)_I is in the space
// without any mode.
TEST(Herting, WeightIsAnsweredExactly) {
  const auto part = samples::loopFrame(8, false)[2];
  Vector gravity = Vector::Zero(part.model.size());
  for (int i = 0; i < part.model.size(); ++i)
    gravity[i] = part.model.dofs[static_cast<std::size_t>(i)].component == 1 ? -9.81 : 0.0;
  const Vector weight = part.model.mass * gravity;
  for (const auto* support : {"Free", "Fixed"}) {
    const auto small = reduced(part, "Herting", support, true, 0);
    const Matrix Phi = small.basis->vectors, k = small.model.stiffness.front().matrix;
    const Eigen::Index modes = small.modes, kept = small.interface;
    const Vector answer = linalg::solveSymmetric(k.bottomRightCorner(modes, modes),
                                                 Vector((Phi.transpose() * weight).tail(modes)));
    const auto& interior = small.basis->partition.interior;
    Vector load(static_cast<Eigen::Index>(interior.size()));
    for (std::size_t i = 0; i < interior.size(); ++i)
      load[static_cast<Eigen::Index>(i)] = weight[interior[i]];
    const Vector exact =
        linalg::DirectSolver(block(constantStiffness(part.model), interior, interior)).solve(load);
    const Vector recovered = Phi.rightCols(modes) * answer;
    for (std::size_t i = 0; i < interior.size(); ++i)
      EXPECT_NEAR(recovered[interior[i]], exact[static_cast<Eigen::Index>(i)],
                  1e-9 * exact.cwiseAbs().maxCoeff())
          << support;
    EXPECT_EQ(kept, 6);
  }
}

}  // namespace HertingTest
