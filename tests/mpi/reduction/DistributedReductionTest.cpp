// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The same reduced parts and the same coupled model on any number of ranks, and the same message
/// on all ranks for an error on one of them.
#include <Teuchos_ParameterList.hpp>
#include <gtest/gtest.h>

#include "common/Error.hpp"
#include "common/Interrupt.hpp"
#include "common/Parallel.hpp"
#include "common/report/Log.hpp"
#include "coupling/assembly/Assembler.hpp"
#include "reduction/Reduce.hpp"
#include "tests/support/SampleParts.hpp"

namespace DistributedReductionTest {

using namespace tooljoint;
using namespace tooljoint::reduction;

ReductionOptions options(ModeRule::Kind kind) {
  ReductionOptions chosen;
  chosen.modes.kind = kind;
  chosen.modes.counts = {5};
  chosen.modes.total = 13;
  chosen.modes.cutOffHz = 500;
  return chosen;
}

std::vector<model::Substructure> frame() {
  auto parts = samples::loopFrame(8, true, true);
  for (std::size_t p = 0; p < parts.size(); ++p) {
    samples::addCubicSprings(parts[p], {100 * (static_cast<int>(p) + 1) + 1});
    parts[p].model.loads.push_back({"weight", Vector::Ones(parts[p].model.size()), 0});
  }
  return parts;
}

/// Result of one rank without the others.
std::vector<ReducedSubstructure> alone(const std::vector<model::Substructure>& parts,
                                       const std::vector<ReducedSubstructure>& like,
                                       const ReductionMethod& basis,
                                       const ReductionOptions& chosen) {
  std::vector<ReducedSubstructure> reduced;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    ModeRequest request;
    request.kind = ModeRequest::Kind::Count;
    request.count = like[p].modes;
    reduced.push_back(
        reduce(parts[p], basis.build(parts[p], request), chosen, static_cast<int>(p)));
  }
  return reduced;
}

double difference(const Sparse& a, const Sparse& b) {
  const Matrix left = a, right = b;
  if (left.rows() != right.rows() || left.cols() != right.cols()) return 1e300;
  return left.size() == 0 ? 0.0 : (left - right).norm() / std::max(1e-300, left.norm());
}

/// Largest difference between this rank's value and rank 0's.
double spread(const Vector& mine) {
  Vector root = mine;
  parallel::broadcast(root, 0);
  const double local = root.size() == mine.size()
                           ? (root.size() > 0 ? (root - mine).cwiseAbs().maxCoeff() : 0.0)
                           : 1e300;
  return parallel::maximum(local);
}

TEST(DistributedReduction, ASignalToOneRankEndsAll) {
  const auto parts = frame();
  const auto basis = makeBasis("Craig-Bampton", Teuchos::ParameterList());
  requestInterrupt(parallel::rank() == parallel::size() - 1);
  EXPECT_THROW(reduceAll(parts, *basis, options(ModeRule::Kind::PerPart)), InterruptedError);
  requestInterrupt(false);
}

TEST(DistributedReduction, IsTheReductionOfOneRank) {
  const auto parts = frame();
  const auto basis = makeBasis("Craig-Bampton", Teuchos::ParameterList());
  for (const auto kind : {ModeRule::Kind::PerPart, ModeRule::Kind::Total, ModeRule::Kind::CutOff,
                          ModeRule::Kind::All}) {
    const auto chosen = options(kind);
    const auto together = reduceAll(parts, *basis, chosen);
    const auto single = alone(parts, together, *basis, chosen);
    for (std::size_t p = 0; p < parts.size(); ++p) {
      const auto& a = together[p].model;
      const auto& b = single[p].model;
      EXPECT_TRUE(a.dofs == b.dofs);
      EXPECT_LE(difference(a.mass, b.mass), 1e-12);
      EXPECT_LE(difference(a.stiffnessAt(0.3), b.stiffnessAt(0.3)), 1e-12);
      EXPECT_LE(difference(a.dampingAt(0.3), b.dampingAt(0.3)), 1e-12);
      EXPECT_LE(difference(a.points[0].rows, b.points[0].rows), 1e-12);
      EXPECT_LE(difference(a.recovery, b.recovery), 1e-12);
      EXPECT_LE((a.loadAt(0.3) - b.loadAt(0.3)).norm(), 1e-12 * b.loadAt(0.3).norm());
      EXPECT_EQ(a.points[0].law, parts[p].model.points[0].law) << "the law is this rank's own";
      EXPECT_TRUE(together[p].report.checked);
      EXPECT_EQ(together[p].report.modes, single[p].report.modes);
    }
    const Vector values = Matrix(coupling::couple(together).stiffnessAt(0.3)).reshaped();
    EXPECT_EQ(spread(values), 0.0) << "every rank holds the same numbers";
  }
}

TEST(DistributedReduction, AnErrorOnOneRankIsTheErrorOfAll) {
  auto parts = samples::loopFrame(8, false, true);
  // Part 4 cannot be reduced: only its end is kept, in one direction.
  parts[3].interface.clear();
  parts[3].retained = {samples::find(parts[3].model, model::DofLabel::physical(5, 0))};
  const auto basis = makeBasis("Craig-Bampton", Teuchos::ParameterList());
  std::string sentence;
  try {
    reduceAll(parts, *basis, options(ModeRule::Kind::PerPart));
  } catch (const ModelError& error) {
    sentence = error.what();
  }
  EXPECT_NE(sentence.find("Part \"cantilever\": its interior is a mechanism"), std::string::npos)
      << sentence;
  std::string root = sentence;
  parallel::broadcast(root, 0);
  EXPECT_EQ(sentence, root);
}

TEST(DistributedReduction, RanksWithoutAPartIdleWithOneWarning) {
  auto part = samples::bar("only", 1, 10, 3.0, 2.0);
  samples::classify(part, {}, {1, 11});
  log::clearWarnings();
  const auto basis = makeBasis("Craig-Bampton", Teuchos::ParameterList());
  const auto reduced = reduceAll({part}, *basis, options(ModeRule::Kind::PerPart));
  reduceAll({part}, *basis, options(ModeRule::Kind::PerPart));
  EXPECT_EQ(log::warnings().size(), parallel::size() > 1 ? 1u : 0u);
  EXPECT_EQ(reduced[0].modes, 5);
  EXPECT_EQ(spread(reduced[0].basis->eigenvalues), 0.0);
}

}  // namespace DistributedReductionTest
