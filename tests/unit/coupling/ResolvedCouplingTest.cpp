// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The deck list Coupling: from its text to coupled models with solutions in closed form, and the
/// messages for inconsistent lists.
#include "coupling/input/ResolvedCoupling.hpp"

#include <Eigen/Geometry>
#include <Teuchos_ParameterList.hpp>
#include <gtest/gtest.h>

#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "coupling/CoupledModes.hpp"
#include "coupling/assembly/Assembler.hpp"
#include "deck/Deck.hpp"
#include "linalg/trilinos/DirectSolver.hpp"
#include "tests/support/SampleParts.hpp"

namespace ResolvedCouplingTest {

using namespace tooljoint;
using namespace tooljoint::coupling;
using model::DofLabel;

/// The list Coupling with this inside.
CouplingInput read(const std::string& inside) {
  deck::ListSpec scene("Scene", "A scene.");
  scene.list(parameters());
  const auto deck =
      deck::Deck::parse("<ParameterList name=\"scene\"><ParameterList name=\"Coupling\">" + inside +
                            "</ParameterList></ParameterList>",
                        "deck.xml", scene);
  return readCoupling(deck.list().sublist("Coupling"));
}

std::string value(const std::string& name, const std::string& type, const std::string& text) {
  return "<Parameter name=\"" + name + "\" type=\"" + type + "\" value=\"" + text + "\"/>";
}
std::string text(const std::string& name, const std::string& what) {
  return value(name, "string", what);
}
std::string numbers(const std::string& name, const std::string& what) {
  return value(name, "Array(double)", "{" + what + "}");
}
std::string list(const std::string& name, const std::string& inside) {
  return "<ParameterList name=\"" + name + "\">" + inside + "</ParameterList>";
}

std::string refusal(const std::string& inside) {
  try {
    read(inside);
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

Coupling joined(const std::vector<model::Substructure>& parts, const CouplingInput& given) {
  const auto resolved = resolve(parts, given);
  return coupleWithPositions(resolved.parts, resolved.options);
}

/// Static displacement of a dof under a force on another, point laws linear.
double answer(const model::SecondOrderModel& m, const DofLabel& at, const DofLabel& loaded,
              double force) {
  const Vector zero = Vector::Zero(m.size());
  Vector F = zero;
  const int i = samples::find(m, loaded), j = samples::find(m, at);
  EXPECT_GE(i, 0);
  EXPECT_GE(j, 0);
  F[i] = force;
  return linalg::DirectSolver(
             Sparse(m.stiffnessAt(0) + m.pointStiffness(0, m.initialDisplacement, zero)))
      .solve(F)[j];
}

/// A clamped bar of nodes 1 to 4 and a free one of nodes 4 to 7, springs of 3 N/m between nodes.
std::vector<model::Substructure> twoBars() {
  std::vector<model::Substructure> parts{samples::bar("top", 1, 3, 3.0, 2.0, {1}),
                                         samples::bar("bottom", 4, 3, 3.0, 2.0)};
  for (auto& part : parts) samples::classify(part, {4});
  return parts;
}

TEST(ResolvedCoupling, WithoutAnythingLabelsJoin) {
  const auto coupled = joined(twoBars(), read(""));
  EXPECT_EQ(coupled.model.size(), 6);
  EXPECT_NEAR(answer(coupled.model, DofLabel::physical(7, 0), DofLabel::physical(7, 0), 6.0),
              6.0 * 6 / 3.0, 1e-12);
}

TEST(ResolvedCoupling, PartsWithNumbersOfTheirOwnAreJoinedByJoints) {
  std::vector<model::Substructure> parts{samples::bar("top", 1, 3, 3.0, 2.0, {1}),
                                         samples::bar("bottom", 1, 3, 3.0, 2.0)};
  const auto given =
      read(text("Node Numbers", "Own") +
           list("Joints", list("middle", value("Nodes", "Array(string)", "{top:4, bottom:1}"))) +
           list("Springs", list("end", text("First", "bottom:4") + text("Component", "u") +
                                           value("Stiffness", "double", "2"))));
  const auto coupled = joined(parts, given);
  EXPECT_EQ(coupled.model.size(), 6);
  ASSERT_EQ(coupled.model.points.size(), 1u);
  // 6 springs of 3 in a row, and one of 2 to the ground at the end: u = F / (0.5 + 2)
  const DofLabel end = DofLabel::physical(24, 0);
  EXPECT_NEAR(answer(coupled.model, end, end, 5.0), 5.0 / 2.5, 1e-12);
}

TEST(ResolvedCoupling, ASpringTakesThePlaceOfAReleasedDof) {
  const auto given =
      read(list("Releases", list("slide", text("Node", "bottom:4") + text("Components", "u"))) +
           list("Springs", list("slide", text("First", "top:4") + text("Second", "bottom:4") +
                                             numbers("Direction", "1, 0, 0") +
                                             value("Stiffness", "double", "0.25"))));
  for (const char* assembly : {"Primal", "Dual"}) {
    auto chosen = given;
    chosen.assembly = std::string(assembly) == "Dual" ? Assembly::Dual : Assembly::Primal;
    const auto coupled = joined(twoBars(), chosen);
    EXPECT_NEAR(answer(coupled.model, DofLabel::physical(7, 0), DofLabel::physical(7, 0), 2.0),
                2.0 * (1 + 4 + 1), 1e-11)
        << assembly;
  }
}

TEST(ResolvedCoupling, InnerDofsThatAreNamedAreRetained) {
  const auto given = read(list(
      "Springs", list("brace", text("First", "top:2") + text("Second", "bottom:6") +
                                   text("Component", "u") + value("Stiffness", "double", "1"))));
  const auto resolved = resolve(twoBars(), given);
  EXPECT_EQ(resolved.parts[0].retained, std::vector<int>{0});
  EXPECT_EQ(resolved.parts[1].retained, std::vector<int>{2});
}

/// Both bars hanging in equilibrium under a force of 6 N at the end, linearised about that state.
std::vector<model::Substructure> stretchedBars() {
  auto parts = twoBars();
  for (auto& part : parts) {
    part.reference.resize(part.model.size());
    for (int i = 0; i < part.model.size(); ++i)
      part.reference[i] =
          6.0 / 3.0 * static_cast<double>(part.model.dofs[static_cast<std::size_t>(i)].entity - 1);
    part.model.initialDisplacement = part.reference;
  }
  Vector pull = Vector::Zero(parts[1].model.size());
  pull[3] = 6.0;
  parts[1].model.loads.push_back({"pull", pull, 0});
  return parts;
}

/// Residual of equilibrium at the start.
double residual(const model::SecondOrderModel& m) {
  const Vector zero = Vector::Zero(m.size());
  return (m.stiffnessAt(0) * m.initialDisplacement - m.loadAt(0) -
          m.pointForce(0, m.initialDisplacement, zero))
      .norm();
}

TEST(ResolvedCoupling, AReleasedJointKeepsWhatItCarries) {
  const std::string slide =
      list("Releases", list("slide", text("Node", "bottom:4") + text("Components", "u"))) +
      list("Springs",
           list("slide", text("First", "top:4") + text("Second", "bottom:4") +
                             text("Component", "u") + value("Stiffness", "double", "0.25")));
  EXPECT_NEAR(residual(joined(stretchedBars(), read(slide)).model), 0.0, 1e-12);
  // Without it the 6 N of the joint are missing on either side.
  EXPECT_NEAR(
      residual(joined(stretchedBars(), read(slide + value("Keep Static Forces", "bool", "false")))
                   .model),
      6.0 * std::sqrt(2.0), 1e-12);
}

TEST(ResolvedCoupling, ConstraintsAndStopsAreMeasuredFromTheReferenceState) {
  const auto given = read(
      list("Constraints", list("tie", value("Terms", "Array(string)", "{top:3:u, bottom:6:u}") +
                                          numbers("Factors", "1, -1"))) +
      list("Stops",
           list("floor", text("First", "bottom:5") + text("Component", "u") +
                             value("Stiffness", "double", "100") + value("Gap", "double", "0.5"))));
  const auto coupled = joined(stretchedBars(), given);
  EXPECT_EQ(coupled.model.size(), 5);
  EXPECT_NEAR(residual(coupled.model), 0.0, 1e-12)
      << "the tie holds as it is, and the stop is open";
  const auto& floor = coupled.model.points.front();
  Vector q = coupled.model.initialDisplacement;
  q[samples::find(coupled.model, DofLabel::physical(5, 0))] -= 0.75;
  EXPECT_NEAR(coupled.model.pointForce(0, q, Vector::Zero(q.size())).cwiseAbs().maxCoeff(), 25.0,
              1e-9)
      << floor.name;
}

/// A beam of 4 m clamped at both ends, in two parts that meet in node 3.
std::vector<model::Substructure> clampedBeam() {
  samples::Frame frame;
  frame.corners = {{1, {0, 0}}, {3, {2, 0}}, {2, {4, 0}}};
  frame.clamped = {1, 2};
  std::vector<model::Substructure> parts{samples::framePart("left", frame, {{1, 3, {11, 12}}}),
                                         samples::framePart("right", frame, {{3, 2, {21, 22}}})};
  for (auto& part : parts) samples::classify(part, {3});
  return parts;
}

TEST(ResolvedCoupling, AHingeBetweenTwoCantilevers) {
  const samples::Frame frame;
  const DofLabel v = DofLabel::physical(3, 1);
  // Clamped at both ends: F L^3 / 192 EI; two cantilevers of half the length that share the force:
  // F (L/2)^3 / 6 EI.
  EXPECT_NEAR(
      answer(joined(clampedBeam(), read("")).model, v, v, 1e3) / (1e3 * 64 / (192 * frame.EI)), 1.0,
      1e-9);
  const auto hinged =
      joined(clampedBeam(),
             read(list("Hinges", list("knee", text("First", "left:3") + text("Second", "right:3") +
                                                  numbers("Axis", "0, 0, 1")))));
  const auto at = samples::find(hinged.model, v) >= 0 ? v : v.of(1);
  EXPECT_NEAR(answer(hinged.model, at, at, 1e3) / (1e3 * 8 / (6 * frame.EI)), 1.0, 1e-9);
}

TEST(ResolvedCoupling, ARigidLinkIsALever) {
  samples::Frame frame;
  frame.corners = {{1, {0, 0}}, {2, {2, 0}}, {3, {2.5, 0}}, {4, {4.5, 0}}};
  frame.clamped = {1};
  std::vector<model::Substructure> parts{samples::framePart("left", frame, {{1, 2, {11, 12}}}),
                                         samples::framePart("right", frame, {{3, 4, {21, 22}}})};
  const auto given =
      read(list("Rigid Links", list("arm", text("From", "left:2") + text("To", "right:3") +
                                               numbers("Arm", "0.5, 0, 0"))));
  // A force F at the end bends the left beam by F and F (0.5 + 2) at its tip, the right one as a
  // cantilever.
  const double F = 1e3, L = 2, b = 2.5, EI = frame.EI;
  const double tip = F * L * L * L / (3 * EI) + F * b * L * L / (2 * EI),
               slope = F * L * L / (2 * EI) + F * b * L / EI;
  const DofLabel end = DofLabel::physical(4, 1);
  EXPECT_NEAR(answer(joined(parts, given).model, end, end, F) /
                  (tip + slope * b + F * L * L * L / (3 * EI)),
              1.0, 1e-9);
}

TEST(ResolvedCoupling, LinksThatDoNotLeadBackAreRefused) {
  samples::Frame frame;
  frame.corners = {{1, {0, 0}}, {2, {2, 0}}, {3, {2.5, 0}}, {4, {4.5, 0}}};
  frame.clamped = {1};
  const std::vector<model::Substructure> parts{
      samples::framePart("left", frame, {{1, 2, {11, 12}}}),
      samples::framePart("right", frame, {{3, 4, {21, 22}}})};
  const auto link = [](const std::string& name, const std::string& from, const std::string& to,
                       const std::string& arm) {
    return list(name, text("From", from) + text("To", to) + numbers("Arm", arm));
  };
  const auto said = [&](const std::string& links) -> std::string {
    try {
      resolve(parts, read(list("Rigid Links", links)));
    } catch (const ModelError& error) {
      return error.what();
    }
    return "accepted";
  };
  const auto there = link("there", "left:2", "right:3", "0.5, 0, 0");
  const auto back = there + link("back", "right:3", "left:2", "-0.5, 0, 0");
  EXPECT_EQ(said(back), "accepted");
  const auto remarks = joined(parts, read(list("Rigid Links", back))).remarks;
  ASSERT_FALSE(remarks.empty());
  EXPECT_NE(remarks.front().find("rigid link \"back\", u"), std::string::npos) << remarks.front();
  EXPECT_EQ(said(there + link("out of the plane", "right:3", "left:2", "-0.5, 0, 1")), "accepted");
  const auto other = said(there + link("back", "right:3", "left:2", "-0.4, 0, 0"));
  EXPECT_NE(other.find("back leads along (-0.4, 0, 0) m, but the other links between its nodes "
                       "lead along (-0.5, 0, 0) m"),
            std::string::npos)
      << other;
  const auto round = said(there + link("on", "right:3", "right:4", "2, 0, 0") +
                          link("home", "left:2", "right:4", "2, 0.5, 0"));
  EXPECT_NE(round.find("home leads along (2, 0.5, 0) m"), std::string::npos) << round;
  // The ends of one joint are one node.
  const auto joint = clampedBeam();
  try {
    resolve(joint, read(list("Rigid Links", link("arm", "left:3", "right:3", "0.1, 0, 0"))));
    ADD_FAILURE() << "accepted";
  } catch (const ModelError& error) {
    EXPECT_NE(std::string(error.what()).find("its ends are one node"), std::string::npos)
        << error.what();
  }
}

TEST(ResolvedCoupling, DirectionsAreMeantInTheCommonFrame) {
  // The right part in axes turned by 90 degrees: its own v is the common -u.
  auto parts = clampedBeam();
  auto turned = samples::framePart("right",
                                   [] {
                                     samples::Frame own;
                                     own.corners = {{3, {0, 0}}, {2, {0, -2}}};
                                     own.clamped = {2};
                                     return own;
                                   }(),
                                   {{3, 2, {21, 22}}});
  samples::classify(turned, {3});
  parts[1] = turned;
  const std::string frame =
      list("Frames", list("own", text("Part", "right") + numbers("Axis 1", "0, 1, 0") +
                                     numbers("Axis 2", "-1, 0, 0")));
  const DofLabel v = DofLabel::physical(3, 1);
  const double EI = samples::Frame().EI;
  EXPECT_NEAR(answer(joined(parts, read(frame)).model, v, v, 1e3) / (1e3 * 64 / (192 * EI)), 1.0,
              1e-9);
  const auto braced = joined(
      parts, read(frame + list("Springs", list("brace", text("First", "right:22") +
                                                            numbers("Direction", "0, 3, 0") +
                                                            value("Stiffness", "double", "1e6")))));
  auto whole = clampedBeam();
  const auto same = joined(
      whole, read(list("Springs", list("brace", text("First", "right:22") + text("Component", "v") +
                                                    value("Stiffness", "double", "1e6")))));
  EXPECT_NEAR(answer(braced.model, v, v, 1e3) / answer(same.model, v, v, 1e3), 1.0, 1e-9);
  const Vector a = lowestModes(braced.model, 5).values, b = lowestModes(same.model, 5).values;
  for (int i = 0; i < 5; ++i) EXPECT_NEAR(a[i] / b[i], 1.0, 1e-9) << "mode " << i + 1;
}

/// cos(pi/2) is not zero in floating point, and gives a mass of 1e-33 at the neighbouring dof.
TEST(ResolvedCoupling, AMasslessDofIsMasslessInAxesAQuarterTurnAway) {
  auto parts = clampedBeam();
  const int massless = samples::find(parts[1].model, DofLabel::physical(22, 0));
  Sparse mass = parts[1].model.mass;
  mass.prune([&](auto row, auto column, double) { return row != massless && column != massless; });
  parts[1].model.mass = mass;
  CouplingOptions options;
  Frame quarter;
  quarter.part = parts[1].name;
  quarter.axes = Eigen::AngleAxisd(constants::pi / 2, Vector3::UnitZ()).toRotationMatrix();
  options.connections.frames = {quarter};
  const auto whole = couple(parts, options);
  EXPECT_EQ((whole.mass.diagonal().array() == 0.0).count(), 1);
  EXPECT_EQ(whole.mass.coeff(samples::find(whole, DofLabel::physical(22, 1)),
                             samples::find(whole, DofLabel::physical(22, 1))),
            0.0);
}

TEST(ResolvedCoupling, AStopWithFrictionHasTangents) {
  const auto given =
      read(list("Stops", list("pad", text("First", "left:12") + numbers("Direction", "0, 2, 0") +
                                         value("Stiffness", "double", "1e5") +
                                         value("Gap", "double", "-1e-3") +
                                         value("Friction", "double", "0.4") +
                                         value("Slip Velocity", "double", "1e-6"))));
  const auto m = joined(clampedBeam(), given).model;
  ASSERT_EQ(m.points.front().law->width(), 2);
  Vector velocity = Vector::Zero(m.size());
  velocity[samples::find(m, DofLabel::physical(12, 0))] = 0.1;
  const Vector force = m.pointForce(0, Vector::Zero(m.size()), velocity);
  EXPECT_NEAR(force[samples::find(m, DofLabel::physical(12, 1))], 100.0, 1e-6)
      << "pushed back along the direction";
  EXPECT_NEAR(force[samples::find(m, DofLabel::physical(12, 0))], -40.0, 1e-4)
      << "friction against the motion";
}

TEST(ResolvedCoupling, ASliderBrakes) {
  const auto given = read(list(
      "Sliders",
      list("brake", text("First", "top:3") + text("Second", "bottom:5") + text("Component", "u") +
                        value("Force", "double", "7") + value("Slip Velocity", "double", "1e-6"))));
  const auto m = joined(twoBars(), given).model;
  Vector velocity = Vector::Zero(m.size());
  velocity[samples::find(m, DofLabel::physical(5, 0))] = 1.0;
  const Vector force = m.pointForce(0, Vector::Zero(m.size()), velocity);
  EXPECT_NEAR(force[samples::find(m, DofLabel::physical(5, 0))], -7.0, 1e-9);
  EXPECT_NEAR(force[samples::find(m, DofLabel::physical(3, 0))], 7.0, 1e-9);
}

TEST(ResolvedCoupling, AConstraintHoldsItsValue) {
  const auto given =
      read(list("Constraints",
                list("apart", value("Terms", "Array(string)", "{bottom:7:u, top:2:u}") +
                                  numbers("Factors", "1, -2") + value("Value", "double", "0.3"))));
  auto parts = twoBars();
  parts[1].model.initialDisplacement[3] = 0.3;
  const auto coupled = joined(parts, given);
  Vector z = Vector::LinSpaced(coupled.model.size(), 0.1, 0.9);
  const Vector top = coupled.local(0, z) + coupled.offsets[0],
               bottom = coupled.local(1, z) + coupled.offsets[1];
  EXPECT_NEAR(bottom[3] - 2 * top[0], 0.3, 1e-12);
}

TEST(PlannedCouplingErrors, AreSentences) {
  const auto has = [](const std::string& found, const std::string& expected) {
    EXPECT_NE(found.find(expected), std::string::npos) << found;
  };
  has(refusal(list("Springs", list("s", text("First", "top") + text("Component", "u") +
                                            value("Stiffness", "double", "1")))),
      "/scene/Coupling/Springs/s/First is \"top\". A node is written PART:NODE");
  has(refusal(
          list("Springs", list("s", text("First", "top:2") + value("Stiffness", "double", "1")))),
      "gives neither Direction and Component");
  has(refusal(list("Springs", list("s", text("First", "top:2") + text("Component", "u")))),
      "does nothing: give it a Stiffness");
  has(refusal(list("Stops", list("s", text("First", "top:2") + text("Component", "u") +
                                          value("Stiffness", "double", "1") +
                                          value("Friction", "double", "1")))),
      "needs a Direction");
  has(refusal(list("Constraints", list("c", value("Terms", "Array(string)", "{top:2:u, top:3:u}") +
                                                numbers("Factors", "1")))),
      "has 1 numbers for 2 terms");
  has(refusal(list("Constraints", list("c", value("Terms", "Array(string)", "{top:2}") +
                                                numbers("Factors", "1")))),
      "is written PART:NODE");
  has(refusal(list("Frames", list("f", text("Part", "top") + numbers("Axis 1", "1, 0, 0") +
                                           numbers("Axis 2", "1, 1, 0")))),
      "is not perpendicular to Axis 1");
  has(refusal(list("Joints", list("j", value("Nodes", "Array(string)", "{top:4, bottom:1}")))),
      "has no effect with shared node numbers");
  has(refusal(list("Hinges", list("h", text("First", "3") + text("Second", "3") +
                                           numbers("Axis", "0, 0, 1")))),
      "is the same node as First");
  try {
    checkNames(read(list("Springs", list("s", text("First", "tip:2") + text("Second", "bottom:9") +
                                                  text("Component", "w") +
                                                  value("Stiffness", "double", "1")))),
               {{"top", {1, 2, 3, 4}}, {"bottom", {4, 5, 6, 7}}}, {"u"});
    FAIL() << "accepted";
  } catch (const DeckError& error) {
    has(error.what(),
        "/scene/Coupling/Springs/s/First names part \"tip\", but no part has this name. Did you "
        "mean \"top\"?");
    has(error.what(),
        "names node 9 of part \"bottom\", but the part has no such node. Its nodes lie between 4 "
        "and 7.");
    has(error.what(), "names the component \"w\", but the components of a node are \"u\".");
  }
}

TEST(PlannedCouplingErrors, NamePlaceAndPart) {
  const auto sentence = [](const std::string& inside) {
    try {
      resolve(twoBars(), read(inside));
    } catch (const DeckError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_NE(
      sentence(list("Sliders", list("brake", text("First", "botom:5") + text("Component", "u") +
                                                 value("Force", "double", "1"))))
          .find("/scene/Coupling/Sliders/brake/First names part \"botom\", but no part has this "
                "name. Did you mean \"bottom\"?"),
      std::string::npos);
  EXPECT_NE(sentence(list("Sliders", list("brake", text("First", "top:3") + text("Component", "w") +
                                                       value("Force", "double", "1"))))
                .find("/scene/Coupling/Sliders/brake/Component names the component \"w\""),
            std::string::npos);
}

}  // namespace ResolvedCouplingTest
