// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The static residual (K_pa + K_gpo(D)) D - F_s - F_cs(D) - R_ipa (Nguyen et al. 2020, equation
/// 19) of a straight string, term by term, and the description of a state.
#include "substructures/equilibrium/StaticProblem.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "substructures/beam/Timoshenko.hpp"
#include "substructures/contact/ContactLaw.hpp"
#include "substructures/equilibrium/Equilibrium.hpp"
#include "tests/support/JacobianDifference.hpp"

namespace tooljoint::equilibrium {
namespace StaticProblemTest {

constexpr int nodes = 4;
const std::vector<double> lengths{2.0, 3.0, 1.5};

beam::Section section(std::size_t e) {
  return beam::Section::hollow(0.06 + 0.01 * static_cast<double>(e), 0.04, {7900.0, 2.0e8, 0.3});
}

contact::ContactPoint wall(int node) {
  contact::ContactPoint p;
  p.node = node;
  p.clearance = 0.02;
  p.contactRadius = 0.07;
  p.stiffness = 1e5;
  p.lambdaK = p.lambdaC = 2e3;
  p.muStatic = 0.3;
  p.muDynamic = 0.2;
  return p;
}

/// Three elements in one line, nodal axes those of the elements; nodes 2 and 3 can touch, node 1 is
/// held.
struct Case {
  StaticInput input;
  Vector displacement = Vector::Zero(6 * nodes);

