// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Rotary speed laws: each against finite differences and quadrature, and against numbers computed
/// by hand.
#include "substructures/loads/RotarySpeed.hpp"

#include <Teuchos_Array.hpp>
#include <cmath>
#include <complex>
#include <functional>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "model/SpeedLaw.hpp"
#include "tests/support/ListDefaults.hpp"

namespace tooljoint::loads {
namespace RotarySpeedTest {

using constants::pi;
using constants::rpm;

Teuchos::ParameterList law(const std::string& name,
                           const std::function<void(Teuchos::ParameterList&)>& fill) {
  Teuchos::ParameterList list("Rotary Speed");
  list.set("Law", name);
  Teuchos::ParameterList own = test::defaultsOf(SpeedLaws::instance().find(name).parameters);
  fill(own);
  list.sublist(name) = own;
  return list;
}

RotarySpeed exponential() {
  return RotarySpeed(law("Exponential", [](auto& l) {
    l.set("Final Speed", 120.0 * rpm);
    l.set("Time Constant", 1.0 / 6.0);
  }));
}

Teuchos::ParameterList ramp(bool smooth) {
  return law("Ramp", [smooth](auto& l) {
    l.set("Initial Speed", 2.0);
    l.set("Final Speed", -3.0);
    l.set("Start Time", 0.5);
    l.set("Duration", 1.5);
    l.set("Smooth", smooth);
  });
}

Teuchos::ParameterList table(const std::string& interpolation) {
  return law("Table", [&](auto& l) {
    l.set("Times", Teuchos::Array<double>(std::vector<double>{0.4, 1.0, 1.7, 2.0, 3.1}));
    l.set("Speeds", Teuchos::Array<double>(std::vector<double>{1.0, 5.0, 6.0, 6.0, -4.0}));
    l.set("Interpolation", interpolation);
  });
}

struct Case {
  std::string name;
  std::function<RotarySpeed()> make;
  std::vector<double> corners;  ///< times at which dOmega/dt may jump
};

std::vector<Case> allLaws() {
  return {
      {"Constant",
       [] { return RotarySpeed(law("Constant", [](auto& l) { l.set("Speed", -7.0); })); },
       {}},
      {"Exponential", exponential, {}},
      {"Ramp", [] { return RotarySpeed(ramp(false)); }, {0.5, 2.0}},
      {"smooth Ramp", [] { return RotarySpeed(ramp(true)); }, {}},
      {"Harmonic",
       [] {
         return RotarySpeed(law("Harmonic", [](auto& l) {
           l.set("Mean Speed", 3.0);
           l.set("Amplitude", 5.0);
           l.set("Frequency", 0.7);
           l.set("Phase", 0.4);
         }));
       },
       {}},
      {"linear Table", [] { return RotarySpeed(table("Linear")); }, {0.4, 1.0, 1.7, 2.0, 3.1}},
      {"cubic Table", [] { return RotarySpeed(table("Monotone cubic")); }, {}},
  };
}

TEST(SpeedLaw, AccelerationIsTheDerivative) {
  const double h = 1e-5;
  for (const auto& one : allLaws()) {
    const RotarySpeed r = one.make();
    for (double t = 0.0113; t < 4.0; t += 0.037) {
      bool nearCorner = false;
      for (double corner : one.corners) nearCorner = nearCorner || std::abs(t - corner) < 2.0 * h;
      if (nearCorner) continue;
      EXPECT_NEAR(r.acceleration(t), (r.speed(t + h) - r.speed(t - h)) / (2.0 * h), 2e-6)
          << one.name << " at " << t;
    }
  }
}

TEST(SpeedLaw, AngleIsTheIntegral) {
  for (const auto& one : allLaws()) {
    const RotarySpeed r = one.make();
    EXPECT_EQ(r.angle(0.0), 0.0) << one.name;
    double integral = 0.0;
    const double h = 1e-4;  // error of the midpoint rule: h^2/24 max|Omega''| T, below 1e-6
    for (int i = 0; i < 40000; ++i) {
      integral += h * r.speed((i + 0.5) * h);
      if (i % 1999 == 0) {
        EXPECT_NEAR(r.angle((i + 1) * h), integral, 1e-6) << one.name << " at " << (i + 1) * h;
      }
    }
  }
}

TEST(SpeedLaw, SpeedIsContinuous) {
  for (const auto& one : allLaws()) {
    const RotarySpeed r = one.make();
    for (double t = 1e-3; t < 4.0; t += 1e-3) {
      EXPECT_NEAR(r.speed(t), r.speed(t - 1e-3), 0.08) << one.name << " at " << t;
      EXPECT_NEAR(r.angle(t), r.angle(t - 1e-3), 0.02) << one.name << " at " << t;
    }
  }
}

TEST(SpeedLaw, SmoothLawsHaveContinuousAcceleration) {
  for (const auto& one : allLaws()) {
    if (!one.corners.empty()) continue;
    const RotarySpeed r = one.make();
    for (double t = 1e-3; t < 4.0; t += 1e-3) {
      EXPECT_NEAR(r.acceleration(t), r.acceleration(t - 1e-3), 0.5) << one.name << " at " << t;
    }
  }
}

/// Omega = 120 - 120 exp(-6 t) rpm, section 5.3 of Nguyen et al. 2020.
TEST(SpeedLaw, ReferenceStart) {
  const RotarySpeed r = exponential();
  for (double t : {0.0, 0.01, 0.5, 3.0, 20.0})
    EXPECT_NEAR(r.speed(t) / rpm, 120.0 - 120.0 * std::exp(-6.0 * t), 1e-12);
  EXPECT_NEAR(r.acceleration(0.0), 720.0 * rpm, 1e-10);
  EXPECT_NEAR(r.angle(20.0), 120.0 * rpm * (20.0 - 1.0 / 6.0), 1e-9);
}

TEST(SpeedLaw, RampHolds) {
  for (bool smooth : {false, true}) {
    const RotarySpeed r{ramp(smooth)};
    EXPECT_EQ(r.speed(0.2), 2.0);
    EXPECT_DOUBLE_EQ(r.speed(1.25), -0.5);
    EXPECT_EQ(r.speed(5.0), -3.0);
    EXPECT_EQ(r.acceleration(5.0), 0.0);
    EXPECT_DOUBLE_EQ(r.angle(4.0), 2.0 * 0.5 + 1.5 * (-0.5) + 2.0 * (-3.0));
  }
}

TEST(SpeedLaw, TablePassesThroughItsEntriesWithoutOvershoot) {
  for (const char* interpolation : {"Linear", "Monotone cubic"}) {
    const RotarySpeed r(table(interpolation));
    const std::vector<double> times{0.4, 1.0, 1.7, 2.0, 3.1};
    const std::vector<double> speeds{1.0, 5.0, 6.0, 6.0, -4.0};
    for (std::size_t i = 0; i < times.size(); ++i)
      EXPECT_NEAR(r.speed(times[i]), speeds[i], 1e-13) << interpolation;
    for (double t = 0.0; t < 4.0; t += 1e-3) {
      EXPECT_LE(r.speed(t), 6.0 + 1e-12) << interpolation;
      EXPECT_GE(r.speed(t), -4.0 - 1e-12) << interpolation;
    }
    EXPECT_EQ(r.speed(0.1), 1.0);
    EXPECT_EQ(r.speed(9.0), -4.0);
  }
}

/// Between two rises the slope is their weighted harmonic mean (Fritsch and Butland 1984, Brodlie's
/// weights), 0 at a level stretch, a summit and both ends.
TEST(SpeedLaw, MonotoneTableHasTheSlopesOfItsFormula) {
  const RotarySpeed r(table("Monotone cubic"));
  const double before = 4.0 / 0.6, after = 1.0 / 0.7;  // rises on both sides of t = 1 s
  const double w0 = 2.0 * 0.7 + 0.6, w1 = 0.7 + 2.0 * 0.6;
  const double slope = (w0 + w1) / (w0 / before + w1 / after);
  EXPECT_NEAR(r.acceleration(1.0), slope, 1e-9);
  EXPECT_NEAR(r.acceleration(1.0 - 1e-9), slope, 1e-6);
  for (const double t : {0.4, 1.7, 2.0}) EXPECT_NEAR(r.acceleration(t), 0.0, 1e-9) << t;
}

TEST(SpeedLaw, TableOfOneEntryIsConstant) {
  const RotarySpeed r(law("Table", [](auto& l) {
    l.set("Times", Teuchos::Array<double>(std::vector<double>{1.0}));
    l.set("Speeds", Teuchos::Array<double>(std::vector<double>{4.0}));
  }));
  EXPECT_EQ(r.speed(0.0), 4.0);
  EXPECT_DOUBLE_EQ(r.angle(2.5), 10.0);
}

/// Each parameter of each law changes the result in the expected direction.
TEST(SpeedLaw, EachParameterCounts) {
  const auto with = [](const std::string& name, const std::string& parameter, double value) {
    Teuchos::ParameterList list = name == "Ramp"       ? ramp(false)
                                  : name == "Harmonic" ? law(name,
                                                             [](auto& l) {
                                                               l.set("Mean Speed", 3.0);
                                                               l.set("Amplitude", 5.0);
                                                               l.set("Frequency", 0.1);
                                                             })
                                                       : law(name, [](auto& l) {
                                                           l.set("Final Speed", 10.0);
                                                           l.set("Time Constant", 1.0);
                                                         });
    if (!parameter.empty()) list.sublist(name).set(parameter, value);
    return RotarySpeed(list).speed(1.0);
  };
  const double start = with("Exponential", "", 0.0);
  EXPECT_GT(with("Exponential", "Final Speed", 12.0), start);
  EXPECT_GT(with("Exponential", "Initial Speed", 1.0), start);
  EXPECT_LT(with("Exponential", "Time Constant", 2.0), start);
  const double falling = with("Ramp", "", 0.0);
  EXPECT_GT(with("Ramp", "Initial Speed", 3.0), falling);
  EXPECT_GT(with("Ramp", "Final Speed", -2.0), falling);
  EXPECT_GT(with("Ramp", "Start Time", 0.8), falling);
  EXPECT_GT(with("Ramp", "Duration", 2.0), falling);
  EXPECT_NE(RotarySpeed(ramp(true)).speed(1.0), falling);
  const double wave = with("Harmonic", "", 0.0);
  EXPECT_GT(with("Harmonic", "Mean Speed", 4.0), wave);
  EXPECT_GT(with("Harmonic", "Amplitude", 6.0), wave);
  EXPECT_GT(with("Harmonic", "Frequency", 0.15), wave);
  EXPECT_GT(with("Harmonic", "Phase", 0.2), wave);
  EXPECT_GT(std::abs(RotarySpeed(table("Linear")).speed(0.6) -
                     RotarySpeed(table("Monotone cubic")).speed(0.6)),
            0.01);
}

// -------------------------------------------------------------------------------------------------
// the deck

TEST(RotarySpeedDeck, WithoutTheListNothingTurns) {
  const RotarySpeed none = RotarySpeed::fromDeck(Teuchos::ParameterList("Scene"));
  EXPECT_FALSE(none.present());
  EXPECT_EQ(none.speed(3.0), 0.0);
  EXPECT_EQ(none.angle(3.0), 0.0);
  Teuchos::ParameterList deck("Scene");
  deck.sublist("Rotary Speed") = law("Constant", [](auto& l) { l.set("Speed", 2.0); });
  EXPECT_TRUE(RotarySpeed::fromDeck(deck).present());
  EXPECT_EQ(RotarySpeed::fromDeck(deck).speed(3.0), 2.0);
}

TEST(RotarySpeedDeck, EveryLawIsDescribed) {
  const deck::ListSpec spec = rotarySpeedParameters();
  EXPECT_EQ(spec.findParameter("Law")->choices,
            (std::vector<std::string>{"Constant", "Exponential", "Harmonic", "Ramp", "Table"}));
  for (const auto& name : spec.findParameter("Law")->choices) {
    ASSERT_NE(spec.findList(name), nullptr) << name;
    EXPECT_FALSE(spec.findList(name)->doc().empty());
    for (const auto& parameter : spec.findList(name)->parameters())
      EXPECT_FALSE(parameter.doc.empty()) << parameter.name;
  }
}

void expectRefused(const Teuchos::ParameterList& list, const std::string& part) {
  try {
    const RotarySpeed speed(list);
    FAIL() << "accepted, should say: " << part;
  } catch (const DeckError& error) {
    EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
}

TEST(RotarySpeedDeck, SenselessTablesAreRefused) {
  const auto filled = [](std::vector<double> times, std::vector<double> speeds) {
    return law("Table", [&](auto& l) {
      l.set("Times", Teuchos::Array<double>(times));
      l.set("Speeds", Teuchos::Array<double>(speeds));
    });
  };
  expectRefused(filled({0.0, 1.0}, {1.0}), "2 Times and 1 Speeds");
  expectRefused(filled({}, {}), "at least one time");
  expectRefused(filled({0.0, 2.0, 2.0}, {1.0, 2.0, 3.0}), "entry 3 does not follow entry 2");
  expectRefused(filled({-1.0, 2.0}, {1.0, 2.0}), "before time 0");
}

TEST(RotarySpeedDeck, LawWithoutItsNumbersIsRefused) {
  Teuchos::ParameterList list("Rotary Speed");
  list.set("Law", "Ramp");
  expectRefused(list, "the list \"Ramp\" with its numbers is missing");
}

TEST(RotarySpeedLaws, NamedLawsFollowTheSpeed) {
  const RotarySpeed r{ramp(true)};
  const double t = 1.9;  // Omega < 0 here
  const double omega = r.speed(t);
  ASSERT_LT(omega, 0.0);
  EXPECT_EQ(r.scalar("1").value(t), 1.0);
  EXPECT_EQ(r.scalar("Omega").value(t), omega);
  EXPECT_EQ(r.scalar("sqrt|Omega|").value(t), std::sqrt(-omega));
  EXPECT_EQ(r.scalar("Omega^2").value(t), omega * omega);
  EXPECT_EQ(r.scalar("Omega sqrt|Omega|").value(t), omega * std::sqrt(-omega));
  EXPECT_EQ(r.scalar("dOmega/dt").value(t), r.acceleration(t));
  EXPECT_EQ(r.scalar("dOmega/dt").name, "dOmega/dt");
  EXPECT_THROW(r.scalar("Omega^3"), Error);
}

TEST(RotarySpeedLaws, OutliveTheObjectTheyCameFrom) {
  model::ScalarLaw omega;
  {
    const RotarySpeed r = exponential();
    omega = r.scalar("Omega");
  }
  EXPECT_NEAR(omega.value(100.0), 120.0 * rpm, 1e-12);
}

/// The sense of the first rotation, however late and however short it is.
TEST(RotarySpeed, KnowsTheSenseOfTheFirstRotation) {
  EXPECT_EQ(RotarySpeed().sense(0.0), 0.0);
  EXPECT_EQ(exponential().sense(0.0), 1.0);
  EXPECT_EQ(RotarySpeed(law("Constant", [](auto& l) { l.set("Speed", 0.0); })).sense(0.0), 0.0);
  EXPECT_EQ(RotarySpeed(law("Constant", [](auto& l) { l.set("Speed", -1.0); })).sense(0.0), -1.0);
  const auto lateRamp = [](double to, bool smooth) {
    return RotarySpeed(law("Ramp", [&](auto& l) {
      l.set("Initial Speed", 0.0);
      l.set("Final Speed", to);
      l.set("Start Time", 1000.0);
      l.set("Duration", 2.0);
      l.set("Smooth", smooth);
    }));
  };
  EXPECT_EQ(lateRamp(-3.0, true).sense(0.0), -1.0);
  EXPECT_EQ(lateRamp(3.0, false).sense(0.0), 1.0);
  EXPECT_EQ(lateRamp(0.0, true).sense(0.0), 0.0);
  const auto pulse = RotarySpeed(law("Table", [](auto& l) {
    l.set("Times",
          Teuchos::Array<double>(std::vector<double>{0.0, 70.0, 70.01, 70.02, 90.0, 91.0}));
    l.set("Speeds", Teuchos::Array<double>(std::vector<double>{0.0, 0.0, -1e-3, 0.0, 0.0, 5.0}));
  }));
  EXPECT_EQ(pulse.sense(0.0), -1.0);
  EXPECT_EQ(pulse.sense(70.02), 1.0);
  EXPECT_EQ(RotarySpeed(law("Harmonic",
                            [](auto& l) {
                              l.set("Mean Speed", 0.0);
                              l.set("Amplitude", 2.0);
                              l.set("Frequency", 0.01);
                              l.set("Phase", 0.0);
                            }))
                .sense(0.0),
            1.0);
}

/// sin(pi) is 1.2e-16 in floating point, and the speed decreases from this value.
TEST(RotarySpeed, DoesNotTakeRoundingForTheFirstRotation) {
  EXPECT_EQ(RotarySpeed(law("Harmonic",
                            [](auto& l) {
                              l.set("Mean Speed", 0.0);
                              l.set("Amplitude", 2.0);
                              l.set("Frequency", 0.5);
                              l.set("Phase", pi);
                            }))
                .sense(0.0),
            -1.0);
}

// Re(steady exp(i order Omega t)) is the law itself where the speed is constant.
TEST(SpeedLaw, SteadyFormsAreTheLawsAtAConstantSpeed) {
  const double omega = 3.0;
  const RotarySpeed rotary(law("Constant", [&](auto& l) { l.set("Speed", omega); }));
  for (const std::string name : {"Omega", "sqrt|Omega|", "Omega^2", "Omega sqrt|Omega|",
                                 "dOmega/dt", unbalanceCosine, unbalanceSine}) {
    const auto scalar = rotary.scalar(name);
    const auto* steady = model::speedLaw(scalar);
    ASSERT_NE(steady, nullptr) << name;
    for (const double t : {0.0, 0.3, 1.1})
      EXPECT_NEAR(scalar.value(t),
                  (steady->steady(omega) * std::polar(1.0, steady->order * omega * t)).real(),
                  1e-14)
          << name;
  }
  EXPECT_EQ(model::speedLaw(model::ScalarLaw::one()), nullptr);
}

}  // namespace RotarySpeedTest
}  // namespace tooljoint::loads
