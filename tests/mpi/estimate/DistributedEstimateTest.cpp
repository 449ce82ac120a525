// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The same coupled frequencies, estimates and chosen modes on any number of ranks.
#include <Teuchos_ParameterList.hpp>
#include <gtest/gtest.h>

#include "common/Parallel.hpp"
#include "common/report/Log.hpp"
#include "coupling/CoupledModes.hpp"
#include "coupling/assembly/Assembler.hpp"
#include "estimate/AdaptiveReduction.hpp"
#include "linalg/trilinos/EigenSolver.hpp"
#include "substructures/drillstring/scene/Scene.hpp"
#include "substructures/drillstring/scene/Stages.hpp"
#include "tests/support/SampleParts.hpp"
#include "tests/support/SourceFolder.hpp"

namespace DistributedEstimateTest {

using namespace tooljoint;

Vector frequencies(const model::SecondOrderModel& model, int count) {
  return linalg::lowestModes(coupling::undampedStiffness(model),
                             reduction::symmetricPart(model.mass), count)
      .values.cwiseAbs()
      .cwiseSqrt();
}

/// Largest difference between this rank's values and those of rank 0.
double spread(const Vector& mine) {
  Vector root = mine;
  parallel::broadcast(root, 0);
  return parallel::maximum(root.size() == mine.size() ? (root - mine).cwiseAbs().maxCoeff()
                                                      : 1e300);
}

/// The parts reduced by this rank alone, with the numbers of modes of `like`, and coupled.
model::SecondOrderModel alone(const std::vector<model::Substructure>& parts,
                              const coupling::Synthesis& like) {
  const auto basis = reduction::makeBasis("Craig-Bampton", Teuchos::ParameterList());
  std::vector<reduction::ReducedSubstructure> reduced;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    reduction::ModeRequest request;
    request.kind = reduction::ModeRequest::Kind::Count;
    request.count = like.parts[p].modes;
    reduced.push_back(
        reduction::reduce(parts[p], basis->build(parts[p], request), {}, static_cast<int>(p)));
  }
  return coupling::couple(reduced);
}

void expectSame(const std::vector<model::Substructure>& parts, double tolerance) {
  reduction::ReductionOptions options;
  options.modes.kind = reduction::ModeRule::Kind::Tolerance;
  options.modes.frequencyTolerance = tolerance;
  estimate::EstimateOptions estimates;
  estimates.window.count = 12;
  const auto outcome = estimate::synthesise(
      parts, *reduction::makeBasis("Craig-Bampton", Teuchos::ParameterList()), options, estimates);
  const Vector together = frequencies(outcome.synthesis.coupled.model, 12);
  const Vector single = frequencies(alone(parts, outcome.synthesis), 12);
  for (Eigen::Index i = 0; i < together.size(); ++i)
    EXPECT_NEAR(together[i], single[i], 1e-10 * single[i]) << i;
  Vector numbers(static_cast<Eigen::Index>(parts.size() + outcome.frequencies.size()));
  for (std::size_t p = 0; p < parts.size(); ++p)
    numbers[static_cast<Eigen::Index>(p)] = outcome.synthesis.parts[p].modes;
  for (std::size_t j = 0; j < outcome.frequencies.size(); ++j)
    numbers[static_cast<Eigen::Index>(parts.size() + j)] = outcome.frequencies[j].error;
  EXPECT_EQ(spread(numbers), 0.0) << "every rank chooses and estimates the same";
  EXPECT_EQ(spread(together), 0.0);
}

TEST(DistributedEstimate, AFrameHasTheSameFrequenciesOnAnyNumberOfRanks) {
  for (double tolerance : {1e-2, 1e-5}) expectSame(samples::loopFrame(12, true, true), tolerance);
}

TEST(DistributedEstimate, TheReferenceSceneHasTheSameFrequenciesOnAnyNumberOfRanks) {
  const auto scene = drillstring::readScene(testing_::sourceFolder() + "/xml/helical_170m.xml", {});
  expectSame(drillstring::cut(scene, drillstring::solveStatic(scene)), 1e-4);
}

TEST(DistributedEstimate, CriteriaOfTheInterfaceChooseTheSameOnEveryRank) {
  for (const auto kind :
       {reduction::ModeRule::Kind::InterfaceMass, reduction::ModeRule::Kind::InterfaceMoment}) {
    reduction::ReductionOptions options;
    options.modes.kind = kind;
    options.modes.fraction = 0.95;
    const auto parts = samples::loopFrame(12, true, true);
    const auto reduced = reduction::reduceAll(
        parts, *reduction::makeBasis("Craig-Bampton", Teuchos::ParameterList()), options);
    Vector numbers(static_cast<Eigen::Index>(parts.size()));
    for (std::size_t p = 0; p < parts.size(); ++p)
      numbers[static_cast<Eigen::Index>(p)] = reduced[p].basis->eigenvalues.sum();
    EXPECT_EQ(spread(numbers), 0.0);
  }
}

}  // namespace DistributedEstimateTest