  explicit Case(bool contact = true) {
    input.nodes = nodes;
    for (std::size_t e = 0; e < lengths.size(); ++e) {
      StaticElement element;
      element.formulation = std::make_shared<beam::Timoshenko>(section(e), lengths[e]);
      element.stiffness = element.formulation->stiffness();
      element.rotation.setIdentity();
      element.slopes.setIdentity();
      input.elements.push_back(element);
    }
    input.held.assign(6 * nodes, 0);
    for (std::size_t i = 0; i < 6; ++i) input.held[i] = 1;
    input.load = Vector::LinSpaced(6 * nodes, 10.0, 33.0);
    input.pathReaction = Vector::LinSpaced(6 * nodes, -4.0, 7.0);
    if (contact) {
      contact::ContactPoints points;
      points.add(wall(2));
      points.add(wall(3));
      input.contact = contact::makeLaw("Nguyen")->atRest(points);
    }
    for (int i = 6; i < 6 * nodes; ++i) displacement(i) = 1e-3 * std::sin(1.7 * i);
    displacement.segment<2>(6) << 0.015, 0.017;    // pressed into the wall
    displacement.segment<2>(12) << -0.004, 0.003;  // open
  }
};

double stretch(const Case& scene, int element, int component) {
  const double l = lengths[static_cast<std::size_t>(element)];
  return (scene.displacement(6 * (element + 1) + component) -
          scene.displacement(6 * element + component)) /
         l;
}

TEST(StaticProblem, LinearisesInOnePassAsInTwo) {
  for (const bool exact : {true, false}) {
    const Case scene;
    StaticProblem problem(scene.input);
    auto switches = problem.switches();
    switches.exactJacobian = exact;
    problem.set(switches);
    const Vector x = problem.restrict(scene.displacement);
    Vector r, alone;
    Sparse tangent, tangentAlone;
    problem.linearise(x, r, tangent);
    problem.residual(x, alone);
    problem.jacobian(x, tangentAlone);
    EXPECT_LE((r - alone).norm(), 1e-14 * alone.norm());
    EXPECT_LE((tangent - tangentAlone).norm(), 1e-14 * tangentAlone.norm());
  }
}

TEST(StaticProblem, AxialForceAndTorqueFollowTheStretchAndTheTwist) {
  const Case scene;
  const StaticProblem problem(scene.input);
  for (int e = 0; e < 3; ++e) {
    const auto s = section(static_cast<std::size_t>(e));
    EXPECT_NEAR(problem.elements().axialForce(e, scene.displacement),
                s.axialRigidity() * stretch(scene, e, 2), 1e-9 * s.axialRigidity());
    EXPECT_NEAR(problem.elements().torque(e, scene.displacement),
                s.torsionalRigidity() * stretch(scene, e, 5), 1e-9 * s.torsionalRigidity());
  }
}

TEST(StaticProblem, GeometricStiffnessIsThatOfForceAndTorque) {
  const Case scene;
  const StaticProblem problem(scene.input);
  for (int e = 0; e < 3; ++e) {
    const auto s = section(static_cast<std::size_t>(e));
    const double l = lengths[static_cast<std::size_t>(e)];
    const beam::Matrix12 expected =
        s.axialRigidity() * stretch(scene, e, 2) * beam::geometricAxial(l) +
        s.torsionalRigidity() * stretch(scene, e, 5) * beam::geometricTorque(l);
    EXPECT_LT((problem.geometricStiffness(e, scene.displacement) - expected).norm(),
              1e-12 * expected.norm());
    EXPECT_GT(expected.norm(), 1.0);
  }
}

/// All terms by hand; each switch removes its own term.
TEST(StaticProblem, ResidualIsStiffnessLessLoadsContactAndPathReaction) {
  const Case scene;
  StaticProblem problem(scene.input);
  const Vector x = problem.restrict(scene.displacement);
  ASSERT_EQ(problem.expand(x), scene.displacement);
  Vector elastic = Vector::Zero(6 * nodes), geometric = elastic, contact = elastic;
  for (int e = 0; e < 3; ++e) {
    const beam::Vector12 d = scene.displacement.segment<12>(6 * e);
    elastic.segment<12>(6 * e) += scene.input.elements[static_cast<std::size_t>(e)].stiffness * d;
    geometric.segment<12>(6 * e) += problem.geometricStiffness(e, scene.displacement) * d;
  }
  const double uv[4] = {0.015, 0.017, -0.004, 0.003};
  constexpr int n = contact::StaticContact::kForces;
  double f[2 * n];
  scene.input.contact->evaluate({}, uv, f);
  for (int p = 0; p < 2; ++p) {
    contact.segment<3>(6 * (p + 1)) += Eigen::Vector3d(f[n * p], f[n * p + 1], f[n * p + 2]);
    contact(6 * (p + 1) + 5) += f[n * p + 3];
  }
  const auto expectResidual = [&](const StaticSwitches& switches, const Vector& full) {
    problem.set(switches);
    Vector r;
    problem.residual(x, r);
    const Vector expected = problem.restrict(full);
    EXPECT_LT((r - expected).norm(), 1e-11 * expected.norm());
  };
  const Vector& load = scene.input.load;
  const Vector& reaction = scene.input.pathReaction;
  StaticSwitches switches;
  expectResidual(switches, elastic + geometric - load - contact - reaction);
  switches.geometricStiffness = false;
  expectResidual(switches, elastic - load - contact - reaction);
  switches.contact = false;
  expectResidual(switches, elastic - load - reaction);
  switches.pathReaction = false;
  expectResidual(switches, elastic - load);
  EXPECT_GT(geometric.norm(), 1.0);
  EXPECT_GT(contact.norm(), 1.0);
}

TEST(StaticProblem, JacobianIsTheDerivativeOfTheResidual) {
  const Case scene;
  StaticProblem problem(scene.input);
  EXPECT_LT(testing_::jacobianError(problem, problem.restrict(scene.displacement), 1e-7), 1e-5);
  StaticSwitches switches;
  switches.exactJacobian = false;
  problem.set(switches);
  EXPECT_GT(testing_::jacobianError(problem, problem.restrict(scene.displacement), 1e-7), 1e-3)
      << "without dK_gpo/dD it is another one";
}

/// The same for a string that also slides along the wall, with nodes of the tensioned string.
TEST(StaticProblem, JacobianIsTheDerivativeWithDragAndPretension) {
  Case scene;
  scene.input.sliding = {-0.2, 4.0};
  for (auto& element : scene.input.elements) element.pretension = 2e4;
  const StaticProblem problem(scene.input);
  EXPECT_LT(testing_::jacobianError(problem, problem.restrict(scene.displacement), 1e-7), 1e-5);
}

/// A pretension is a stretch that is not part of the displacement.
TEST(StaticProblem, PretensionIsAStretchThatTheNodesHaveAlready) {
  Case scene;
  Vector stretched = scene.displacement;
  double shift = 0.0;
  for (std::size_t e = 0; e < lengths.size(); ++e) {
    scene.input.elements[e].pretension = 500.0 * (1.0 + static_cast<double>(e));
    shift += scene.input.elements[e].pretension * lengths[e] / section(e).axialRigidity();
    stretched(static_cast<Eigen::Index>(6 * (e + 1) + 2)) += shift;
  }
  const StaticProblem from(scene.input);
  const Case unloaded;
  const StaticProblem whole(unloaded.input);
  const Vector expected = whole.unbalanced(stretched);
  EXPECT_LT((from.unbalanced(scene.displacement) - expected).norm(), 1e-10 * expected.norm());
  for (int e = 0; e < 3; ++e)
    EXPECT_NEAR(from.elements().axialForce(e, scene.displacement),
                whole.elements().axialForce(e, stretched), 1e-9 * section(0).axialRigidity());
}

/// Forces are scaled by the largest load, moments by that load times a mean element length.
TEST(StaticProblem, ResidualsAreScaledByTheLargestLoad) {
  Case scene;
  scene.input.pathReaction = Vector::Zero(6 * nodes);
  scene.input.load = Vector::Zero(6 * nodes);
  scene.input.load(14) = -800.0;
  const StaticProblem problem(scene.input);
  const Vector scale = problem.residualScale();
  const double mean = (2.0 + 3.0 + 1.5) / 3.0;
  EXPECT_NEAR(scale(0), 1.0 / 800.0, 1e-15);
  EXPECT_NEAR(scale(3), 1.0 / (800.0 * mean), 1e-15);
  EXPECT_EQ(problem.largestLoad(), 800.0);
}

/// Recorded forces are the acting ones: the friction force along t = (-v, u)/r and its torque, both
/// against the rotation.
TEST(StaticState, RecordsTheForcesThatAct) {
  Case scene;
  for (const double direction : {1.0, -1.0}) {
    scene.input.sliding = {0.0, direction};
    const StaticProblem problem(scene.input);
    const StaticState state = describe(scene.input, problem, scene.displacement);
    contact::StaticContact::Options options;
    options.sliding = {0.0, direction};
    const double uv[4] = {0.015, 0.017, -0.004, 0.003};
    double f[2 * contact::StaticContact::kForces], normal[2];
    scene.input.contact->evaluate(options, uv, f);
    scene.input.contact->normalForce(options, uv, normal);
    const double r = std::hypot(0.015, 0.017);
    EXPECT_NEAR(state.normalForce(1), normal[0], 1e-9 * normal[0]);
    EXPECT_NEAR(state.tangentialForce(1), (-f[0] * 0.017 + f[1] * 0.015) / r, 1e-9 * normal[0]);
    EXPECT_LT(direction * state.tangentialForce(1), -0.1 * normal[0]);
    EXPECT_NEAR(state.frictionTorque(1), f[3], 1e-9 * normal[0]);
    EXPECT_LT(direction * state.frictionTorque(1), -0.01 * normal[0]);
    EXPECT_NEAR(state.gap(1), r - 0.02, 1e-12);
    EXPECT_LT(state.gap(2), 0.0);
    EXPECT_EQ(state.contactNodes, 1);
    EXPECT_EQ(state.maxNormalForceNode, 2);
    EXPECT_NEAR(state.maxNormalForce, normal[0], 1e-9 * normal[0]);
    EXPECT_NEAR(state.totalNormalForce, normal[0] + normal[1], 1e-9 * normal[0]);
    EXPECT_NEAR(state.totalFrictionTorque, f[3] + f[7], 1e-9 * normal[0]);
    EXPECT_EQ(state.normalForce(0), 0.0);
  }
}

TEST(StaticState, SumsUpItsElements) {
  const Case scene(false);
  const StaticProblem problem(scene.input);
  const StaticState state = describe(scene.input, problem, scene.displacement);
  int compressed = 0;
  for (int e = 0; e < 3; ++e) {
    EXPECT_EQ(state.axialForce(e), problem.elements().axialForce(e, scene.displacement));
    EXPECT_EQ(state.torque(e), problem.elements().torque(e, scene.displacement));
    compressed += problem.elements().axialForce(e, scene.displacement) < 0.0 ? 1 : 0;
    EXPECT_EQ(state.geometricStiffness[static_cast<std::size_t>(e)],
              problem.geometricStiffness(e, scene.displacement));
  }
  EXPECT_EQ(state.compressedElements, compressed);
  EXPECT_EQ(state.topAxialForce, state.axialForce(0));
  EXPECT_EQ(state.lastElementAxialForce, state.axialForce(2));
  EXPECT_EQ(state.lastElementTorque, state.torque(2));
  EXPECT_NEAR(state.appliedTorque,
              scene.input.load(11) + scene.input.load(17) + scene.input.load(23), 1e-12);
}

}  // namespace StaticProblemTest
}  // namespace tooljoint::equilibrium
