// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Counts of full eigenvalues from the parts against those of the full model.
#include "coupling/ModeCount.hpp"

#include <Teuchos_ParameterList.hpp>
#include <cmath>
#include <gtest/gtest.h>

#include "coupling/CoupledModes.hpp"
#include "linalg/trilinos/EigenSolver.hpp"
#include "tests/support/SampleParts.hpp"

namespace ModeCountTest {

using namespace tooljoint;
using coupling::Assembly;

coupling::Synthesis reducedBy(const std::string& method,
                              const std::vector<model::Substructure>& parts, int modes,
                              Assembly assembly) {
  reduction::ReductionOptions options;
  options.modes.kind = reduction::ModeRule::Kind::PerPart;
  options.modes.counts = {modes};
  coupling::CouplingOptions coupling;
  coupling.assembly = assembly;
  return coupling::synthesise(parts, *reduction::makeBasis(method, Teuchos::ParameterList()),
                              options, coupling);
}

/// A chain whose left end is clamped, or that floats.
std::vector<model::Substructure> chain(bool floats) {
  std::vector<model::Substructure> parts{
      samples::bar("left", 1, 9, 100.0, 0.2, floats ? std::vector<int>{} : std::vector<int>{1}),
      samples::bar("middle", 10, 7, 140.0, 0.25), samples::bar("right", 17, 11, 90.0, 0.3)};
  samples::classify(parts[0], {10});
  samples::classify(parts[1], {10, 17});
  samples::classify(parts[2], {17});
  return parts;
}

/// Bounds between all eigenvalues of the full model.
void expectSameCounts(const std::vector<model::Substructure>& parts,
                      const coupling::Synthesis& synthesis, const std::string& what) {
  const auto full = coupling::couple(parts);
  const Vector values = coupling::lowestModes(full, full.size()).values;
  const Eigen::Index step = std::max<Eigen::Index>(1, values.size() / 12);
  int counted = 0;
  for (Eigen::Index j = 0; j + 1 < values.size(); j += step) {
    if (values[j + 1] - values[j] < 1e-3 * values[j + 1]) continue;
    const double bound = values[j] + 0.37 * (values[j + 1] - values[j]);
    EXPECT_EQ(coupling::fullEigenvaluesBelow(parts, synthesis, bound), j + 1)
        << what << ", bound " << bound;
    ++counted;
  }
  EXPECT_GE(counted, 6) << what;
}

/// A large part stores its stiffness once; an unsymmetric one, or a sum, is averaged.
TEST(UndampedStiffness, IsTheOnlyTermItselfWhereThatIsSymmetric) {
  auto model = samples::bar("bar", 1, 9, 100.0, 0.2).model;
  const model::MatrixTerm only = model.stiffness[0];
  const Matrix K = only.matrix.sparse();
  model.stiffness = {only};
  EXPECT_TRUE(coupling::undampedStiffness(model).sharesWith(only.matrix));
  Matrix skewed = K;
  skewed(0, 1) += 1.0;
  model.stiffness = {{only.name, Sparse(skewed.sparseView()), only.law}};
  EXPECT_EQ(Matrix(coupling::undampedStiffness(model).sparse()),
            Matrix(0.5 * (skewed + skewed.transpose())));
  model.stiffness = {only, only};
  EXPECT_EQ(Matrix(coupling::undampedStiffness(model).sparse()), Matrix(2.0 * K));
}

TEST(ModeCount, IsThatOfTheFullModelWhateverTheBasis) {
  for (const std::string method : {"Craig-Bampton", "Guyan", "Rubin", "Craig-Chang", "Krylov"})
    for (const int modes : {1, 3, 1000})
      for (const bool floats : {false, true}) {
        const auto parts = chain(floats);
        expectSameCounts(parts, reducedBy(method, parts, modes, Assembly::Primal),
                         method + (floats ? ", floats" : ""));
      }
}

TEST(ModeCount, HoldsForLoopsAndDualAssembly) {
  const auto parts = samples::loopFrame(6, false, true);
  for (const auto assembly : {Assembly::Primal, Assembly::Dual})
    for (const int modes : {0, 2, 5})
      expectSameCounts(parts, reducedBy("Craig-Bampton", parts, modes, assembly), "loop");
}

}  // namespace ModeCountTest
