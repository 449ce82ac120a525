// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Characteristic constraint modes: against the statically condensed frame in dense algebra, static
/// responses, dofs that stay, and messages for interfaces that cannot be reduced.
#include "coupling/interface/InterfaceReduction.hpp"

#include <Eigen/Dense>
#include <Teuchos_ParameterList.hpp>
#include <functional>
#include <gtest/gtest.h>
#include <map>

#include "common/Error.hpp"
#include "coupling/CoupledModes.hpp"
#include "coupling/Synthesis.hpp"
#include "linalg/DenseDecompositions.hpp"
#include "linalg/trilinos/DirectSolver.hpp"
#include "reduction/ReductionParameters.hpp"
#include "tests/support/ErrorText.hpp"
#include "tests/support/ListDefaults.hpp"
#include "tests/support/SpaceFrame.hpp"

namespace InterfaceReductionTest {

using namespace tooljoint;
using namespace tooljoint::coupling;
using model::DofLabel;
using reduction::InterfaceOptions;

enum class Level { System, Local };

std::shared_ptr<const reduction::InterfaceBasis> interfaceModes(Level level, int modes,
                                                                bool loads = true,
                                                                bool keepPointLaws = true,
                                                                double cutOffHz = 0) {
  InterfaceOptions options;
  options.modes = modes;
  options.cutOffHz = cutOffHz;
  options.loadVectors = loads;
  return level == Level::System ? reduction::systemInterfaceModes(options, keepPointLaws)
                                : reduction::localInterfaceModes(options, keepPointLaws);
}

Synthesis synthesis(const std::vector<model::Substructure>& parts, int modes,
                    std::shared_ptr<const reduction::InterfaceBasis> interface,
                    const CouplingOptions& coupling = {},
                    const std::string& basis = "Craig-Bampton") {
  reduction::ReductionOptions options;
  options.modes.kind =
      modes < 0 ? reduction::ModeRule::Kind::All : reduction::ModeRule::Kind::PerPart;
  options.modes.counts = {modes};
  options.interface = std::move(interface);
  auto list = test::defaultsOf(reduction::parameters());
  list.set("Basis", basis);
  return synthesise(parts, *reduction::makeBasis(basis, list), options, coupling);
}

/// The weight of every part along z.
std::vector<model::Substructure> loaded(std::vector<model::Substructure> parts) {
  for (auto& part : parts) {
    Vector down = Vector::Zero(part.model.size());
    for (int i = 0; i < part.model.size(); ++i)
      down[i] = part.model.dofs[static_cast<std::size_t>(i)].component == 2 ? -1.0 : 0.0;
    part.model.loads.push_back({"weight", part.model.mass * down * 9.81, 0});
  }
  return parts;
}

Vector staticAnswer(const model::SecondOrderModel& m) {
  return linalg::DirectSolver(m.stiffnessAt(0)).solve(m.loadAt(0));
}

/// Displacement of all nodes, rows in the order of the nodes.
Vector recovered(const model::SecondOrderModel& m, const Vector& z) {
  const auto components = static_cast<Eigen::Index>(m.componentNames.size());
  std::map<std::int64_t, Vector> nodes;
  const Vector all = m.recovery * z + m.recoveryOffset;
  for (std::size_t i = 0; i < m.recoveryNodes.size(); ++i)
    nodes[m.recoveryNodes[i]] = all.segment(static_cast<Eigen::Index>(i) * components, components);
  Vector out(all.size());
  Eigen::Index row = 0;
  for (const auto& [node, value] : nodes) {
    out.segment(row, components) = value;
    row += components;
  }
  return out;
}

class InterfaceReduction : public testing::TestWithParam<Level> {
 protected:
  samples::FiveMembers frame{6};
};

TEST_P(InterfaceReduction, WithAllModesNothingChanges) {
  const auto plain = synthesis(frame.parts(), 5, nullptr).coupled;
  const auto reduced =
      synthesis(frame.parts(), 5, interfaceModes(GetParam(), GetParam() == Level::System ? 18 : 6))
          .coupled;
  EXPECT_EQ(plain.interface.size(), 18u);
  EXPECT_EQ(plain.interfaceModes, -1);
  EXPECT_EQ(reduced.interfaceModes, 18);
  EXPECT_EQ(reduced.interface.size(), 18u);
  ASSERT_EQ(reduced.model.size(), plain.model.size());
  const Vector a = lowestModes(plain.model, plain.model.size()).values,
               b = lowestModes(reduced.model, reduced.model.size()).values;
  for (Eigen::Index i = 0; i < a.size(); ++i)
    EXPECT_LE(std::abs(b[i] - a[i]), 1e-9 * a[i] + 1e-15 * a[a.size() - 1]) << "mode " << i + 1;
}

TEST_P(InterfaceReduction, DependentCoordinatesLeaveTheInterfacesApart) {
  // Residual coordinates depend on all joined dofs: the members of each interface stay the same.
  const std::string basis = "Enhanced Craig-Bampton";
  const auto plain = synthesis(frame.parts(), 2, nullptr, {}, basis).coupled;
  const auto reduced =
      synthesis(frame.parts(), 2, interfaceModes(GetParam(), GetParam() == Level::System ? 18 : 6),
                {}, basis)
          .coupled;
  EXPECT_GT(plain.dependent, 0);
  EXPECT_EQ(reduced.interfaceModes, 18);
  const Vector a = lowestModes(plain.model, 8).values, b = lowestModes(reduced.model, 8).values;
  for (Eigen::Index i = 0; i < a.size(); ++i) EXPECT_NEAR(b[i] / a[i], 1.0, 1e-9) << i + 1;
}

TEST_P(InterfaceReduction, FrequenciesComeFromAboveAndFallWithEveryMode) {
  const Vector exact = lowestModes(frame.whole().model, 6).values;
  Vector before = Vector::Constant(6, 1e300);
  for (int modes : {2, 3, 4, 6}) {
    const Vector found =
        lowestModes(
            synthesis(frame.parts(), 8,
                      interfaceModes(GetParam(), GetParam() == Level::System ? 3 * modes : modes))
                .coupled.model,
            6)
            .values;
    for (int i = 0; i < 6; ++i) {
      EXPECT_GE(found[i], exact[i] * (1 - 1e-9)) << modes << " modes";
      EXPECT_LE(found[i], before[i] * (1 + 1e-9)) << modes << " modes";
    }
    before = found;
  }
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(before[i] / exact[i], 1.0, 2e-3) << "mode " << i + 1;
}

TEST_P(InterfaceReduction, StaticAnswersToLoadsAreExactWithoutAnyMode) {
  const auto parts = loaded(frame.parts());
  const auto whole = loaded({frame.whole()}).front();
  const auto coupled = synthesis(parts, 0, interfaceModes(GetParam(), 0)).coupled;
  EXPECT_EQ(coupled.interfaceModes, GetParam() == Level::System ? 1 : 3)
      << "one load, of one name, on three interfaces";
  const Vector exact = recovered(whole.model, staticAnswer(whole.model));
  const Vector found = recovered(coupled.model, staticAnswer(coupled.model));
  // Craig-Bampton without modes is exact at joined nodes: 3, 4 and 5, the first three free nodes.
  for (int node : {0, 1, 2})
    EXPECT_LE((found.segment(6 * node, 6) - exact.segment(6 * node, 6)).norm(),
              1e-9 * exact.segment(6 * node, 6).norm())
        << "node " << node + 3;
  const auto without =
      synthesis(parts, 0, interfaceModes(GetParam(), GetParam() == Level::System ? 6 : 2, false))
          .coupled;
  const Vector rough = recovered(without.model, staticAnswer(without.model));
  EXPECT_GT((rough.head(18) - exact.head(18)).norm(), 1e-4 * exact.head(18).norm());
}

TEST_P(InterfaceReduction, ACutOffFrequencyKeepsTheModesBelowIt) {
  const auto guyan = synthesis(frame.parts(), 0, nullptr).coupled;
  const Vector all = lowestModes(guyan.model, 18).values;
  const double hz = std::sqrt(0.5 * (all[6] + all[7])) / 6.283185307179586;
  const auto kept = synthesis(frame.parts(), 0, interfaceModes(GetParam(), -1, true, true, hz))
                        .coupled.interfaceModes;
  if (GetParam() == Level::System)
    EXPECT_EQ(kept, 7);
  else
    EXPECT_LT(kept, 7) << "an interface whose neighbours are held is stiffer";
}

TEST_P(InterfaceReduction, DofsWithPointLawsStay) {
  auto parts = frame.parts();
  samples::addCubicSprings(parts[3], {5});
  const auto kept = synthesis(parts, 3, interfaceModes(GetParam(), 1)).coupled;
  EXPECT_GE(samples::find(kept.model, DofLabel::physical(5, 0)), 0);
  EXPECT_GE(samples::find(kept.model, DofLabel::physical(5, 1)), 0);
  EXPECT_LT(samples::find(kept.model, DofLabel::physical(5, 2)), 0);
  EXPECT_LT(samples::find(kept.model, DofLabel::physical(3, 0)), 0);
  const auto rows = kept.model.points.front().rows;
  EXPECT_EQ(rows.nonZeros(), 2) << "each coordinate of the law is one dof";
  const auto all = synthesis(parts, 3, interfaceModes(GetParam(), 1, true, false)).coupled;
  EXPECT_LT(samples::find(all.model, DofLabel::physical(5, 0)), 0);
}

TEST_P(InterfaceReduction, APointLawOnAnInnerDofKeepsNoJoinedOne) {
  auto parts = frame.parts();
  samples::addCubicSprings(parts[3], {403});
  const auto coupled = synthesis(parts, 3, interfaceModes(GetParam(), 2)).coupled;
  EXPECT_EQ(coupled.interfaceModes, GetParam() == Level::System ? 2 : 6);
  for (int node : {3, 4, 5})
    EXPECT_LT(samples::find(coupled.model, DofLabel::physical(node, 0)), 0) << node;
}

TEST_P(InterfaceReduction, ForcesOnDofsThatStayAreAnsweredExactly) {
  // A force on boundary dofs deflects reduced ones through the attached shapes; without any mode of
  // the interfaces.
  auto parts = frame.parts();
  samples::addCubicSprings(parts[3], {5});
  const auto coupled = synthesis(parts, 0, interfaceModes(Level::System, 0)).coupled;
  const auto guyan = synthesis(parts, 0, nullptr).coupled;
  const auto push = [](const model::SecondOrderModel& m) {
    Vector force = Vector::Zero(m.size());
    force[samples::find(m, DofLabel::physical(5, 0))] = 1e3;
    force[samples::find(m, DofLabel::physical(5, 1))] = -2e3;
    return recovered(m, linalg::DirectSolver(m.stiffnessAt(0)).solve(force));
  };
  const Vector exact = push(guyan.model);
  EXPECT_LE((push(coupled.model) - exact).norm(), 1e-10 * exact.norm());
}

TEST_P(InterfaceReduction, MapsAndRecoveryAgree) {
  const auto result = synthesis(frame.parts(), 4, interfaceModes(GetParam(), 3));
  const auto& coupled = result.coupled;
  EXPECT_FALSE(coupled.boolean());
  Vector z(coupled.model.size());
  for (int i = 0; i < z.size(); ++i) z[i] = std::sin(1.0 + i);
  const Vector all = coupled.model.recovery * z;
  for (std::size_t p = 0; p < result.parts.size(); ++p) {
    const Vector D = result.parts[p].basis->vectors * coupled.local(static_cast<int>(p), z);
    const auto part = frame.parts()[p];
    for (std::size_t i = 0; i < part.model.dofs.size(); ++i) {
      const auto& label = part.model.dofs[i];
      const auto at = std::find(coupled.model.recoveryNodes.begin(),
                                coupled.model.recoveryNodes.end(), label.entity) -
                      coupled.model.recoveryNodes.begin();
      EXPECT_NEAR(all[6 * at + label.component], D[static_cast<Eigen::Index>(i)],
                  1e-12 * all.norm());
    }
  }
}

TEST_P(InterfaceReduction, AMotionInTheSpanOfTheModesStartsWhereItWas) {
  const auto guyan = synthesis(frame.parts(), 0, nullptr).coupled;
  const Vector shape = lowestModes(guyan.model, 1).vectors.col(0);
  Coupling coupled = guyan;
  coupled.model.initialVelocity = 3.0 * shape;
  const Vector before = recovered(coupled.model, coupled.model.initialVelocity);
  reduceInterfaces(coupled, *interfaceModes(GetParam(), GetParam() == Level::System ? 1 : 6));
  EXPECT_LE((recovered(coupled.model, coupled.model.initialVelocity) - before).norm(),
            1e-9 * before.norm());
}

INSTANTIATE_TEST_SUITE_P(Levels, InterfaceReduction, testing::Values(Level::System, Level::Local),
                         [](const auto& tested) {
                           return tested.param == Level::System ? "System" : "Local";
                         });

TEST(SystemInterfaceModes, AreTheModesOfTheStaticallyCondensedWhole) {
  const samples::FiveMembers frame{6};
  const auto whole = frame.whole().model;
  // Dense: T = [1; -K_ii^-1 K_ib], with b all dofs of nodes 3, 4, 5.
  std::vector<int> b, i;
  for (int k = 0; k < whole.size(); ++k)
    (whole.dofs[static_cast<std::size_t>(k)].entity <= 5 ? b : i).push_back(k);
  const Matrix K = whole.stiffnessAt(0), M = whole.mass;
  Matrix T = Matrix::Zero(whole.size(), 18);
  T(b, Eigen::all) = Matrix::Identity(18, 18);
  T(i, Eigen::all) = -linalg::solveSymmetric(Matrix(K(i, i)), Matrix(K(i, b)));
  const auto condensed = linalg::symmetricPairs(T.transpose() * K * T, T.transpose() * M * T);
  const auto coupled = synthesis(frame.parts(), 0, interfaceModes(Level::System, 7)).coupled;
  ASSERT_EQ(coupled.model.size(), 7);
  const Vector found = lowestModes(coupled.model, 7).values;
  for (int k = 0; k < 7; ++k)
    EXPECT_NEAR(found[k] / condensed.values[k], 1.0, 1e-9) << "mode " << k + 1;
}

TEST(LocalInterfaceModes, KeepAChainNarrow) {
  // Ten bars in a row: nine joined dofs, each coupled to its neighbours only.
  std::vector<model::Substructure> parts;
  for (int p = 0; p < 10; ++p) {
    parts.push_back(samples::bar("bar " + std::to_string(p), 1 + 4 * p, 4, 3.0, 2.0,
                                 p == 0 ? std::vector<int>{1} : std::vector<int>{}));
    std::vector<int> ends;
    if (p > 0) ends.push_back(1 + 4 * p);
    if (p < 9) ends.push_back(5 + 4 * p);
    samples::classify(parts.back(), ends);
  }
  const auto local = synthesis(parts, 2, interfaceModes(Level::Local, 1)).coupled;
  const auto system = synthesis(parts, 2, interfaceModes(Level::System, 9)).coupled;
  EXPECT_EQ(local.interfaceModes, 9);
  EXPECT_EQ(system.interfaceModes, 9);
  EXPECT_LE(halfBandwidth(local.model), 5);
  EXPECT_LT(local.model.stiffness.front().matrix.nonZeros(), system.model.mass.nonZeros());
}

/// A quarter of a net of 13 x 13 nodes on soft springs: nodes (i, j) from (i0, j0) on, each with
/// the mass 1; neighbours are joined by springs of stiffness 1.
model::Substructure quarter(int i0, int j0) {
  constexpr int nodes = 7, whole = 13;
  model::Substructure part;
  part.name = "quarter " + std::to_string(i0) + " " + std::to_string(j0);
  part.model.componentNames = {"w"};
  Triplets stiffness, mass;
  const auto spring = [&](int a, int b) {
    samples::add(stiffness, (Matrix(2, 2) << 1, -1, -1, 1).finished(), {a, b});
  };
  std::vector<int> inner;
  for (int i = 0; i < nodes; ++i)
    for (int j = 0; j < nodes; ++j) {
      const int row = nodes * i + j, number = whole * (i0 + i) + j0 + j + 1;
      part.model.dofs.push_back(DofLabel::physical(number, 0));
      mass.emplace_back(row, row, 1.0);
      stiffness.emplace_back(row, row, 1e-3);
      if (i > 0) spring(row, row - nodes);
      if (j > 0) spring(row, row - 1);
      if (i0 + i == nodes - 1 || j0 + j == nodes - 1) inner.push_back(number);
    }
  part.model.mass = samples::square(nodes * nodes, mass);
  part.model.stiffness.push_back({"elastic", samples::square(nodes * nodes, stiffness), 0});
  samples::complete(part);
  samples::classify(part, inner);
  return part;
}

std::vector<model::Substructure> netOfFour() {
  return {quarter(0, 0), quarter(0, 6), quarter(6, 0), quarter(6, 6)};
}

/// Four edges of six nodes meet at a corner that joins all parts. The lowest mode is uniform, with
/// omega^2 = 1e-3: edges that stay where they are while the corner moves cannot hold it. Of smooth
/// shapes along six nodes the upper half of the modes has less than 1 %.
TEST(LocalInterfaceModes, TakeTheEdgesOfACornerAlong) {
  const Vector exact = lowestModes(synthesis(netOfFour(), -1, nullptr).coupled.model, 6).values;
  EXPECT_NEAR(exact[0], 1e-3, 1e-9);
  const auto coupled = synthesis(netOfFour(), 8, interfaceModes(Level::Local, 3)).coupled;
  EXPECT_EQ(coupled.joinedDofs, 25);
  EXPECT_EQ(coupled.interfaceModes, 4 * 3 + 1);
  const Vector found = lowestModes(coupled.model, 6).values;
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(found[i] / exact[i], 1.0, 0.01) << "mode " << i + 1;
}

/// The static response to a load has shares of edges and corner, which add up to it.
TEST(LocalInterfaceModes, AnswerLoadsAtACornerExactly) {
  auto parts = netOfFour();
  parts[2].model.loads.push_back({"push", Vector::LinSpaced(49, 0.0, 1.0), 0});
  const auto plain = synthesis(parts, 0, nullptr).coupled.model,
             reduced = synthesis(parts, 0, interfaceModes(Level::Local, 0)).coupled.model;
  ASSERT_LT(reduced.size(), plain.size());
  const Vector exact = recovered(plain, staticAnswer(plain));
  EXPECT_LT((recovered(reduced, staticAnswer(reduced)) - exact).norm(), 1e-9 * exact.norm());
}

TEST(SystemInterfaceModes, OfAFloatingFrameHoldItsSixRigidMotions) {
  samples::FiveMembers frame{4};
  frame.feet.clear();
  const auto parts =
      frame.parts();  // clamped feet are released; they are inner nodes of the columns now
  const auto coupled = synthesis(parts, 3, interfaceModes(Level::System, 8)).coupled;
  const Vector found = lowestModes(coupled.model, 8).values;
  for (int k = 0; k < 6; ++k) EXPECT_LT(std::abs(found[k]), 1e-7 * found[7]) << "mode " << k + 1;
  EXPECT_GT(found[6], 1e-3 * found[7]);
}

TEST(InterfaceReductionErrors, DualAssemblyHasNoJoinedDofs) {
  const samples::FiveMembers frame{4};
  CouplingOptions dual;
  dual.assembly = Assembly::Dual;
  const auto sentence =
      errorText([&] { synthesis(frame.parts(), 2, interfaceModes(Level::System, 3), dual); });
  EXPECT_NE(sentence.find("Set Coupling/Assembly to \"Primal\""), std::string::npos) << sentence;
}

TEST(InterfaceReductionErrors, PartsThatAreNotJoinedHaveNothingToReduce) {
  const auto part = samples::bar("alone", 1, 4, 3.0, 2.0, {1});
  auto coupled = coupleWithPositions(std::vector<model::Substructure>{part});
  reduceInterfaces(coupled, *interfaceModes(Level::System, 3));
  EXPECT_EQ(coupled.interfaceModes, 0);
  EXPECT_EQ(coupled.model.size(), 4);
}

TEST(InterfaceReductionDeck, ReadsOneCriterion) {
  const auto sentence = [](const std::function<void(Teuchos::ParameterList&)>& change) {
    auto list = test::defaultsOf(reduction::parameters());
    list.sublist("Mode Selection").set("Modes", 3);
    list.set("Interface Reduction", "System");
    change(list.sublist("System"));
    return errorText([&] { reduction::readOptions(list, 2); });
  };
  EXPECT_EQ(sentence([](auto& own) { own.set("Modes", 4); }), "");
  EXPECT_NE(
      sentence([](auto&) {}).find("Reduction/System does not give the number of interface modes"),
      std::string::npos);
  EXPECT_NE(sentence([](auto& own) {
              own.set("Modes", 4).set("Cut-off Frequency", 10.0);
            }).find("gives both"),
            std::string::npos);
}

}  // namespace InterfaceReductionTest
