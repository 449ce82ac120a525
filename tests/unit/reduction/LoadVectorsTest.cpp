// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Load vectors: static responses to loads of the interior are exact with any modes.
#include <Eigen/Dense>
#include <Teuchos_Array.hpp>
#include <Teuchos_ParameterList.hpp>
#include <functional>
#include <gtest/gtest.h>

#include "common/Error.hpp"
#include "linalg/DenseDecompositions.hpp"
#include "reduction/Reduce.hpp"
#include "tests/support/BasisFamilies.hpp"
#include "tests/support/CoupledChecks.hpp"
#include "tests/support/ListDefaults.hpp"

namespace LoadVectorsTest {

using namespace tooljoint;
using namespace tooljoint::reduction;

/// The frame with a load on every part and springs at two nodes of each.
std::vector<model::Substructure> loadedFrame(bool spinning) {
  auto parts = samples::loopFrame(8, spinning, true);
  for (std::size_t p = 0; p < parts.size(); ++p) {
    auto& m = parts[p].model;
    const int base = 100 * (static_cast<int>(p) + 1);
    samples::addCubicSprings(parts[p], {base + 1, base + 3});
    Vector load = Vector::Zero(m.size());
    for (int i = 0; i < m.size(); ++i)
      load[i] = m.dofs[static_cast<std::size_t>(i)].entity > 100 ? 1e3 * std::sin(1.7 * i) : 0.0;
    m.loads.push_back({"wind", load, 0});
  }
  return parts;
}

coupling::Synthesis synthesise(const std::vector<model::Substructure>& parts,
                               const std::string& basis, const LoadVectorOptions& loads,
                               int modes) {
  ReductionOptions options;
  options.basis = basis;
  options.modes.kind = ModeRule::Kind::PerPart;
  options.modes.counts = {modes};
  options.loadVectors = loads;
  return coupling::synthesise(parts, *makeBasis(basis, Teuchos::ParameterList("Reduction")),
                              options);
}

/// Largest difference of K D = F, as recovered, relative to the largest displacement.
double answerError(const model::SecondOrderModel& full, const model::SecondOrderModel& small,
                   const Vector& fullLoad, const Vector& smallLoad) {
  const auto answer = [](const model::SecondOrderModel& m, const Vector& load) {
    return Vector(m.recovery * linalg::DenseLu(Matrix(constantStiffness(m))).solve(load));
  };
  const Vector a = answer(full, fullLoad), b = answer(small, smallLoad);
  double worst = 0;
  for (std::size_t n = 0; n < full.recoveryNodes.size(); ++n) {
    const auto at =
        std::find(small.recoveryNodes.begin(), small.recoveryNodes.end(), full.recoveryNodes[n]) -
        small.recoveryNodes.begin();
    worst = std::max(worst, (a.segment<3>(3 * static_cast<Eigen::Index>(n)) - b.segment<3>(3 * at))
                                .cwiseAbs()
                                .maxCoeff());
  }
  return worst / a.cwiseAbs().maxCoeff();
}

LoadVectorOptions loadsOnly() {
  LoadVectorOptions options;
  options.loads = true;
  return options;
}

TEST(LoadVectors, AnswersToLoadsAreExact) {
  for (const bool spinning : {false, true})
    for (const std::string basis : {"Craig-Bampton", "Krylov", "Complex Craig-Bampton"})
      for (const int modes : {0, 3}) {
        const auto parts = loadedFrame(spinning);
        const auto full = coupling::couple(parts);
        const auto without = synthesise(parts, basis, {}, modes).coupled.model,
                   with = synthesise(parts, basis, loadsOnly(), modes).coupled.model;
        EXPECT_GT(answerError(full, without, full.loadAt(0), without.loadAt(0)), 1e-4) << basis;
        EXPECT_LT(answerError(full, with, full.loadAt(0), with.loadAt(0)), 1e-10)
            << basis << ", " << modes << " modes";
        EXPECT_EQ(with.size(), without.size() + 4) << "one load of each part";
      }
}

TEST(LoadVectors, UnitForcesOnPointsAreAnsweredExactly) {
  const auto parts = loadedFrame(false);
  LoadVectorOptions options;
  options.points = true;
  const auto full = coupling::couple(parts),
             small = synthesise(parts, "Craig-Bampton", options, 2).coupled.model;
  ASSERT_EQ(full.points.size(), small.points.size());
  for (std::size_t s = 0; s < full.points.size(); ++s)
    for (Eigen::Index r = 0; r < full.points[s].rows.rows(); ++r)
      EXPECT_LT(answerError(full, small, Vector(full.points[s].rows.row(r).transpose()),
                            Vector(small.points[s].rows.row(r).transpose())),
                1e-10);
}

/// A start that moves one node is not in a small basis, and the reported energy is large; with
/// vectors of the initial state it is complete.
TEST(StartStateVectors, PutTheStartIntoTheBasis) {
  auto parts = loadedFrame(false);
  for (auto& part : parts) {
    auto& m = part.model;
    for (int i = 0; i < m.size(); ++i)
      if (m.dofs[static_cast<std::size_t>(i)].entity == 103) m.initialVelocity[i] = 2.0;
    for (int i = 0; i < m.size(); ++i)
      if (m.dofs[static_cast<std::size_t>(i)].entity == 203) m.initialDisplacement[i] = 0.01;
  }
  const auto energies = [&](const LoadVectorOptions& options) {
    double energy = 0, misfit = 0;
    for (const auto& part : synthesise(parts, "Craig-Bampton", options, 2).parts) {
      energy += part.report.startEnergy;
      misfit += part.report.startMisfit;
    }
    return std::make_pair(energy, misfit);
  };
  const auto without = energies({});
  EXPECT_GT(without.second, 0.1 * without.first);
  LoadVectorOptions options;
  options.startState = true;
  const auto with = energies(options);
  EXPECT_DOUBLE_EQ(with.first, without.first);
  EXPECT_LT(with.second, 1e-12 * with.first);
  // each of the two alone
  const auto moved = parts;
  for (auto& part : parts) part.model.initialDisplacement.setZero();
  const auto velocity = energies({});
  EXPECT_GT(velocity.second, 0.1 * velocity.first);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    parts[i].model.initialVelocity.setZero();
    parts[i].model.initialDisplacement = moved[i].model.initialDisplacement;
  }
  const auto displacement = energies({});
  EXPECT_GT(displacement.second, 0.1 * displacement.first);
  EXPECT_NEAR(velocity.second + displacement.second, without.second, 1e-9 * without.second);
  for (auto& part : parts) part.model.initialDisplacement.setZero();
  EXPECT_EQ(energies({}), std::make_pair(0.0, 0.0));
  EXPECT_EQ(synthesise(parts, "Craig-Bampton", options, 2).coupled.model.size(),
            synthesise(parts, "Craig-Bampton", {}, 2).coupled.model.size());
}

