// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Loads: the unbalance force against the momentum of its mass, directions of weight and torque on
/// bit, nodal forces in time, positions by number and by depth, and refused decks.
#include <Teuchos_Array.hpp>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <set>
#include <string>
#include <vector>

#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "common/report/EvaluationCounters.hpp"
#include "common/report/Log.hpp"
#include "substructures/loads/Damping.hpp"
#include "substructures/loads/Load.hpp"
#include "substructures/loads/Place.hpp"
#include "tests/support/ListDefaults.hpp"

namespace tooljoint::loads {
namespace LoadsTest {

const std::vector<double> depths{0.0, 1.8, 3.6, 5.4, 7.2};

RotarySpeed turning(double finalSpeed = 12.0) {
  Teuchos::ParameterList list("Rotary Speed");
  list.set("Law", "Exponential");
  list.sublist("Exponential")
      .set("Final Speed", finalSpeed)
      .set("Initial Speed", 1.0)
      .set("Time Constant", 0.3);
  return RotarySpeed(list);
}

Teuchos::ParameterList deckList() { return test::defaultsOf(parameters()); }

Teuchos::ParameterList& entry(Teuchos::ParameterList& loads, const char* kind, const char* name) {
  Teuchos::ParameterList& list = loads.sublist(kind).sublist(name);
  list.setParameters(test::defaultsOf(*parameters().findList(kind)->pattern()));
  return list;
}

void addMass(Teuchos::ParameterList& loads, const char* name, int node, double moment,
             double phase) {
  entry(loads, "Unbalance", name).set("Node", node).set("Moment", moment).set("Phase", phase);
}

Loads unbalanced(double moment, double phase) {
  Teuchos::ParameterList list = deckList();
  addMass(list, "off axis", 3, moment, phase);
  return readLoads(list);
}

/// Names of the laws of time of the loads.
std::set<std::string> lawsOf(const std::vector<PointLoad>& loads) {
  std::set<std::string> names;
  for (const auto& load : loads) names.insert(load.law.name);
  return names;
}

/// Sum of the loads on one dof at time t.
double total(const std::vector<PointLoad>& loads, int node, int component, double t) {
  double sum = 0.0;
  for (const auto& load : loads)
    if (load.node == node && load.component == component) sum += load.value * load.law.value(t);
  return sum;
}

// -------------------------------------------------------------------------------------------------
// unbalance

/// A mass m at m e (cos phi, sin phi)/m from the axis needs the force d2/dt2 of its moment; the
/// opposite force acts on the string.
TEST(Unbalance, IsTheRateOfChangeOfTheMomentumOfTheMass) {
  const double moment = 0.7;
  const double phase = 0.9;
  const RotarySpeed rotary = turning();
  const auto loads = pointLoads(unbalanced(moment, phase), depths, rotary);
  const auto x = [&](double t) { return moment * std::cos(rotary.angle(t) + phase); };
  const auto y = [&](double t) { return moment * std::sin(rotary.angle(t) + phase); };
  const double h = 1e-4;
  for (double t : {0.05, 0.2, 0.55, 1.3, 2.0}) {
    const double forceX = -(x(t + h) - 2.0 * x(t) + x(t - h)) / (h * h);
    const double forceY = -(y(t + h) - 2.0 * y(t) + y(t - h)) / (h * h);
    EXPECT_NEAR(total(loads, 3, 0, t), forceX, 2e-5 * moment * 144.0) << t;
    EXPECT_NEAR(total(loads, 3, 1, t), forceY, 2e-5 * moment * 144.0) << t;
  }
}

TEST(Unbalance, AtSteadySpeedIsTheCentrifugalForce) {
  const RotarySpeed rotary = turning(12.0);
  const auto loads = pointLoads(unbalanced(0.5, 0.0), depths, rotary);
  const double t = 30.0;
  EXPECT_NEAR(std::hypot(total(loads, 3, 0, t), total(loads, 3, 1, t)), 0.5 * 144.0, 1e-9);
  EXPECT_NEAR(std::atan2(total(loads, 3, 1, t), total(loads, 3, 0, t)),
              std::remainder(rotary.angle(t), constants::twoPi), 1e-9);
}

TEST(Unbalance, AllShareTwoLawsWhateverTheirPhase) {
  Teuchos::ParameterList list = deckList();
  addMass(list, "off axis", 3, 0.5, 0.3);
  addMass(list, "other", 2, 0.1, -2.0);
  const auto found = pointLoads(readLoads(list), depths, turning());
  EXPECT_EQ(found.size(), 8U);
  EXPECT_EQ(lawsOf(found).size(), 2U);
}

TEST(Unbalance, WithoutRotationIsLeftOutWithAWarning) {
  log::clearWarnings();
  resetEvaluationCounters();
  EXPECT_TRUE(pointLoads(unbalanced(0.5, 0.0), depths, RotarySpeed()).empty());
  ASSERT_EQ(log::warnings().size(), 1U);
  EXPECT_NE(log::warnings()[0].find("does not turn"), std::string::npos);
  EXPECT_EQ(counted("unbalance loads"), 0);
  pointLoads(unbalanced(0.5, 0.0), depths, turning());
  EXPECT_EQ(counted("unbalance loads"), 1);
  log::clearWarnings();
  resetEvaluationCounters();
}

// -------------------------------------------------------------------------------------------------
// bit loads

TEST(BitLoads, WeightPushesUpAndTorqueResists) {
  Teuchos::ParameterList given = deckList();
  given.set("Weight On Bit", 1e4).set("Torque On Bit", 5000.0);
  const auto list = pointLoads(readLoads(given), depths, RotarySpeed());
  EXPECT_EQ(list.size(), 2U);
  EXPECT_EQ(total(list, 5, 2, 0.0), -1e4);
  EXPECT_EQ(total(list, 5, 5, 3.0), -5000.0);
  for (const auto& load : list) EXPECT_EQ(load.law.name, "1");
}

TEST(BitLoads, NoneWithoutNumbers) {
  EXPECT_TRUE(pointLoads(readLoads(deckList()), depths, turning()).empty());
  EXPECT_TRUE(pointLoads(Loads(), depths, turning()).empty());
}

// -------------------------------------------------------------------------------------------------
// nodal forces

constexpr double never = std::numeric_limits<double>::infinity();

void addForce(Teuchos::ParameterList& loads, const char* name, double frequency, double phase,
              double start, double end) {
  auto& list = entry(loads, "Forces", name);
  list.set("Node", 2).set("Component", "v").set("Value", 100.0);
  list.set("Frequency", frequency).set("Phase", phase).set("Start Time", start);
  if (std::isfinite(end)) list.set("End Time", end);
}

std::vector<PointLoad> force(double frequency, double phase, double start, double end) {
  Teuchos::ParameterList list = deckList();
  addForce(list, "push", frequency, phase, start, end);
  return pointLoads(readLoads(list), depths, RotarySpeed());
}

TEST(NodalForces, SteadyOneIsAStaticLoad) {
  const auto list = force(0.0, 0.7, 0.0, never);
  ASSERT_EQ(list.size(), 1U);
  EXPECT_EQ(list[0].law.name, "1");
  EXPECT_EQ(total(list, 2, 1, 5.0), 100.0);
}

TEST(NodalForces, HarmonicAndWindowed) {
  const auto list = force(2.0, 0.5, 1.0, 3.0);
  EXPECT_EQ(total(list, 2, 1, 0.999), 0.0);
  EXPECT_NEAR(total(list, 2, 1, 1.3), 100.0 * std::cos(4.0 * constants::pi * 1.3 + 0.5), 1e-12);
  EXPECT_EQ(total(list, 2, 1, 3.0), 0.0);
  EXPECT_EQ(list[0].law.corners, std::vector<double>({1.0, 3.0}));
  EXPECT_EQ(force(0.0, 0.0, 0.0, 2.0)[0].law.corners, std::vector<double>({2.0}));
  EXPECT_EQ(force(2.0, 0.0, 0.0, never)[0].law.corners, std::vector<double>());
}

TEST(NodalForces, EqualLawsAreOneAndDifferentOnesAreNot) {
  Teuchos::ParameterList list = deckList();
  addForce(list, "a", 2.0, 0.5, 0.0, never);
  addForce(list, "b", 2.0, 0.5, 0.0, never);
  addForce(list, "c", 2.0, 0.6, 0.0, never);
  addForce(list, "d", 2.0, 0.5, 0.0, 1.0);
  addForce(list, "e", 2.0, 0.5, 0.5, never);
  addForce(list, "f", 3.0, 0.5, 0.0, never);
  const auto found = pointLoads(readLoads(list), depths, RotarySpeed());
  EXPECT_EQ(found.size(), 6U);
  EXPECT_EQ(lawsOf(found).size(), 5U);
}

// -------------------------------------------------------------------------------------------------
// places

TEST(Places, ByNumberAndByDepth) {
  EXPECT_EQ(nodeOf({4, std::nullopt}, depths, "x"), 4);
  EXPECT_EQ(nodeOf({std::nullopt, 3.6}, depths, "x"), 3);
  EXPECT_EQ(nodeOf({std::nullopt, 3.6 + 5e-7}, depths, "x"), 3);
}

TEST(Places, ThatDoNotExistAreRefused) {
  const auto refused = [](const Place& place, const std::string& part) {
    try {
      nodeOf(place, depths, "Loads/Forces/push");
      FAIL() << part;
    } catch (const DeckError& error) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("Loads/Forces/push"), std::string::npos)
          << error.what();
    }
  };
  refused({6, std::nullopt}, "the string has nodes 1 to 5");
  refused({std::nullopt, 3.7}, "the nearest is node 3 at 3.6 m");
  refused({std::nullopt, 100.0}, "the nearest is node 5 at 7.2 m");
}

