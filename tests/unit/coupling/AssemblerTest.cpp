// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The generic assembler: labels, laws, loads, points, recovery, states, and the messages for parts
/// that do not fit.
#include "coupling/assembly/Assembler.hpp"

#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <gtest/gtest.h>

#include "common/Error.hpp"
#include "linalg/DenseDecompositions.hpp"
#include "reduction/Reduce.hpp"
#include "tests/support/SampleParts.hpp"

namespace AssemblerTest {

using namespace tooljoint;
using namespace tooljoint::coupling;
using model::DofLabel;
using model::Substructure;

std::string refusal(const std::vector<Substructure>& parts) {
  try {
    couple(parts);
  } catch (const ModelError& error) {
    return error.what();
  }
  return "accepted";
}

/// A bar of 6 elements in two parts of 3.
std::vector<Substructure> twoBars() {
  std::vector<Substructure> parts{samples::bar("top", 1, 3, 3.0, 2.0),
                                  samples::bar("bottom", 4, 3, 3.0, 2.0)};
  samples::classify(parts[0], {4});
  samples::classify(parts[1], {4});
  return parts;
}

std::vector<reduction::ReducedSubstructure> reduced(
    const std::vector<Substructure>& parts, int modes,
    reduction::InitialState state = reduction::InitialState::KeepStatic) {
  reduction::ReductionOptions options;
  options.modes.kind = reduction::ModeRule::Kind::PerPart;
  options.modes.counts = {modes};
  options.initialState = state;
  return reduction::reduceAll(
      parts, *reduction::makeBasis("Craig-Bampton", Teuchos::ParameterList()), options);
}

TEST(Assembler, PutsAChainTogetherAgain) {
  const auto whole = samples::bar("whole", 1, 6, 3.0, 2.0);
  const auto coupled = couple(twoBars());
  ASSERT_EQ(coupled.size(), 7);
  EXPECT_TRUE(coupled.dofs == whole.model.dofs) << "numbered from the lower end";
  EXPECT_LT((Matrix(coupled.mass) - Matrix(whole.model.mass)).norm(), 1e-15);
  EXPECT_LT((Matrix(coupled.stiffnessAt(0)) - Matrix(whole.model.stiffnessAt(0))).norm(), 1e-15);
  EXPECT_EQ(halfBandwidth(coupled), 1);
}

TEST(Assembler, OrderOfPartsAndDofsDoesNotMatter) {
  auto parts = twoBars();
  std::reverse(parts.begin(), parts.end());
  const auto coupled = couple(parts);
  EXPECT_TRUE(coupled.dofs == couple(twoBars()).dofs);
  EXPECT_LT((Matrix(coupled.mass) - Matrix(couple(twoBars()).mass)).norm(), 1e-15);
}

TEST(Assembler, CouplesALoopAndABranch) {
  const auto parts = samples::loopFrame(4, true);
  const Coupling coupling = coupleWithPositions(parts);
  // The same frame as one part.
  samples::Frame frame;
  frame.corners = {{1, {0, 0}}, {2, {3, 0}}, {3, {3, 2.5}}, {4, {0, 2}}, {5, {5, 2.6}}};
  frame.clamped = {1, 2};
  const auto whole = samples::framePart("whole", frame,
                                        {{1, 4, {101, 102, 103}},
                                         {2, 3, {201, 202, 203}},
                                         {4, 3, {301, 302, 303}},
                                         {3, 5, {401, 402, 403}}},
                                        true);
  ASSERT_EQ(coupling.model.size(), whole.model.size());
  std::vector<int> order;
  for (const auto& label : coupling.model.dofs) order.push_back(samples::find(whole.model, label));
  const auto permuted = [&](const Sparse& A) { return Matrix(reduction::block(A, order, order)); };
  EXPECT_LT((Matrix(coupling.model.mass) - permuted(whole.model.mass)).norm(), 1e-13);
  EXPECT_LT(
      (Matrix(coupling.model.stiffnessAt(0.7)) - permuted(whole.model.stiffnessAt(0.7))).norm(),
      1e-6);
  EXPECT_LT((Matrix(coupling.model.dampingAt(0.7)) - permuted(whole.model.dampingAt(0.7))).norm(),
            1e-9);
  for (std::size_t p = 0; p < parts.size(); ++p)
    for (int i = 0; i < parts[p].model.size(); ++i)
      EXPECT_TRUE(
          coupling.model
              .dofs[static_cast<std::size_t>(coupling.positions[p][static_cast<std::size_t>(i)])] ==
          parts[p].model.dofs[static_cast<std::size_t>(i)]);
}

TEST(Assembler, PartsMayShareTwoInterfacesAndAnyDofOrder) {
  // A ring of two half bars, the second numbered backwards.
  auto first = samples::bar("first", 1, 4, 3.0, 2.0);
  samples::classify(first, {1, 5});
  auto second = samples::bar("second", 1, 4, 5.0, 1.0);
  for (int i = 0; i < 5; ++i)
    second.model.dofs[static_cast<std::size_t>(i)] = DofLabel::physical(i == 0   ? 5
                                                                        : i == 4 ? 1
                                                                                 : 20 + i,
                                                                        0);
  second.model.recoveryNodes = {5, 21, 22, 23, 1};
  samples::classify(second, {1, 5});
  const auto coupled = couple({first, second});
  EXPECT_EQ(coupled.size(), 8);
  EXPECT_LT((Matrix(coupled.stiffnessAt(0)) * Vector::Ones(8)).norm(), 1e-14)
      << "the ring turns freely";
  EXPECT_NEAR(coupled.mass.sum(), 12.0, 1e-13);
  EXPECT_LE(halfBandwidth(coupled), 2) << "a ring folded flat";
}

TEST(Assembler, ChainOfReducedPartsIsNarrow) {
  std::vector<Substructure> parts;
  for (int p = 0; p < 10; ++p) {
    parts.push_back(samples::bar("part " + std::to_string(p + 1), 1 + 6 * p, 6, 3.0 + p, 2.0));
    std::vector<int> ends;
    if (p > 0) ends.push_back(1 + 6 * p);
    if (p < 9) ends.push_back(7 + 6 * p);
    samples::classify(parts.back(), ends, {4 + 6 * p});
  }
  std::reverse(parts.begin(), parts.begin() + 5);  // any order
  const auto coupled = couple(reduced(parts, 4));
  EXPECT_EQ(coupled.size(), 9 + 10 + 40 + 0);
  EXPECT_LE(halfBandwidth(coupled), 5);
}

TEST(Assembler, RenumbersModesByPart) {
  const auto parts = samples::loopFrame(4, false);
  const auto coupled = couple(reduced(parts, 2));
  for (int p = 0; p < 4; ++p)
    for (int k = 0; k < 2; ++k) EXPECT_GE(samples::find(coupled, DofLabel::modal(p, k)), 0);
  EXPECT_EQ(coupled.size(), 6 + 8);
}

TEST(Assembler, MergesLawsAndTermsByName) {
  const auto parts = samples::loopFrame(4, true);
  const auto coupled = couple(parts);
  EXPECT_EQ(coupled.laws.size(), 3u);
  EXPECT_EQ(coupled.laws.front().name, "1");
  EXPECT_EQ(coupled.damping.size(), 2u);
  EXPECT_EQ(coupled.stiffness.size(), 3u);
  // A part with the laws in another order gives the same model.
  auto other = parts;
  auto& m = other[3].model;
  m.laws = {model::ScalarLaw::one(), samples::spinRate(), samples::spin()};
  for (auto* terms : {&m.damping, &m.stiffness})
    for (auto& term : terms->own()) term.law = term.law == 0 ? 0 : 3 - term.law;
  EXPECT_EQ(couple(other).damping.size(), 2u);
  EXPECT_LT((Matrix(couple(other).dampingAt(0.3)) - Matrix(coupled.dampingAt(0.3))).norm(), 1e-15);
}

TEST(Assembler, AddsLoadsOfOneNameAndLaw) {
  auto parts = twoBars();
  const int spin = parts[0].model.lawIndex(samples::spin());
  parts[0].model.loads = {{"weight", Vector::Ones(4), 0}, {"drive", Vector::Ones(4), spin}};
  parts[1].model.loads = {{"weight", 2 * Vector::Ones(4), 0}};
  const auto coupled = couple(parts);
  ASSERT_EQ(coupled.loads.size(), 2u);
  EXPECT_EQ(coupled.loads[0].vector, (Vector(7) << 1, 1, 1, 3, 2, 2, 2).finished());
  EXPECT_EQ(coupled.laws[static_cast<std::size_t>(coupled.loads[1].law)].name, "Omega");
}

TEST(Assembler, KeepsThePointSetsOfEveryPart) {
  auto parts = samples::loopFrame(4, false);
  samples::addCubicSprings(parts[0], {4, 102});
  samples::addCubicSprings(parts[3], {5});
  const auto coupled = couple(parts);
  ASSERT_EQ(coupled.points.size(), 2u);
  EXPECT_EQ(coupled.points[0].law, parts[0].model.points[0].law);
  EXPECT_EQ(coupled.points[0].entities, (std::vector<std::int64_t>{4, 102}));
  const Vector q = Vector::LinSpaced(coupled.size(), 1, 2);
  const Vector d = coupled.points[0].rows * q;
  EXPECT_EQ(d[0], q[samples::find(coupled, DofLabel::physical(4, 0))]);
  EXPECT_EQ(d[3], q[samples::find(coupled, DofLabel::physical(102, 1))]);
}

TEST(Assembler, RecoversEveryNodeOnce) {
  auto parts = samples::loopFrame(4, false);
  const auto coupled = couple(reduced(parts, 3));
  EXPECT_EQ(coupled.recoveryNodes.size(), 3u + 12u)
      << "nodes 3, 4, 5 and three inside each member; clamped ones have no dofs";
  EXPECT_TRUE(std::is_sorted(coupled.recoveryNodes.begin(), coupled.recoveryNodes.end()));
  EXPECT_EQ(coupled.recovery.rows(), 45);
  const int row = 3 * static_cast<int>(
                          std::find(coupled.recoveryNodes.begin(), coupled.recoveryNodes.end(), 3) -
                          coupled.recoveryNodes.begin());
  EXPECT_EQ(coupled.recovery.coeff(row, samples::find(coupled, DofLabel::physical(3, 0))), 1.0);
}

TEST(Assembler, SharedStatesMustAgree) {
  auto parts = twoBars();
  parts[0].model.initialDisplacement << 0, 1, 2, 3;
  parts[1].model.initialDisplacement << 3, 2, 1, 0;
  EXPECT_EQ(couple(parts).initialDisplacement, (Vector(7) << 0, 1, 2, 3, 2, 1, 0).finished());
  parts[1].model.initialDisplacement[0] = 3.5;
  EXPECT_EQ(refusal(parts),
            "The initial displacement of u of node 4 is 3 in part \"top\" and 3.5 in part "
            "\"bottom\". Joined parts must start from the same state.");
  parts[1].model.initialDisplacement[0] = 3;
  parts[1].model.initialVelocity[0] = 1;
  EXPECT_NE(refusal(parts).find("The initial velocity of u of node 4"), std::string::npos);
}

TEST(Assembler, ReferencesMustAgree) {
  auto parts = twoBars();
  for (auto& part : parts) part.reference = Vector::Constant(4, 0.25);
  for (auto& part : parts) part.model.initialDisplacement = part.reference;
  EXPECT_NO_THROW(couple(reduced(parts, 1)));
  auto mixed = reduced(parts, 1);
  mixed[1] = reduced(parts, 1, reduction::InitialState::LeastSquares)[1];
  try {
    couple(mixed);
    FAIL();
  } catch (const ModelError& error) {
    EXPECT_STREQ(error.what(),
                 "The reference state of u of node 4 is 0.25 in part \"top\" and 0 in part "
                 "\"bottom\". Joined parts must be reduced about the same state.");
  }
}

TEST(AssemblerErrors, NothingToCouple) {
  EXPECT_EQ(refusal({}), "The model has no part to couple.");
}

TEST(AssemblerErrors, LabelThatJoinsNothing) {
  auto parts = twoBars();
  samples::classify(parts[0], {1, 4});
  EXPECT_EQ(refusal(parts),
            "The interface dof u of node 1 of part \"top\" is not joined: no other part has it. "
            "Check the labels, or remove it from the interface.");
}

TEST(AssemblerErrors, InnerDofOfAnotherPart) {
  auto parts = twoBars();
  samples::classify(parts[1], {});
  EXPECT_EQ(
      refusal(parts),
      "u of node 4 is an interface dof of part \"top\" but an interior dof of part \"bottom\". "
      "Declare it an interface dof of "
      "both parts.");
  samples::classify(parts[0], {});
  EXPECT_EQ(refusal(parts),
            "Parts \"top\" and \"bottom\" both have u of node 4, but as an interior dof, which "
            "cannot be joined. Declare it an interface dof of both parts, or let parts that only "
            "use the same numbers count their own nodes (Coupling/Node Numbers \"Own\").");
}

TEST(AssemblerErrors, LabelTwiceInAPart) {
  auto parts = twoBars();
  parts[0].model.dofs[1] = parts[0].model.dofs[0];
  EXPECT_EQ(refusal(parts),
            "Part \"top\" has u of node 1 twice. Give every dof of a part its own label.");
}

TEST(AssemblerErrors, OtherComponents) {
  auto parts = twoBars();
  parts[1].model.componentNames = {"w"};
  EXPECT_EQ(refusal(parts),
            "Parts \"top\" and \"bottom\" have different node components: \"u\" in the first and "
            "\"w\" in the second.");
}

TEST(AssemblerErrors, RecoveryThatDisagrees) {
  auto parts = twoBars();
  parts[1].model.recovery.coeffRef(0, 0) = 2.0;
  EXPECT_NE(refusal(parts).find("The motion of u of node 4 is recovered differently by part "
                                "\"top\" and part \"bottom\"."),
            std::string::npos)
      << refusal(parts);
  parts = twoBars();
  parts[1].model.recoveryNodes.own().pop_back();
  EXPECT_EQ(
      refusal(parts),
      "Part \"bottom\": its recovery rows do not match its 3 output nodes with 1 components each.");
}

/// Two clamped bars whose ends are joined with a misfit, u_4 - u_5 = g: each end moves by g/2, and
/// the bars pull at one another with N = (k/3) g/2, in both assemblies.
TEST(Assembler, JoinsEndsThatDoNotFit) {
  std::vector<Substructure> parts{samples::bar("top", 1, 3, 30.0, 2.0, {1}),
                                  samples::bar("bottom", 5, 3, 30.0, 2.0, {8})};
  samples::classify(parts[0], {4});
  samples::classify(parts[1], {5});
  const double misfit = 0.02, force = 10.0 * misfit / 2.0;
  parts[0].model.initialDisplacement[samples::find(parts[0].model, DofLabel::physical(4, 0))] =
      misfit;
  for (const Assembly assembly : {Assembly::Primal, Assembly::Dual}) {
    CouplingOptions options;
    options.assembly = assembly;
    options.connections.constraints.push_back(
        {"misfit", {{{"top", 4, "u"}, 1.0}, {{"bottom", 5, "u"}, -1.0}}, misfit, false});
    const auto coupled = coupleWithPositions(parts, options);
    const Vector z =
        linalg::DenseLu(Matrix(coupled.model.stiffnessAt(0.0))).solve(coupled.model.loadAt(0.0));
    const Vector top = coupled.maps[0] * z + coupled.offsets[0],
                 bottom = coupled.maps[1] * z + coupled.offsets[1];
    const auto end = [](const Substructure& part, const Vector& d, int node) {
      return d[samples::find(part.model, DofLabel::physical(node, 0))];
    };
    EXPECT_NEAR(end(parts[0], top, 4), misfit / 2.0, 1e-12);
    EXPECT_NEAR(end(parts[1], bottom, 5), -misfit / 2.0, 1e-12);
    if (assembly == Assembly::Primal) continue;
    ASSERT_EQ(coupled.multipliers.size(), 1u);
    const auto& multiplier = coupled.multipliers.front();
    EXPECT_NEAR(multiplier.force(z), multiplier.part == "top" ? force : -force, 1e-12);
  }
}

}  // namespace AssemblerTest
