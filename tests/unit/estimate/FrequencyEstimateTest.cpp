// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Estimated errors of coupled frequencies against true ones: chains of bars, a frame with a loop,
/// rigid bodies.
#include "estimate/FrequencyEstimate.hpp"

#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>

#include "Reduced.hpp"
#include "common/Constants.hpp"
#include "coupling/CoupledModes.hpp"
#include "estimate/AdaptiveReduction.hpp"
#include "estimate/ModeComparison.hpp"
#include "linalg/trilinos/EigenSolver.hpp"
#include "reduction/methods/InterfaceBasis.hpp"
#include "tests/support/SampleParts.hpp"

namespace FrequencyEstimateTest {

using namespace tooljoint;

using estimate::reduced;

/// Three bars in a row, clamped at the left.
std::vector<model::Substructure> bars() {
  std::vector<model::Substructure> parts{samples::bar("left", 1, 20, 100.0, 0.2, {1}),
                                         samples::bar("middle", 21, 20, 140.0, 0.25),
                                         samples::bar("right", 41, 20, 90.0, 0.2)};
  samples::classify(parts[0], {21});
  samples::classify(parts[1], {21, 41});
  samples::classify(parts[2], {41});
  return parts;
}

Vector frequencies(const model::SecondOrderModel& model, int count) {
  const Sparse K = coupling::undampedStiffness(model);
  return linalg::lowestModes(K, reduction::symmetricPart(model.mass), count)
      .values.cwiseMax(0.0)
      .cwiseSqrt();
}

/// Estimate over true error, for every mode whose true error is above rounding; prints the table.
std::vector<double> effectivities(const std::vector<model::Substructure>& parts, int modes,
                                  int count) {
  const auto synthesis = reduced(parts, modes);
  count = std::min(count, synthesis.coupled.model.size());
  const Vector full = frequencies(coupling::couple(parts), count);
  const Vector coupled = frequencies(synthesis.coupled.model, count);
  const auto estimates = estimate::estimateFrequencies(parts, synthesis, {count, 0});
  std::vector<double> ratios;
  for (int j = 0; j < count; ++j) {
    const double truth = coupled[j] / full[j] - 1.0;
    const auto& e = estimates[static_cast<std::size_t>(j)];
    std::printf("modes %2d, frequency %2d: true %.2e, estimated %.2e%s\n", modes, j + 1, truth,
                e.error, e.definite ? "" : " (a mode is missing below)");
    if (truth > 1e-11 && e.definite) ratios.push_back(e.error / truth);
  }
  return ratios;
}

TEST(FrequencyEstimate, IsWithinAFactorOfThreeForBarsAndFrames) {
  int counted = 0;
  for (int modes : {1, 2, 4, 8})
    for (const auto& parts :
         {bars(), samples::loopFrame(12, false), samples::loopFrame(12, false, true)})
      for (double ratio : effectivities(parts, modes, 8)) {
        EXPECT_GT(ratio, 1.0 / 3.0);
        EXPECT_LT(ratio, 3.0);
        ++counted;
      }
  EXPECT_GT(counted, 60);
}

/// A retained dof with very little mass between retained dofs: it must not turn modes into
/// rigid-body modes.
TEST(FrequencyEstimate, IsThereBesideALightDof) {
  auto parts = bars();
  samples::classify(parts[1], {21, 41}, {29, 30, 31});
  Triplets mass;
  const int light = samples::find(parts[1].model, model::DofLabel::physical(30, 0));
  const Sparse whole = parts[1].model.mass;
  for (int i = 0; i < whole.outerSize(); ++i)
    for (Sparse::InnerIterator it(whole, i); it; ++it)
      if (i != light && it.col() != light) mass.emplace_back(i, it.col(), it.value());
  mass.emplace_back(light, light, 1e-17);
  parts[1].model.mass = samples::square(parts[1].model.size(), mass);
  const auto ratios = effectivities(parts, 1, 4);
  EXPECT_EQ(ratios.size(), 4u);
  for (double ratio : ratios) {
    EXPECT_GT(ratio, 1.0 / 3.0);
    EXPECT_LT(ratio, 3.0);
  }
}

/// Parts of one or two interior dofs without modes: the two Krylov vectors of a part complete its
/// basis, and the single coupled mode together with them spans the whole model, so that the
/// estimate is the true error.
TEST(FrequencyEstimate, IsExactWhereTheKrylovVectorsAreAllThatIsLeftOut) {
  for (const int interior : {1, 2}) {
    std::vector<model::Substructure> parts{
        samples::bar("left", 1, interior + 1, 100.0, 0.2, {1}),
        samples::bar("right", interior + 2, interior + 1, 140.0, 0.5, {2 * interior + 3})};
    for (auto& part : parts) samples::classify(part, {interior + 2});
    const auto synthesis = reduced(parts, 0);
    ASSERT_EQ(synthesis.coupled.model.size(), 1);
    const double truth =
        frequencies(synthesis.coupled.model, 1)[0] / frequencies(coupling::couple(parts), 1)[0] -
        1.0;
    EXPECT_GT(truth, 1e-3);
    const auto estimate = estimate::estimateFrequencies(parts, synthesis, {1, 0}).front();
    EXPECT_NEAR(estimate.error, truth, 1e-9 * truth);
    EXPECT_NEAR(estimate.byPart.sum(), truth, 1e-9 * truth);
    EXPECT_GT(estimate.byPart.minCoeff(), 0.05 * truth);
    EXPECT_NEAR(constants::twoPi * estimate.frequency(), frequencies(synthesis.coupled.model, 1)[0],
                1e-9 * estimate.frequency());
  }
}

TEST(FrequencyEstimate, IsZeroWithAllModes) {
  const auto parts = samples::loopFrame(8, false);
  const auto estimates = estimate::estimateFrequencies(parts, reduced(parts, 1000), {6, 0});
  ASSERT_EQ(estimates.size(), 6u);
  for (const auto& e : estimates) EXPECT_LT(std::abs(e.error), 1e-9);
}

/// Craig-Bampton parts with modes of all joined dofs instead of these dofs.
coupling::Synthesis withInterfaceModes(const std::vector<model::Substructure>& parts, int modes,
                                       int interfaceModes) {
  reduction::ReductionOptions options;
  options.modes.kind = reduction::ModeRule::Kind::PerPart;
  options.modes.counts = {modes};
  reduction::InterfaceOptions interface;
  interface.modes = interfaceModes;
  options.interface = reduction::systemInterfaceModes(interface);
  return coupling::synthesise(
      parts, *reduction::makeBasis("Craig-Bampton", Teuchos::ParameterList()), options);
}

/// The estimate includes the error of an interface reduction; with all modes of the parts it is the
/// true error to rounding.
TEST(FrequencyEstimate, IncludesTheInterfaceReduction) {
  const auto parts = samples::loopFrame(12, false);
  const auto full = coupling::couple(parts);
  for (const int modes : {4, 1000}) {
    const auto synthesis = withInterfaceModes(parts, modes, 2);
    double largest = 0;
    for (const auto& mode : estimate::compareModes(full, parts, synthesis, 4)) {
      ASSERT_TRUE(mode.estimated);
      EXPECT_NEAR(mode.estimate, mode.error, 0.02 * std::abs(mode.error) + 1e-8);
      largest = std::max(largest, mode.error);
    }
    EXPECT_GT(largest, 0.05);
    const auto estimates = estimate::estimateFrequencies(parts, synthesis, {4, 0});
    const auto most =
        std::max_element(estimates.begin(), estimates.end(),
                         [](const auto& x, const auto& y) { return x.error < y.error; });
    EXPECT_GT(most->interfaces, 0.9 * most->error);
    EXPECT_NE(estimate::frequencyTable(estimates, parts).find("interfaces"), std::string::npos);
    for (const auto& mode : estimate::compareDampedModes(full, parts, synthesis, 4, 0.0))
      EXPECT_FALSE(mode.estimated) << "would leave it out";
  }
}

TEST(FrequencyEstimate, FindsThePartThatLacksModes) {
  const auto parts = bars();
  reduction::ReductionOptions options;
  options.modes.kind = reduction::ModeRule::Kind::PerPart;
  options.modes.counts = {8, 0, 8};
  const auto synthesis = coupling::synthesise(
      parts, *reduction::makeBasis("Craig-Bampton", Teuchos::ParameterList()), options);
  const auto estimates = estimate::estimateFrequencies(parts, synthesis, {3, 0});
  ASSERT_EQ(estimates.size(), 3u);
  for (const auto& e : estimates) {
    Eigen::Index worst = 0;
    e.byPart.maxCoeff(&worst);
    EXPECT_EQ(worst, 1);
  }
}

TEST(FrequencyEstimate, LeavesRigidBodiesAlone) {
  std::vector<model::Substructure> parts{samples::bar("left", 1, 10, 100.0, 0.2),
                                         samples::bar("right", 11, 10, 140.0, 0.25)};
  samples::classify(parts[0], {11});
  samples::classify(parts[1], {11});
  const auto estimates = estimate::estimateFrequencies(parts, reduced(parts, 2), {3, 0});
  EXPECT_EQ(estimates[0].error, 0.0);
  EXPECT_EQ(estimates[0].frequency(), 0.0) << estimates[0].eigenvalue;  // not zero, because of
                                                                        // rounding
  EXPECT_GT(estimates[1].frequency(), 0.0);
  EXPECT_GT(estimates[2].error, 0.0);
}

TEST(FrequencyEstimate, TellsAFrequencyAboveAMissingMode) {
  const auto estimates = estimate::estimateFrequencies(bars(), reduced(bars(), 0), {2, 0});
  EXPECT_TRUE(estimates[0].definite);
  EXPECT_FALSE(estimates[1].definite);
}

/// A mass on a stiff spring carries a light oscillator and two equal ones joined by a spring; the
/// difference mode of the two, lambda = (10 + 2 * 20) / 1, moves nothing else.
model::Substructure oscillators() {
  model::Substructure part;
  part.name = "oscillators";
  part.model.componentNames = {"u"};
  const Matrix spring = (Matrix(2, 2) << 1, -1, -1, 1).finished();
  Triplets stiffness;
  samples::add(stiffness, Matrix::Constant(1, 1, 4000.0), {0});
  for (const int i : {1, 2, 3}) samples::add(stiffness, 10.0 * spring, {0, i});
  samples::add(stiffness, 20.0 * spring, {1, 2});
  for (const int node : {1, 2, 3, 4}) part.model.dofs.push_back(model::DofLabel::physical(node, 0));
  part.model.mass = samples::square(4, {{0, 0, 4.0}, {1, 1, 1.0}, {2, 2, 1.0}, {3, 3, 1e-3}});
  part.model.stiffness.push_back({"elastic", samples::square(4, stiffness), 0});
  samples::complete(part);
  part.retained = {0};
  return part;
}

// No residual contains the missing motion: only a count detects it.
TEST(FrequencyEstimate, CountsModesThatNoResidualSees) {
  const std::vector<model::Substructure> parts{oscillators()};
  const auto synthesis = reduced(parts, 1);  // the sum of the equal oscillators
  ASSERT_EQ(synthesis.coupled.model.size(), 2);
  const Vector coupled = frequencies(synthesis.coupled.model, 2);
  const Vector full = frequencies(coupling::couple(parts), 4);
  EXPECT_NEAR(full[1], std::sqrt(50.0), 1e-9);
  EXPECT_NEAR(coupled[1], full[2], 1e-3 * full[2]);
  const auto estimates = estimate::estimateFrequencies(parts, synthesis, {2, 0});
  EXPECT_TRUE(estimates[0].definite);
  EXPECT_NEAR(estimates[1].error, coupled[1] / full[2] - 1.0, 1e-9);
  EXPECT_FALSE(estimates[1].definite);
  EXPECT_EQ(estimate::largestError(estimates), 1.0);
  for (const auto& e : estimate::estimateFrequencies(parts, reduced(parts, 2), {3, 0}))
    EXPECT_TRUE(e.definite);
}

}  // namespace FrequencyEstimateTest