// -------------------------------------------------------------------------------------------------
// deck

TEST(LoadsDeck, GravityIsThereUnlessSwitchedOff) {
  Teuchos::ParameterList list = deckList();
  EXPECT_EQ(acceleration(readLoads(list)), Vector3(0.0, 0.0, 9.81));
  list.set("Gravity", 0.0);
  EXPECT_EQ(acceleration(readLoads(list)), Vector3::Zero());
  EXPECT_EQ(acceleration(Loads()), Vector3::Zero());  // no list, no weight
}

/// Each entry of the list at its node, in its direction, with its numbers.
TEST(LoadsDeck, ReadsEverything) {
  Teuchos::ParameterList list = deckList();
  list.set("Weight On Bit", 1e4).set("Torque On Bit", 5000.0);
  entry(list, "Unbalance", "a")
      .set("Node", 3)
      .set("Mass", 2.0)
      .set("Eccentricity", 0.01)
      .set("Phase", 1.5);
  entry(list, "Unbalance", "b").set("Position", 1.8).set("Moment", 0.3);
  entry(list, "Forces", "push")
      .set("Node", 2)
      .set("Component", "theta_y")
      .set("Value", 7.0)
      .set("Frequency", 3.0)
      .set("Phase", 0.2)
      .set("Start Time", 1.0);
  const RotarySpeed rotary = turning();
  const auto found = pointLoads(readLoads(list), depths, rotary);
  EXPECT_EQ(found.size(), 2U + 1U + 8U);
  const double t = 1.7;
  EXPECT_EQ(total(found, 5, 2, t), -1e4);
  EXPECT_EQ(total(found, 5, 5, t), -5000.0);
  EXPECT_EQ(total(found, 2, 4, 0.9), 0.0);
  EXPECT_NEAR(total(found, 2, 4, t), 7.0 * std::cos(6.0 * constants::pi * t + 0.2), 1e-12);
  const auto alongX = [&](double moment, double phase) {
    return moment * (std::pow(rotary.speed(t), 2) * std::cos(rotary.angle(t) + phase) +
                     rotary.acceleration(t) * std::sin(rotary.angle(t) + phase));
  };
  EXPECT_NEAR(total(found, 3, 0, t), alongX(0.02, 1.5), 1e-12);
  EXPECT_NEAR(total(found, 2, 0, t), alongX(0.3, 0.0), 1e-12);
}

