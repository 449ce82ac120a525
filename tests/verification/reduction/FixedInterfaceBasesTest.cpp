// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Properties of every basis with constraint modes, whatever its modal vectors: with all of them
/// the model is the full one, floating parts stay free, responses to loads on boundary dofs are
/// exact, and frequencies converge from above.
#include <Eigen/Dense>
#include <Teuchos_ParameterList.hpp>
#include <fstream>
#include <gtest/gtest.h>

#include "io/MatrixMarket.hpp"
#include "linalg/Deterministic.hpp"
#include "tests/support/CoupledChecks.hpp"
#include "tests/support/SampleParts.hpp"

namespace FixedInterfaceBasesTest {

using namespace tooljoint;
using namespace tooljoint::reduction;

struct Case {
  std::string basis;
  friend std::ostream& operator<<(std::ostream& out, const Case& chosen) {
    return out << chosen.label;
  }
  std::function<void(Teuchos::ParameterList&)> set = [](Teuchos::ParameterList&) {};
  std::string label;
};

std::vector<Case> cases() {
  return {
      {"Craig-Bampton", [](auto&) {}, "CraigBampton"},
      {"Krylov", [](auto&) {}, "KrylovStatic"},
      {"Krylov", [](auto& list) { list.set("Expansion Frequency", 31.0); }, "KrylovShifted"},
      {"Krylov", [](auto& list) { list.set("Damped", true).set("Expansion Frequency", 8.0); },
       "KrylovDamped"},
      {"Complex Craig-Bampton", [](auto& list) { list.set("Time", 0.5); }, "ComplexCraigBampton"},
      {"Enhanced Craig-Bampton", [](auto&) {}, "EnhancedTied"},
      {"Enhanced Craig-Bampton", [](auto& list) { list.set("Residual Coordinates", "Free"); },
       "EnhancedFree"},
      {"User Vectors", [](auto& list) { list.set("File", "vectors of %.mtx"); }, "UserVectors"}};
}

/// Files of arbitrary vectors, as many as each part has interior dofs.
void writeVectors(const std::vector<model::Substructure>& parts) {
  for (const auto& part : parts)
    if (!part.interior().empty())
      std::ofstream("vectors of " + part.name + ".mtx")
          << io::matrixMarketText(linalg::scatteredNumbers(
                 part.model.size(), static_cast<Eigen::Index>(part.interior().size()), 5));
}

class FixedInterfaceBases : public testing::TestWithParam<Case> {
 protected:
  coupling::Synthesis synthesis(const std::vector<model::Substructure>& parts,
                                int modes = -1) const {
    if (GetParam().basis == "User Vectors") writeVectors(parts);
    return checks::synthesise(parts, GetParam().basis, modes, GetParam().set);
  }
};

TEST_P(FixedInterfaceBases, AllVectorsGiveTheFullEigenvalues) {
  for (const bool retain : {false, true}) {
    const auto parts = samples::loopFrame(6, false, retain);
    checks::expectSameEigenvalues(coupling::couple(parts), synthesis(parts).coupled.model);
  }
}

TEST_P(FixedInterfaceBases, AllVectorsGiveTheDampedEigenvaluesOfASpinningFrame) {
  const auto parts = samples::loopFrame(4, true, true);
  checks::expectSameDampedEigenvalues(coupling::couple(parts), synthesis(parts).coupled.model, 0.7);
}

TEST_P(FixedInterfaceBases, FloatingAssembliesKeepTheirRigidBodyModes) {
  for (const int modes : {0, 3, 7}) {
    const auto parts = checks::floatingFrame(8);
    EXPECT_EQ(checks::zeroEnergyModes(coupling::couple(parts)), 3);
    EXPECT_EQ(checks::zeroEnergyModes(synthesis(parts, modes).coupled.model), 3)
        << modes << " modes";
  }
}

// Tied residual coordinates deform with M^-1 K z, which is M^-1 f for a static load f: their
// statics are not exact.
TEST_P(FixedInterfaceBases, LoadsOnKeptDofsAreAnsweredExactly) {
  if (GetParam().label == "EnhancedTied") GTEST_SKIP() << "not promised";
  const auto parts = samples::loopFrame(6, true, true);
  for (const int modes : {0, 2, 5})
    EXPECT_LT(checks::staticError(coupling::couple(parts), synthesis(parts, modes).coupled.model),
              1e-10)
        << modes << " modes";
}

TEST_P(FixedInterfaceBases, FrequenciesComeFromAbove) {
  const auto parts = samples::loopFrame(8, false);
  const Vector full = checks::eigenvalues(coupling::couple(parts));
  for (const int modes : {1, 4, 9}) {
    const Vector small = checks::eigenvalues(synthesis(parts, modes).coupled.model);
    for (Eigen::Index k = 0; k < small.size(); ++k)
      EXPECT_GE(small[k], full[k] * (1 - 1e-11) - 1e-15 * full.maxCoeff())
          << modes << " modes, k = " << k;
  }
}

TEST_P(FixedInterfaceBases, StructureIsThatOfCraigBampton) {
  const auto parts = samples::loopFrame(8, false);
  for (const auto& part : synthesis(parts, 5).parts) {
    EXPECT_TRUE(part.report.structureEnforced)
        << part.report.massDefect << " " << part.report.stiffnessDefect;
    EXPECT_EQ(part.report.rank, part.size());
    EXPECT_LT(part.report.staticDefect, 1e-10);
    EXPECT_LT(part.report.orthogonality, 1e-11);
  }
}

TEST_P(FixedInterfaceBases, PartsWithoutInteriorOrInterface) {
  auto pair = samples::bar("pair", 1, 1, 3.0, 2.0);
  samples::classify(pair, {}, {1, 2});
  const auto rigid = synthesis({pair}, 4).coupled.model;
  EXPECT_LT((Matrix(rigid.mass) - Matrix(pair.model.mass)).norm(), 1e-14);
  const auto loose = samples::bar("loose", 1, 8, 3.0, 2.0);
  const auto free = synthesis({loose}, 3);
  EXPECT_GE(free.coupled.model.size(), 3);
  if (GetParam().basis == "User Vectors") {  // which hold no rigid motion here: that is said
    ASSERT_FALSE(free.parts[0].report.remarks.empty());
    EXPECT_NE(free.parts[0].report.remarks.back().find("rigid-body motion is not preserved"),
              std::string::npos);
    return;
  }
  EXPECT_NEAR(checks::eigenvalues(free.coupled.model)[0], 0.0, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(All, FixedInterfaceBases, testing::ValuesIn(cases()),
                         [](const auto& chosen) { return chosen.param.label; });

}  // namespace FixedInterfaceBasesTest
