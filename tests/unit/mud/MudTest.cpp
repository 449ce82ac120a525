// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Mud: limits of every coefficient, effect of each deck parameter, work of the Coriolis forces,
/// the swirl.
#include <array>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <limits>

#include "ReferenceCollar.hpp"
#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "common/report/EvaluationCounters.hpp"
#include "common/report/Log.hpp"
#include "substructures/mud/AnnularFlow.hpp"
#include "tests/support/ListDefaults.hpp"

namespace tooljoint::mud {
namespace MudTest {

using constants::pi;
const double unbounded = std::numeric_limits<double>::infinity();

const MatrixTerm* find(const std::vector<MatrixTerm>& terms, const std::string& name) {
  for (const auto& term : terms)
    if (term.name == name) return &term;
  return nullptr;
}

double skewPart(const beam::Matrix12& m) { return (m - m.transpose()).norm() / m.norm(); }

// -------------------------------------------------------------------------------------------------
// coefficients

TEST(MudFlow, ReferenceNumbersByHand) {
  const SectionFlow f = AnnularFlow(referenceMud()).flow(innerRadius, outerRadius, boreRadius);
  EXPECT_NEAR(f.innerMass, 1200.0 * pi * 0.0355 * 0.0355, 1e-12);
  EXPECT_NEAR(f.confinement, (0.108 * 0.108 + 0.0795 * 0.0795) / (0.108 * 0.108 - 0.0795 * 0.0795),
              1e-12);
  EXPECT_NEAR(f.innerSpeed, 0.01 / (pi * 0.0355 * 0.0355), 1e-12);
  EXPECT_NEAR(f.annulusSpeed, 0.01 / (pi * (0.108 * 0.108 - 0.0795 * 0.0795)), 1e-12);
  EXPECT_NEAR(f.buoyantMass, 1200.0 * pi * (0.0355 * 0.0355 - 0.0795 * 0.0795), 1e-12);
  EXPECT_NEAR(f.axialFlowDamping, 0.013 * 1200.0 * 0.159 * f.annulusSpeed / 2.0, 1e-12);
  EXPECT_NEAR(f.axialDrag, -0.013 * 1200.0 * 0.159 * f.annulusSpeed * f.annulusSpeed / 2.0, 1e-12);
}

/// The added mass of the annulus against its definition: twice the kinetic energy of the potential
/// flow around a cylinder that moves with unit speed inside a fixed one, phi = (a r + b/r)
/// cos(theta), integrated numerically.
TEST(MudFlow, AddedMassIsTheKineticEnergyOfTheAnnularFlow) {
  const double re2 = outerRadius * outerRadius;
  const double rw2 = boreRadius * boreRadius;
  const double a = -re2 / (rw2 - re2);  // phi_r = cos(theta) at R_e, 0 at R_w
  const double b = a * rw2;
  const int rings = 20000;
  double energy = 0.0;
  for (int i = 0; i < rings; ++i) {
    const double r = outerRadius + (boreRadius - outerRadius) * (i + 0.5) / rings;
    const double radial = a - b / (r * r);      // times cos(theta)
    const double tangential = a + b / (r * r);  // times -sin(theta)
    energy += 0.5 * 1200.0 * pi * (radial * radial + tangential * tangential) * r *
              (boreRadius - outerRadius) / rings;
  }
  const SectionFlow f = AnnularFlow(referenceMud()).flow(innerRadius, outerRadius, boreRadius);
  EXPECT_NEAR(f.annulusMass, 2.0 * energy, 1e-7 * f.annulusMass);
}

TEST(MudFlow, WideBoreIsAnOpenFluid) {
  const SectionFlow f = AnnularFlow(referenceMud()).flow(innerRadius, outerRadius, unbounded);
  EXPECT_DOUBLE_EQ(f.confinement, 1.0);
  EXPECT_DOUBLE_EQ(f.annulusSpeed, 0.0);
  EXPECT_DOUBLE_EQ(f.axialFlowDamping, 0.0);
  EXPECT_DOUBLE_EQ(f.axialDrag, 0.0);
  EXPECT_NEAR(f.rotationDamping, 2.0 * std::sqrt(2.0) * pi * 1200.0 * outerRadius * 1e-3, 1e-9);
  // and the limit is approached: chi - 1 = 2 gamma^2 + ...
  const double gamma = 1e-3;
  EXPECT_NEAR(
      AnnularFlow(referenceMud()).flow(innerRadius, outerRadius, outerRadius / gamma).confinement -
          1.0,
      2.0 * gamma * gamma, 1e-11);
}

TEST(MudFlow, NarrowBoreConfinesMore) {
  const AnnularFlow mud(referenceMud());
  double mass = 0.0;
  double damping = 0.0;
  for (double bore : {1.0, 0.2, 0.108, 0.09, 0.085}) {
    const SectionFlow f = mud.flow(innerRadius, outerRadius, bore);
    EXPECT_GT(f.annulusMass, mass);
    EXPECT_GT(f.rotationDamping, damping);
    mass = f.annulusMass;
    damping = f.rotationDamping;
  }
}

TEST(MudFlow, BodyThatFillsTheBoreIsRefused) {
  const AnnularFlow mud(referenceMud());
  for (double bore : {outerRadius, 0.9 * outerRadius}) {
    try {
      mud.flow(innerRadius, outerRadius, bore);
      FAIL() << "accepted a bore of radius " << bore;
    } catch (const ModelError& error) {
      EXPECT_NE(std::string(error.what()).find("0.0795 m does not fit a bore"), std::string::npos)
          << error.what();
    }
  }
}

TEST(MudFlow, ThinFilmIsWarnedOf) {
  log::clearWarnings();
  const AnnularFlow mud(referenceMud());
  mud.flow(innerRadius, outerRadius, boreRadius);
  EXPECT_TRUE(log::warnings().empty());
  mud.flow(innerRadius, outerRadius, outerRadius * 1.01);
  mud.flow(innerRadius, outerRadius, outerRadius * 1.01);
  ASSERT_EQ(log::warnings().size(), 1U);
  EXPECT_NE(log::warnings()[0].find("thin film"), std::string::npos);
  log::clearWarnings();
}

TEST(MudFlow, NothingIsPumpedThroughASolidBar) {
  EXPECT_THROW(AnnularFlow(referenceMud()).flow(0.0, outerRadius, boreRadius), ModelError);
  MudProperties still = referenceMud();
  still.flowRate = 0.0;
  EXPECT_DOUBLE_EQ(AnnularFlow(still).flow(0.0, outerRadius, boreRadius).innerMass, 0.0);
}

TEST(MudFlow, ReversedFlowDragsDownAndStillDamps) {
  MudProperties reversed = referenceMud();
  reversed.flowRate = -0.01;
  const SectionFlow down = AnnularFlow(reversed).flow(innerRadius, outerRadius, boreRadius);
  const SectionFlow up = AnnularFlow(referenceMud()).flow(innerRadius, outerRadius, boreRadius);
  EXPECT_GT(down.axialDrag, 0.0);
  EXPECT_DOUBLE_EQ(down.axialDrag, -up.axialDrag);
  EXPECT_DOUBLE_EQ(down.axialFlowDamping, up.axialFlowDamping);
}

// -------------------------------------------------------------------------------------------------
// element matrices

const Vector3 downElement(0.0, 0.0, 9.81);

ElementContribution contribution(const MudProperties& p, double bore = boreRadius,
                                 const Vector3& gravity = downElement) {
  return AnnularFlow(p).element(collar(), bore, 1.0, gravity);
}

TEST(MudElement, WeightlessMudAddsNothing) {
  MudProperties p = referenceMud();
  p.density = 0.0;
  p.rotatingAnnulus = true;
  const ElementContribution c = contribution(p);
  EXPECT_EQ(c.mass.norm(), 0.0);
  EXPECT_EQ(c.load.norm(), 0.0);
  EXPECT_TRUE(c.damping.empty());
  EXPECT_TRUE(c.stiffness.empty());
}

TEST(MudElement, StillMudHasNoFlowTerms) {
  MudProperties p = referenceMud();
  p.flowRate = 0.0;
  const ElementContribution c = contribution(p);
  EXPECT_TRUE(c.stiffness.empty());
  ASSERT_EQ(c.damping.size(), 1U);
  EXPECT_EQ(c.damping[0].law, "sqrt|Omega|");
  EXPECT_GT(c.mass.norm(), 0.0);
}

TEST(MudElement, InviscidMudDoesNotDampRotation) {
  MudProperties p = referenceMud();
  p.kinematicViscosity = 0.0;
  EXPECT_EQ(find(contribution(p).damping, "mud rotation damping"), nullptr);
  p.kinematicViscosity = 4e-6;
  const ElementContribution four = contribution(p);
  const ElementContribution one = contribution(referenceMud());
  ASSERT_NE(find(four.damping, "mud rotation damping"), nullptr);
  EXPECT_NEAR(find(four.damping, "mud rotation damping")->matrix.norm() /
                  find(one.damping, "mud rotation damping")->matrix.norm(),
              2.0, 1e-12);
}

/// Without rotation only the terms of the law "1" remain: they do not depend on the viscosity or on
/// the swirl.
TEST(MudElement, WithoutRotationOnlyConstantTermsAct) {
  MudProperties p = referenceMud();
  p.rotatingAnnulus = true;
  p.kinematicViscosity = 1e-4;
  beam::Matrix12 damping = beam::Matrix12::Zero();
  beam::Matrix12 stiffness = beam::Matrix12::Zero();
  for (const auto& term : contribution(p).damping)
    if (term.law == "1") damping += term.matrix;
  for (const auto& term : contribution(p).stiffness)
    if (term.law == "1") stiffness += term.matrix;
  p.rotatingAnnulus = false;
  p.kinematicViscosity = 0.0;
  beam::Matrix12 plainDamping = beam::Matrix12::Zero();
  beam::Matrix12 plainStiffness = beam::Matrix12::Zero();
  for (const auto& term : contribution(p).damping) plainDamping += term.matrix;
  for (const auto& term : contribution(p).stiffness) plainStiffness += term.matrix;
  EXPECT_EQ((damping - plainDamping).norm(), 0.0);
  EXPECT_EQ((stiffness - plainStiffness).norm(), 0.0);
  EXPECT_GT(plainDamping.norm(), 0.0);
}

TEST(MudElement, ActsOnLateralDofsOnly) {
  MudProperties p = referenceMud();
  p.rotatingAnnulus = true;
  const ElementContribution c = contribution(p);
  const auto lateralOnly = [](const beam::Matrix12& m) {
    for (int axial : {2, 5, 8, 11})
      if (m.row(axial).norm() + m.col(axial).norm() != 0.0) return false;
    return true;
  };
  EXPECT_TRUE(lateralOnly(c.mass));
  for (const auto& term : c.damping) EXPECT_TRUE(lateralOnly(term.matrix)) << term.name;
  for (const auto& term : c.stiffness) EXPECT_TRUE(lateralOnly(term.matrix)) << term.name;
}

TEST(MudElement, SymmetryOfEachTerm) {
  MudProperties p = referenceMud();
  p.rotatingAnnulus = true;
  const ElementContribution c = contribution(p);
  EXPECT_LT(skewPart(c.mass), 1e-15);
  EXPECT_LT(skewPart(find(c.damping, "mud axial flow damping")->matrix), 1e-15);
  EXPECT_LT(skewPart(find(c.damping, "mud rotation damping")->matrix), 1e-15);
  EXPECT_LT(skewPart(find(c.stiffness, "mud centrifugal")->matrix), 1e-15);
  for (const auto* term : {find(c.damping, "mud Coriolis"), find(c.damping, "mud swirl Coriolis"),
                           find(c.stiffness, "mud swirl circulatory, axial flow"),
                           find(c.stiffness, "mud swirl circulatory, rotation")}) {
    ASSERT_NE(term, nullptr);
    EXPECT_LT((term->matrix + term->matrix.transpose()).norm(), 1e-14 * term->matrix.norm())
        << term->name;
    EXPECT_GT(term->matrix.norm(), 0.0) << term->name;
  }
}

TEST(MudElement, RigidTranslationCarriesAllTheMass) {
  const SectionFlow f = AnnularFlow(referenceMud()).flow(innerRadius, outerRadius, boreRadius);
  const ElementContribution c =
      AnnularFlow(referenceMud()).element(collar(), boreRadius, 2.5, downElement);
  for (int direction : {0, 1}) {
    beam::Vector12 unit = beam::Vector12::Zero();
    unit[direction] = unit[6 + direction] = 1.0;
    EXPECT_NEAR(unit.dot(c.mass * unit), 2.5 * (f.innerMass + f.annulusMass), 1e-10);
  }
}

/// The Coriolis terms of the flow, 2 m U int N'N_z, do no work on a chain with held ends, and equal
/// the assembled skew pair there. This also holds at changes of section, since each element keeps
/// its own m U.
TEST(MudElement, CoriolisForcesOfAHeldChainDoNoWork) {
  const AnnularFlow mud(referenceMud());
  const int elements = 6;
  const Eigen::Index dofs = 6 * (elements + 1);
  Matrix assembled = Matrix::Zero(dofs, dofs);
  Matrix oneSided = Matrix::Zero(dofs, dofs);
  for (int e = 0; e < elements; ++e) {
    const ElementContribution c = mud.element(collar(), boreRadius, 1.0, downElement);
    const SectionFlow f = mud.flow(innerRadius, outerRadius, boreRadius);
    assembled.block<12, 12>(6 * e, 6 * e) += find(c.damping, "mud Coriolis")->matrix;
    oneSided.block<12, 12>(6 * e, 6 * e) +=
        2.0 * (f.innerMass * f.innerSpeed - f.annulusMass * f.annulusSpeed) *
        beam::lateralSlope(1.0);
  }
  for (int trial = 0; trial < 5; ++trial) {
    Vector v = Vector::Random(dofs);
    for (Eigen::Index held : {Eigen::Index{0}, Eigen::Index{1}, dofs - 6, dofs - 5}) v[held] = 0.0;
    const double scale = v.squaredNorm() * assembled.norm();
    EXPECT_NEAR(v.dot(assembled * v) / scale, 0.0, 1e-15);
    EXPECT_NEAR(v.dot(oneSided * v) / scale, 0.0, 1e-15);
    Vector difference = (assembled - oneSided) * v;
    for (Eigen::Index held : {Eigen::Index{0}, Eigen::Index{1}, dofs - 6, dofs - 5})
      difference[held] = 0.0;
    EXPECT_LT(difference.norm(), 1e-12 * (assembled * v).norm());
  }
}

/// The annular mud exerts no force on a body that whirls with the swirl, at Omega/2: mass, damping
/// and stiffness cancel.
TEST(MudElement, SwirlingMudDoesNotResistWhirlingWithIt) {
  MudProperties p = referenceMud();
  p.rotatingAnnulus = true;
  p.centrifugal = false;
  p.coriolis = false;
  const AnnularFlow mud(p);
  const ElementContribution c = mud.element(collar(), boreRadius, 1.0, downElement);
  const double omega = -12.0;  // the sign must not matter
  const auto lawValue = [omega](const std::string& law) {
    if (law == "1") return 1.0;
    if (law == "Omega") return omega;
    if (law == "Omega^2") return omega * omega;
    if (law == "sqrt|Omega|") return std::sqrt(std::abs(omega));
    return omega * std::sqrt(std::abs(omega));
  };
  beam::Matrix12 damping = beam::Matrix12::Zero();
  beam::Matrix12 stiffness = beam::Matrix12::Zero();
  for (const auto& term : c.damping) damping += lawValue(term.law) * term.matrix;
  for (const auto& term : c.stiffness) stiffness += lawValue(term.law) * term.matrix;
  const SectionFlow f = mud.flow(innerRadius, outerRadius, boreRadius);
  const beam::Matrix12 annulus = c.mass - f.innerMass * beam::lateralMass(1.0);
  for (double t : {0.0, 0.13, 0.4}) {
    const double w = omega / 2.0;
    beam::Vector12 d = beam::Vector12::Zero();
    beam::Vector12 v = beam::Vector12::Zero();
    for (int node : {0, 6}) {
      d[node] = std::cos(w * t);
      d[node + 1] = std::sin(w * t);
      v[node] = -w * std::sin(w * t);
      v[node + 1] = w * std::cos(w * t);
    }
    const beam::Vector12 force = annulus * (-w * w * d) + damping * v + stiffness * d;
    EXPECT_LT(force.norm(), 1e-12 * (damping * v).norm());
    EXPECT_GT((damping * v).norm(), 1.0);
  }
}

TEST(MudElement, SwirlIsOffByDefault) {
  const ElementContribution c = contribution(referenceMud());
  for (const auto& term : c.stiffness) EXPECT_EQ(term.law, "1");
}

// -------------------------------------------------------------------------------------------------
// loads

TEST(MudLoad, SteelAsLightAsMudFloats) {
  MudProperties p = referenceMud();
  p.density = 7900.0;
  p.axialDrag = false;
  p.flowRate = 0.0;
  const Vector3 gravity(3.0, -2.0, 8.0);
  const ElementContribution c = contribution(p, boreRadius, gravity);
  const beam::Vector12 weight = beam::distributedLoad(7900.0 * collar().area() * gravity, 1.0);
  EXPECT_LT((c.load + weight).norm(), 1e-12 * weight.norm());
}

TEST(MudLoad, BuoyancyIsTheWeightOfTheDisplacedMudLessThatInside) {
  MudProperties p = referenceMud();
  p.axialDrag = false;
  const ElementContribution c = AnnularFlow(p).element(collar(), boreRadius, 3.0, downElement);
  EXPECT_NEAR(c.load[2] + c.load[8], -3.0 * 9.81 * 1200.0 * collar().area(), 1e-9);
}

TEST(MudLoad, DragPullsUpTheHoleAndCanBeSwitchedOff) {
  const SectionFlow f = AnnularFlow(referenceMud()).flow(innerRadius, outerRadius, boreRadius);
  MudProperties p = referenceMud();
  const beam::Vector12 with = contribution(p, boreRadius, Vector3::Zero()).load;
  EXPECT_NEAR(with[2] + with[8], f.axialDrag, 1e-12);
  EXPECT_LT(with[2], 0.0);
  p.axialDrag = false;
  EXPECT_EQ(contribution(p, boreRadius, Vector3::Zero()).load.norm(), 0.0);
}

// The mud between two radii is at rest on the whole: the pressure difference on its ends holds the
// shear on both walls, and the string has the shear on its own wall and that pressure on its area.
TEST(MudLoad, ThrustIsThePressureLostInTheAnnulusOnTheAreaOfTheString) {
  MudProperties p = referenceMud();
  const double drag = -AnnularFlow(p).flow(innerRadius, outerRadius, boreRadius).axialDrag;
  const double shear = drag / (2.0 * pi * outerRadius);
  const double annulus = pi * (boreRadius * boreRadius - outerRadius * outerRadius);
  const double gradient = shear * 2.0 * pi * (outerRadius + boreRadius) / annulus;
  p.annularThrust = true;
  EXPECT_NEAR(-AnnularFlow(p).flow(innerRadius, outerRadius, boreRadius).axialDrag,
              drag + pi * outerRadius * outerRadius * gradient, 1e-12 * drag);
}

// -------------------------------------------------------------------------------------------------
// deck

Teuchos::ParameterList deckList() {
  Teuchos::ParameterList list = test::defaultsOf(parameters());
  list.set("Density", 1200.0);
  list.set("Flow Rate", 0.01);
  return list;
}

TEST(MudDeck, DefaultsAreTheReferenceFluid) {
  const MudProperties p = readProperties(deckList());
  EXPECT_EQ(p.frictionCoefficient, 0.013);
  EXPECT_EQ(p.kinematicViscosity, 1e-6);
  EXPECT_TRUE(p.coriolis && p.centrifugal && p.axialDrag);
  EXPECT_FALSE(p.rotatingAnnulus || p.annularThrust);
}

/// Each parameter of the list changes the result in the expected direction.
TEST(MudDeck, EachParameterCounts) {
  const auto element = [](const std::function<void(Teuchos::ParameterList&)>& change) {
    Teuchos::ParameterList list = deckList();
    change(list);
    return readMud(list)->element(collar(), boreRadius, 1.0, downElement);
  };
  const ElementContribution base = element([](auto&) {});
  EXPECT_GT(element([](auto& l) { l.set("Density", 1500.0); }).mass.norm(), base.mass.norm());
  EXPECT_GT(find(element([](auto& l) { l.set("Friction Coefficient", 0.02); }).damping,
                 "mud axial flow damping")
                ->matrix.norm(),
            find(base.damping, "mud axial flow damping")->matrix.norm());
  EXPECT_GT(find(element([](auto& l) { l.set("Kinematic Viscosity", 1e-5); }).damping,
                 "mud rotation damping")
                ->matrix.norm(),
            find(base.damping, "mud rotation damping")->matrix.norm());
  EXPECT_GT(find(element([](auto& l) { l.set("Flow Rate", 0.02); }).stiffness, "mud centrifugal")
                ->matrix.norm(),
            find(base.stiffness, "mud centrifugal")->matrix.norm());
  EXPECT_EQ(find(element([](auto& l) { l.set("Coriolis", false); }).damping, "mud Coriolis"),
            nullptr);
  EXPECT_NE(find(base.damping, "mud Coriolis"), nullptr);
  EXPECT_EQ(
      find(element([](auto& l) { l.set("Centrifugal", false); }).stiffness, "mud centrifugal"),
      nullptr);
  EXPECT_GT(element([](auto& l) { l.set("Axial Drag", false); }).load[2], base.load[2]);
  EXPECT_LT(element([](auto& l) { l.set("Annular Thrust", true); }).load[2], base.load[2]);
  EXPECT_NE(
      find(element([](auto& l) { l.set("Rotating Annulus", true); }).damping, "mud swirl Coriolis"),
      nullptr);
}

TEST(MudDeck, EveryElementIsCounted) {
  resetEvaluationCounters();
  contribution(referenceMud());
  contribution(referenceMud());
  EXPECT_EQ(counted("mud matrices"), 2);
  resetEvaluationCounters();
}

TEST(MudDeck, SectionWithoutRadiiIsRefused) {
  const beam::Section bare = beam::Section::general(0.01, 1e-5, 1e-5, 2e-5, {7900.0, 2.03e11, 0.3});
  EXPECT_THROW(AnnularFlow(referenceMud()).element(bare, boreRadius, 1.0, downElement), ModelError);
}

}  // namespace MudTest
}  // namespace tooljoint::mud