TEST(LoadsDeck, EndTimeEndsAForce) {
  Teuchos::ParameterList list = deckList();
  entry(list, "Forces", "push")
      .set("Node", 2)
      .set("Component", "u")
      .set("Value", 7.0)
      .set("End Time", 2.0);
  const auto loads = pointLoads(readLoads(list), depths, RotarySpeed());
  EXPECT_EQ(total(loads, 2, 0, 1.9), 7.0);
  EXPECT_EQ(total(loads, 2, 0, 2.1), 0.0);
}

TEST(LoadsDeck, SenselessEntriesAreRefused) {
  const auto refused = [](const char* kind,
                          const std::function<void(Teuchos::ParameterList&)>& fill,
                          const std::string& part) {
    Teuchos::ParameterList list = deckList();
    fill(entry(list, kind, "odd"));
    try {
      readLoads(list);
      FAIL() << part;
    } catch (const DeckError& error) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find(std::string("Loads/") + kind + "/odd"),
                std::string::npos)
          << error.what();
    }
  };
  refused(
      "Unbalance", [](auto& l) { l.set("Moment", 1.0); }, "none of them");
  refused(
      "Unbalance", [](auto& l) { l.set("Node", 1).set("Position", 0.0).set("Moment", 1.0); },
      "both");
  refused(
      "Unbalance", [](auto& l) { l.set("Node", 1); },
      "either Moment, or both Mass and Eccentricity");
  refused(
      "Unbalance", [](auto& l) { l.set("Node", 1).set("Mass", 1.0); }, "either Moment, or both");
  refused(
      "Unbalance",
      [](auto& l) {
        l.set("Node", 1).set("Mass", 1.0).set("Eccentricity", 0.1).set("Moment", 0.1);
      },
      "either Moment");
  refused(
      "Forces", [](auto& l) { l.set("Component", "u").set("Value", 1.0); }, "none of them");
  refused(
      "Forces",
      [](auto& l) {
        l.set("Node", 1)
            .set("Component", "u")
            .set("Value", 1.0)
            .set("Start Time", 2.0)
            .set("End Time", 1.0);
      },
      "ends (End Time) before it starts");
}

