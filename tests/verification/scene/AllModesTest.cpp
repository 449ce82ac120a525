// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// With every interior mode kept the coupled model is the full model in other coordinates, for any
/// division of the string: the same eigenvalues, and the same motion in contact with the same
/// integrator and step.
#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "tests/support/Scenes.hpp"

namespace AllModesTest {

using namespace tooljoint;

/// Eigenvalues of sym(K) phi = lambda M phi, dense, without vectors.
Vector eigenvalues(const model::SecondOrderModel& model) {
  const Matrix stiffness = model.stiffnessAt(0.0);
  const Matrix mass = model.mass;
  return Eigen::GeneralizedSelfAdjointEigenSolver<Matrix>(0.5 * (stiffness + stiffness.transpose()),
                                                          0.5 * (mass + mass.transpose()),
                                                          Eigen::EigenvaluesOnly)
      .eigenvalues();
}

struct Cut {
  const char* name;
  int parts;
  std::vector<std::string> overrides;
};

void PrintTo(const Cut& cut, std::ostream* out) { *out << cut.name; }

class AllModes : public ::testing::TestWithParam<Cut> {};

TEST_P(AllModes, IsTheFullModel) {
  // Half of the string, since the eigenvalues are computed with dense matrices. Few nodes are
  // retained, so that most coordinates are modal; step and tolerance are those of both runs.
  std::vector<std::string> overrides{
      "Drillstring/Assembly={pipe, last pipe, collar, stabiliser, 2*collar, stabiliser, collar, "
      "bit}",
      "!Reduction", "Reduction/Mode Selection/All Modes=true",
      "Substructures/Retained Nodes=Gauges", "Transient/End Time=0.25", "Transient/Step=0.001",
      "Transient/Generalized-alpha/Tolerance=1e-12",
      // taken at an iterate, so equal in both models only to the root of the tolerance
      "Transient/Generalized-alpha/Phase Correction=false", "Transient/Progress=false",
      "Transient/Energy Ledger=false"};
  overrides.insert(overrides.end(), GetParam().overrides.begin(), GetParam().overrides.end());
  const auto scene = testing_::reference(overrides);
  const auto stage = drillstring::solveStatic(scene);
  const auto full = drillstring::fullModel(stage);
  ASSERT_EQ(drillstring::cut(scene, stage).size(), static_cast<std::size_t>(GetParam().parts));
  const auto coupled = testing_::reduced(scene, stage);
  ASSERT_EQ(coupled.size(), full.size());

  const Vector expected = eigenvalues(full);
  const Vector found = eigenvalues(coupled);
  const double largest = expected.cwiseAbs().maxCoeff();
  for (Eigen::Index i = 0; i < expected.size(); ++i)
    EXPECT_NEAR(found(i), expected(i), 1e-9 * std::abs(expected(i)) + 1e-15 * largest)
        << "eigenvalue " << i + 1;

  EXPECT_LE(testing_::largestError(testing_::move(scene, coupled), testing_::move(scene, full)),
            1e-8);
}

INSTANTIATE_TEST_SUITE_P(Cuts, AllModes,
                         ::testing::Values(Cut{"one part", 1, {"Substructures/Rule=Single"}},
                                           Cut{"three parts",
                                               3,
                                               {"Substructures/Rule=By nodes",
                                                "Substructures/Cut Nodes={20, 45}"}},
                                           Cut{"twenty parts",
                                               20,
                                               {"Substructures/Rule=By nodes",
                                                "Substructures/Cut Nodes={4, 7, 10, 13, 16, 19, "
                                                "22, 25, 28, 31, 34, 37, 40, 43, 46, 49, 52, 55, "
                                                "58}"}}));

}  // namespace AllModesTest