TEST(LoadVectors, OnlyChosenNodes) {
  const auto parts = loadedFrame(false);
  LoadVectorOptions options;
  options.points = true;
  const int all = synthesise(parts, "Craig-Bampton", options, 2).coupled.model.size();
  options.nodes = {101, 303};
  const int some = synthesise(parts, "Craig-Bampton", options, 2).coupled.model.size();
  const int none = synthesise(parts, "Craig-Bampton", {}, 2).coupled.model.size();
  EXPECT_EQ(some, none + 4) << "u and v of two nodes";
  EXPECT_EQ(all, none + 16);
  options.nodes = {101, 77};
  EXPECT_THROW(synthesise(parts, "Craig-Bampton", options, 2), DeckError);
}

TEST(LoadVectors, KeepTheStructureAndTheModes) {
  const auto parts = loadedFrame(false);
  const auto without = synthesise(parts, "Craig-Bampton", {}, 3),
             with = synthesise(parts, "Craig-Bampton", loadsOnly(), 3);
  for (std::size_t p = 0; p < parts.size(); ++p) {
    EXPECT_TRUE(with.parts[p].report.structureEnforced)
        << with.parts[p].report.massDefect << " " << with.parts[p].report.stiffnessDefect;
    const Vector &before = without.parts[p].basis->eigenvalues,
                 &after = with.parts[p].basis->eigenvalues;
    for (const double value : before)
      EXPECT_LT((after.array() - value).abs().minCoeff(), 1e-9 * value)
          << "the modes are still there";
  }
}