TEST(LoadsDeck, Damping) {
  Teuchos::ParameterList list = test::defaultsOf(dampingParameters());
  EXPECT_FALSE(readDamping(list).present());
  list.set("Mass Coefficient", 0.03).set("Stiffness Coefficient", 1e-4);
  EXPECT_EQ(readDamping(list).massCoefficient, 0.03);
  EXPECT_EQ(readDamping(list).stiffnessCoefficient, 1e-4);
  EXPECT_TRUE(readDamping(list).present());
}

/// A push at a measured depth, and a drag below it, as in a load outside the library.
struct Tractor final : Load {
  double depth = 5.0;
  int node = 0;  ///< 0: that at the depth
  std::vector<PointLoad> atNodes(const std::vector<double>& at, const RotarySpeed&) const override {
    if (node != 0) return {{"tractor", node, 0, 7.0}};
    for (std::size_t n = 0; n < at.size(); ++n)
      if (at[n] >= depth) return {{"tractor", static_cast<int>(n) + 1, 0, 7.0}};
    return {};
  }
  std::vector<LineLoad> onElement(const LoadedElement& element, const RotarySpeed&) const override {
    return {{"drag", Vector3(0, 0, element.from >= depth ? -3.0 : 0.0)}};
  }
  std::vector<LoadRemark> describe(const RotarySpeed&) const override { return {}; }
};

TEST(LoadsOfALowerPart, AreAskedByMeasuredDepth) {
  const Loads whole{std::make_shared<Tractor>()};
  const std::vector<double> local{0.0, 1.8, 3.6};
  const Loads lower = below(whole, 3.6);
  const auto points = pointLoads(lower, local, RotarySpeed());
  ASSERT_EQ(points.size(), 1U);
  EXPECT_EQ(points[0].node, 2) << "5.4 m is 1.8 m below the cut";
  EXPECT_EQ(pointLoads(whole, local, RotarySpeed()).size(), 0U);
  const beam::Section section;
  const Matrix3 triad = Matrix3::Identity();
  EXPECT_EQ(steadyBesideWeight(lower, {section, triad, 0.0, 1.8}, RotarySpeed()).z(), 0.0);
  EXPECT_EQ(steadyBesideWeight(lower, {section, triad, 1.8, 3.6}, RotarySpeed()).z(), -3.0);
}

TEST(LoadsOfALowerPart, WeightIsNothingBesideWeight) {
  Teuchos::ParameterList list = deckList();
  list.set("Gravity", 9.81);
  const beam::Section section = beam::Section::hollow(0.06, 0.05, beam::Material());
  const Matrix3 triad = Eigen::AngleAxisd(0.7, Vector3::UnitX()).toRotationMatrix();
  EXPECT_LT(steadyBesideWeight(readLoads(list), {section, triad, 0.0, 1.8}, RotarySpeed()).norm(),
            1e-9);
}

TEST(PointLoads, NodesOutsideTheStringAreRefused) {
  for (const int node : {-3, 6, 100}) {
    auto load = std::make_shared<Tractor>();
    load->node = node;
    EXPECT_THROW(pointLoads({load}, depths, RotarySpeed()), ModelError) << node;
  }
}

}  // namespace LoadsTest
}  // namespace tooljoint::loads
