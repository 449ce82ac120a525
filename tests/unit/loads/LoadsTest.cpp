// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Loads: the unbalance force against the momentum of the mass it comes from, directions of weight
/// and torque on bit, nodal forces in time, places by number and by depth, and what decks are
/// refused.
#include "substructures/loads/Loads.hpp"

#include <Teuchos_Array.hpp>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "common/report/EvaluationCounters.hpp"
#include "common/report/Log.hpp"
#include "tests/support/ListDefaults.hpp"

namespace tooljoint::loads {
namespace {

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

LoadsData unbalanced(double moment, double phase) {
  LoadsData loads;
  loads.unbalances.push_back({"off axis", {3, std::nullopt}, moment, phase});
  return loads;
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
/// string feels the opposite.
TEST(Unbalance, IsTheRateOfChangeOfTheMomentumOfTheMass) {
  const double moment = 0.7;
  const double phase = 0.9;
  const RotarySpeed rotary = turning();
  const auto loads = pointLoads(unbalanced(moment, phase), rotary, depths);
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
  const auto loads = pointLoads(unbalanced(0.5, 0.0), rotary, depths);
  const double t = 30.0;
  EXPECT_NEAR(std::hypot(total(loads, 3, 0, t), total(loads, 3, 1, t)), 0.5 * 144.0, 1e-9);
  EXPECT_NEAR(std::atan2(total(loads, 3, 1, t), total(loads, 3, 0, t)),
              std::remainder(rotary.angle(t), constants::twoPi), 1e-9);
}

TEST(Unbalance, AllShareTwoLawsWhateverTheirPhase) {
  LoadsData loads = unbalanced(0.5, 0.3);
  loads.unbalances.push_back({"other", {2, std::nullopt}, 0.1, -2.0});
  model::SecondOrderModel model;
  for (int node = 1; node <= 5; ++node)
    for (int c = 0; c < 6; ++c) model.dofs.push_back(model::DofLabel::physical(node, c));
  addTo(model, pointLoads(loads, turning(), depths));
  EXPECT_EQ(model.laws.size(), 3U);
  EXPECT_EQ(model.loads.size(), 2U);
}

TEST(Unbalance, WithoutRotationIsLeftOutWithAWarning) {
  log::clearWarnings();
  resetEvaluationCounters();
  EXPECT_TRUE(pointLoads(unbalanced(0.5, 0.0), RotarySpeed(), depths).empty());
  ASSERT_EQ(log::warnings().size(), 1U);
  EXPECT_NE(log::warnings()[0].find("nothing turns"), std::string::npos);
  EXPECT_EQ(counted("unbalance loads"), 0);
  pointLoads(unbalanced(0.5, 0.0), turning(), depths);
  EXPECT_EQ(counted("unbalance loads"), 1);
  log::clearWarnings();
  resetEvaluationCounters();
}

// -------------------------------------------------------------------------------------------------
// bit loads

TEST(BitLoads, WeightPushesUpAndTorqueResists) {
  LoadsData loads;
  loads.weightOnBit = 1e4;
  loads.torqueOnBit = 5000.0;
  const auto list = pointLoads(loads, RotarySpeed(), depths);
  EXPECT_EQ(list.size(), 2U);
  EXPECT_EQ(total(list, 5, 2, 0.0), -1e4);
  EXPECT_EQ(total(list, 5, 5, 3.0), -5000.0);
  for (const auto& load : list) EXPECT_EQ(load.law.name, "1");
}

TEST(BitLoads, NoneWithoutNumbers) {
  EXPECT_TRUE(pointLoads(LoadsData(), turning(), depths).empty());
}

// -------------------------------------------------------------------------------------------------
// nodal forces

NodalForce force(double frequency, double phase, double start, double end) {
  return {"push", {2, std::nullopt}, 1, 100.0, frequency, phase, start, end};
}

const double never = std::numeric_limits<double>::infinity();

TEST(NodalForces, SteadyOneIsAStaticLoad) {
  LoadsData loads;
  loads.forces.push_back(force(0.0, 0.7, 0.0, never));
  const auto list = pointLoads(loads, RotarySpeed(), depths);
  ASSERT_EQ(list.size(), 1U);
  EXPECT_EQ(list[0].law.name, "1");
  EXPECT_EQ(total(list, 2, 1, 5.0), 100.0);
}

TEST(NodalForces, HarmonicAndWindowed) {
  LoadsData loads;
  loads.forces.push_back(force(2.0, 0.5, 1.0, 3.0));
  const auto list = pointLoads(loads, RotarySpeed(), depths);
  EXPECT_EQ(total(list, 2, 1, 0.999), 0.0);
  EXPECT_NEAR(total(list, 2, 1, 1.3), 100.0 * std::cos(4.0 * constants::pi * 1.3 + 0.5), 1e-12);
  EXPECT_EQ(total(list, 2, 1, 3.0), 0.0);
}

TEST(NodalForces, EqualLawsAreOneAndDifferentOnesAreNot) {
  LoadsData loads;
  loads.forces = {force(2.0, 0.5, 0.0, never), force(2.0, 0.5, 0.0, never),
                  force(2.0, 0.6, 0.0, never), force(2.0, 0.5, 0.0, 1.0),
                  force(2.0, 0.5, 0.5, never), force(3.0, 0.5, 0.0, never)};
  model::SecondOrderModel model;
  for (int c = 0; c < 6; ++c) model.dofs.push_back(model::DofLabel::physical(2, c));
  addTo(model, pointLoads(loads, RotarySpeed(), depths));
  EXPECT_EQ(model.laws.size(), 6U);  // "1" and five
  EXPECT_NEAR(model.loads[0].vector[1], 200.0, 1e-12);
}

TEST(NodalForces, HeldDofsTakeNoLoad) {
  LoadsData loads;
  loads.forces.push_back(force(0.0, 0.0, 0.0, never));
  model::SecondOrderModel model;
  model.dofs = {model::DofLabel::physical(2, 0), model::DofLabel::physical(3, 1)};
  addTo(model, pointLoads(loads, RotarySpeed(), depths));
  EXPECT_TRUE(model.loads.empty());
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

Teuchos::ParameterList deckList() { return test::defaultsOf(parameters()); }

Teuchos::ParameterList& entry(Teuchos::ParameterList& loads, const char* kind, const char* name) {
  Teuchos::ParameterList& list = loads.sublist(kind).sublist(name);
  list.setParameters(test::defaultsOf(*parameters().findList(kind)->pattern()));
  return list;
}

TEST(LoadsDeck, GravityIsThereUnlessSwitchedOff) {
  Teuchos::ParameterList list = deckList();
  EXPECT_EQ(readLoads(list).gravity, 9.81);
  list.set("Gravity", 0.0);
  EXPECT_EQ(readLoads(list).gravity, 0.0);
  EXPECT_EQ(LoadsData().gravity, 0.0);  // no list, no weight
}

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
  const LoadsData loads = readLoads(list);
  EXPECT_EQ(loads.weightOnBit, 1e4);
  EXPECT_EQ(loads.torqueOnBit, 5000.0);
  ASSERT_EQ(loads.unbalances.size(), 2U);
  EXPECT_DOUBLE_EQ(loads.unbalances[0].moment, 0.02);
  EXPECT_EQ(loads.unbalances[0].phase, 1.5);
  EXPECT_EQ(loads.unbalances[1].moment, 0.3);
  EXPECT_EQ(loads.unbalances[1].place.position, 1.8);
  ASSERT_EQ(loads.forces.size(), 1U);
  EXPECT_EQ(loads.forces[0].component, 4);
  EXPECT_EQ(loads.forces[0].value, 7.0);
  EXPECT_EQ(loads.forces[0].frequency, 3.0);
  EXPECT_EQ(loads.forces[0].phase, 0.2);
  EXPECT_EQ(loads.forces[0].startTime, 1.0);
  EXPECT_TRUE(std::isinf(loads.forces[0].endTime));
}

TEST(LoadsDeck, EndTimeEndsAForce) {
  Teuchos::ParameterList list = deckList();
  entry(list, "Forces", "push")
      .set("Node", 2)
      .set("Component", "u")
      .set("Value", 7.0)
      .set("End Time", 2.0);
  const auto loads = pointLoads(readLoads(list), RotarySpeed(), depths);
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

}  // namespace
}  // namespace tooljoint::loads