TEST(LoadVectors, AllModesLeaveNothingToAdd) {
  const auto parts = loadedFrame(false);
  ReductionOptions options;
  options.loadVectors = loadsOnly();
  const auto small =
      coupling::synthesise(parts, *makeBasis("Craig-Bampton", Teuchos::ParameterList("Reduction")),
                           options)
          .coupled.model;
  EXPECT_EQ(small.size(), coupling::couple(parts).size());
}

TEST(LoadVectors, IdenticalPartsWithOtherLoadsAreReducedApart) {
  std::vector<model::Substructure> parts;
  for (int p = 0; p < 4; ++p) {
    parts.push_back(samples::bar("bar " + std::to_string(p), 1 + 8 * p, 8, 3.0, 2.0));
    samples::classify(parts.back(), p == 0   ? std::vector<int>{9}
                                    : p == 3 ? std::vector<int>{25}
                                             : std::vector<int>{1 + 8 * p, 9 + 8 * p});
    parts.back().interface = p == 0   ? std::vector<int>{8}
                             : p == 3 ? std::vector<int>{0}
                                      : std::vector<int>{0, 8};
    Vector load = Vector::Zero(9);
    load[4] = p == 2 ? 2.0 : 1.0;
    load[5] = p == 2 ? 1.0 : 0.0;
    parts.back().model.loads.push_back({"pull", load, 0});
  }
  EXPECT_EQ(synthesise(parts, "Craig-Bampton", {}, 2).parts[2].report.sharedWith, "bar 1");
  EXPECT_EQ(synthesise(parts, "Craig-Bampton", loadsOnly(), 2).parts[2].report.sharedWith, "");
}

TEST(LoadVectors, FloatingPiecesAreBalancedByTheirInertia) {
  auto part = samples::bar("loose", 1, 8, 3.0, 2.0);
  Vector load = Vector::Zero(9);
  load[2] = 1.0;
  part.model.loads.push_back({"pull", load, 0});
  Basis basis = makeBasis("Craig-Bampton", Teuchos::ParameterList("Reduction"))
                    ->build(part, samples::modes(1));
  addLoadVectors(part, loadsOnly(), basis);
  ASSERT_EQ(basis.modes(), 2);
  // K x = f - M a with the acceleration a of the rigid bar is in the span.
  const Matrix K = constantStiffness(part.model), M = part.model.mass, V = Matrix(basis.vectors);
  const Vector rigid = Vector::Ones(9);
  const Vector balanced = load - M * rigid * (rigid.dot(load) / rigid.dot(M * rigid));
  const Vector x = Eigen::FullPivLU<Matrix>(K).solve(balanced);
  const Vector fitted = V * linalg::solveSymmetric(V.transpose() * V, Vector(V.transpose() * x));
  EXPECT_LT((fitted - x).norm(), 1e-10 * x.norm());
}

TEST(LoadVectors, TheDeckIsRead) {
  deck::ListSpec spec("Reduction", "");
  declareLoadVectors(spec);
  Teuchos::ParameterList list = test::defaultsOf(spec);
  EXPECT_FALSE(readLoadVectors(list).any());
  list.set("Load Vectors", "Loads and points");
  EXPECT_TRUE(readLoadVectors(list).loads && readLoadVectors(list).points);
  list.set("Load Vector Nodes", Teuchos::Array<int>(Teuchos::tuple<int>(3, 4)));
  EXPECT_EQ(readLoadVectors(list).nodes.size(), 2u);
  list.set("Load Vectors", "Loads");
  EXPECT_THROW(readLoadVectors(list), DeckError);
}

}  // namespace LoadVectorsTest
