// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Owners, identical parts, and the transfer of a reduced part as bytes.
#include "reduction/project/Distribution.hpp"

#include <Teuchos_ParameterList.hpp>
#include <gtest/gtest.h>

#include "common/Error.hpp"
#include "common/report/EvaluationCounters.hpp"
#include "reduction/Reduce.hpp"
#include "reduction/project/IdenticalParts.hpp"
#include "tests/support/SampleParts.hpp"

namespace DistributionTest {

using namespace tooljoint;
using namespace tooljoint::reduction;

ReductionOptions perPart(int count) {
  ReductionOptions options;
  options.modes.kind = ModeRule::Kind::PerPart;
  options.modes.counts = {count};
  return options;
}

std::unique_ptr<ReductionMethod> craigBampton() {
  return makeBasis("Craig-Bampton", Teuchos::ParameterList());
}

std::vector<model::Substructure> pipes(int count) {
  std::vector<model::Substructure> parts;
  for (int p = 0; p < count; ++p) {
    parts.push_back(samples::bar("pipe " + std::to_string(p + 1), 1 + 8 * p, 8, 3.0, 2.0));
    std::vector<int> ends;
    if (p > 0) ends.push_back(1 + 8 * p);
    if (p + 1 < count) ends.push_back(9 + 8 * p);
    samples::classify(parts.back(), ends);
    parts.back().rounding = 1e-9;  // as parts of a string
  }
  return parts;
}

TEST(AssignOwners, BalancesHeaviestFirst) {
  EXPECT_EQ(assignOwners({5, 1, 9, 4}, 1), (std::vector<int>{0, 0, 0, 0}));
  EXPECT_EQ(assignOwners({5, 1, 9, 4}, 2), (std::vector<int>{1, 0, 0, 1}));
  EXPECT_EQ(assignOwners({7, 7}, 4), (std::vector<int>{0, 1}));
  EXPECT_TRUE(assignOwners({}, 3).empty());
}

/// Large parts whose work exceeds the share of a rank.
TEST(DividedParts, AreLargeAndMoreThanTheShareOfARank) {
  EXPECT_EQ(dividedParts({90000}, 1), (std::vector<char>{0}));
  EXPECT_EQ(dividedParts({90000}, 2), (std::vector<char>{1}));
  EXPECT_EQ(dividedParts({15000}, 2), (std::vector<char>{0}));
  EXPECT_EQ(dividedParts({90000, 30000, 25000}, 2), (std::vector<char>{1, 0, 0}));
  EXPECT_EQ(dividedParts({30000, 30000}, 2), (std::vector<char>{0, 0}));
}

TEST(FindTwins, FindsIdenticalPartsWhateverTheirLabelsAndLoads) {
  auto parts = pipes(5);
  parts[2].model.loads.push_back({"weight", Vector::Ones(9), 0});
  std::vector<ModeRequest> requests(5);
  EXPECT_EQ(findIdenticalParts(parts, requests), (std::vector<int>{0, 1, 1, 1, 4}))
      << "the ends have another interface";
  requests[3].kind = ModeRequest::Kind::Count;
  EXPECT_EQ(findIdenticalParts(parts, requests), (std::vector<int>{0, 1, 1, 3, 4}))
      << "another number of modes";
  requests[3] = requests[1];
  parts[3].model.stiffness.own()[0].matrix.coeffRef(4, 4) *= 1 + 1e-10;
  EXPECT_EQ(findIdenticalParts(parts, requests), (std::vector<int>{0, 1, 1, 1, 4}))
      << "rounding of its length";
  parts[3].model.stiffness.own()[0].matrix.coeffRef(4, 4) *= 1 + 1e-8;
  EXPECT_EQ(findIdenticalParts(parts, requests), (std::vector<int>{0, 1, 1, 3, 4}))
      << "another stiffness";
  parts[2].model.stiffness.push_back({"geometric", 1e-14 * parts[2].model.stiffness[0].matrix, 0});
  parts[1].model.stiffness.push_back({"geometric", 3e-14 * parts[1].model.stiffness[0].matrix, 0});
  EXPECT_EQ(findIdenticalParts(parts, requests), (std::vector<int>{0, 1, 1, 3, 4}))
      << "a force that is rounding";
  parts[1].model.stiffness.own()[1].matrix *= 1e6;
  EXPECT_EQ(findIdenticalParts(parts, requests), (std::vector<int>{0, 1, 2, 3, 4}))
      << "another force";
}

/// Springs to the ground of 20 and 60 N/m beside 1e11 N/m within the bars: rounding in a string,
/// but the only support of an imported part.
TEST(FindTwins, ImportedPartsHaveTheSameEntries) {
  std::vector<model::Substructure> parts;
  for (const double ground : {20.0, 60.0, 20.0}) {
    parts.push_back(samples::bar("bar", 1, 8, 1e11, 2.0));
    parts.back().model.stiffness.own()[0].matrix.coeffRef(0, 0) += ground;
  }
  const std::vector<ModeRequest> requests(3);
  EXPECT_EQ(findIdenticalParts(parts, requests), (std::vector<int>{0, 1, 0}));
}

TEST(FindTwins, IdenticalPartsAreReducedOnce) {
  auto parts = pipes(6);
  parts[3].model.loads.push_back({"weight", Vector::Ones(9), 0});
  resetEvaluationCounters();
  const auto twins = reduceAll(parts, *craigBampton(), perPart(3));
  EXPECT_EQ(counted("parts reduced"), 3);
  EXPECT_EQ(twins[3].report.sharedWith, "pipe 2");
  EXPECT_EQ(twins[3].basisRows()[0].name, "u of node 25");
  EXPECT_EQ(twins[3].model.loads.size(), 1u);
  EXPECT_EQ(twins[2].model.loads.size(), 0u);
  EXPECT_TRUE(twins[3].model.mass.sharesWith(twins[1].model.mass));
  EXPECT_TRUE(twins[3].model.stiffness[0].matrix.sharesWith(twins[1].model.stiffness[0].matrix));
  EXPECT_TRUE(twins[3].model.recovery.sharesWith(twins[1].model.recovery))
      << "the same rows times the same basis";
  EXPECT_FALSE(twins[0].model.mass.sharesWith(twins[1].model.mass));
  for (std::size_t p = 0; p < parts.size(); ++p) {  // the same as reduced separately
    ModeRequest request;
    request.kind = ModeRequest::Kind::Count;
    request.count = 3;
    const auto alone =
        reduce(parts[p], craigBampton()->build(parts[p], request), perPart(3), static_cast<int>(p));
    EXPECT_EQ((Matrix(alone.model.mass) - Matrix(twins[p].model.mass)).norm(), 0.0);
    EXPECT_TRUE(alone.model.dofs == twins[p].model.dofs);
    EXPECT_EQ((alone.model.loadAt(0) - twins[p].model.loadAt(0)).norm(), 0.0);
  }
}

TEST(Pack, BringsBackEverything) {
  const auto part = samples::loopFrame(6, true, true)[2];
  ModeRequest request;
  request.kind = ModeRequest::Kind::Count;
  request.count = 4;
  ReducedCore core;
  core.basis = craigBampton()->build(part, request);
  core.matrices = projectMatrices(part, core.basis);
  const auto reduced = reduce(part, core.basis, perPart(4), 0);
  core.report = reduced.report;
  const ReducedCore copy = unpack(pack(core));
  EXPECT_EQ((Matrix(copy.basis.vectors) - Matrix(core.basis.vectors)).norm(), 0.0);
  EXPECT_EQ(copy.basis.partition.blocks, core.basis.partition.blocks);
  EXPECT_EQ(copy.basis.partition.boundary, core.basis.partition.boundary);
  EXPECT_EQ(copy.basis.modeKind, core.basis.modeKind);
  EXPECT_EQ(copy.basis.candidates, core.basis.candidates);
  ASSERT_EQ(copy.matrices.damping.size(), core.matrices.damping.size());
  for (std::size_t i = 0; i < copy.matrices.damping.size(); ++i) {
    EXPECT_EQ(copy.matrices.damping[i].name, core.matrices.damping[i].name);
    EXPECT_EQ(copy.matrices.damping[i].law, core.matrices.damping[i].law);
    EXPECT_EQ(
        (Matrix(copy.matrices.damping[i].matrix) - Matrix(core.matrices.damping[i].matrix)).norm(),
        0.0);
  }
  EXPECT_EQ(copy.report.table(true), core.report.table(true));
  EXPECT_EQ(copy.report.cutOffHz(), core.report.cutOffHz());
  EXPECT_EQ(pack(copy), pack(core));
  std::string torn = pack(core);
  torn.resize(torn.size() / 2);
  EXPECT_THROW(unpack(torn), Error);
  EXPECT_THROW(unpack(pack(core) + "x"), Error);
}

TEST(TotalModes, AreTheLowestOfAllParts) {
  // Bars of different stiffness: the soft one gets more modes.
  std::vector<model::Substructure> parts{samples::bar("soft", 1, 30, 1.0, 1.0),
                                         samples::bar("stiff", 31, 30, 100.0, 1.0)};
  samples::classify(parts[0], {31});
  samples::classify(parts[1], {31});
  ReductionOptions all;
  const auto whole = reduceAll(parts, *craigBampton(), all);
  std::vector<double> spectrum;
  for (const auto& part : whole)
    spectrum.insert(spectrum.end(), part.basis->eigenvalues.begin(), part.basis->eigenvalues.end());
  std::sort(spectrum.begin(), spectrum.end());
  for (int total : {0, 1, 7, 25, 41, 60, 99}) {
    ReductionOptions options;
    options.modes.kind = ModeRule::Kind::Total;
    options.modes.total = total;
    options.modes.pairTolerance = 0;
    const auto reduced = reduceAll(parts, *craigBampton(), options);
    std::vector<double> kept;
    for (const auto& part : reduced)
      kept.insert(kept.end(), part.basis->eigenvalues.begin(), part.basis->eigenvalues.end());
    std::sort(kept.begin(), kept.end());
    ASSERT_EQ(kept.size(), std::min<std::size_t>(static_cast<std::size_t>(total), spectrum.size()))
        << total;
    for (std::size_t i = 0; i < kept.size(); ++i)
      EXPECT_NEAR(kept[i], spectrum[i], 1e-9 * spectrum[i]);
    if (total == 25) {
      EXPECT_GT(reduced[0].modes, reduced[1].modes);
      EXPECT_NE(reduced[1].report.table().find("above the lowest 25 of all parts"),
                std::string::npos);
    }
  }
}

TEST(TotalModes, TwinsGetTheSameNumber) {
  const auto parts = pipes(5);
  for (int total : {1, 2, 4, 9}) {
    ReductionOptions options;
    options.modes.kind = ModeRule::Kind::Total;
    options.modes.total = total;
    const auto reduced = reduceAll(parts, *craigBampton(), options);
    EXPECT_EQ(reduced[1].modes, reduced[2].modes);
    EXPECT_EQ(reduced[1].modes, reduced[3].modes);
    int kept = 0;
    for (const auto& part : reduced) kept += part.modes;
    EXPECT_GE(kept, total);
    EXPECT_LE(kept, total + 2);
  }
}

}  // namespace DistributionTest
