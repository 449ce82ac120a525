// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Laws with states in small harmonic motions, against their closed forms.
#include "model/HarmonicTangent.hpp"

#include <Teuchos_ParameterList.hpp>
#include <cmath>
#include <gtest/gtest.h>
#include <memory>

#include "model/laws/PointLawRegistry.hpp"
#include "model/laws/RegenerativeCutting.hpp"

namespace HarmonicTangentTest {

using namespace tooljoint;
using namespace tooljoint::model;

std::shared_ptr<const PointLaw> made(const std::string& name,
                                     const std::vector<std::pair<std::string, double>>& values) {
  Teuchos::ParameterList own(name);
  for (const auto& [key, value] : values) own.set(key, value);
  return PointLawRegistry::instance().make(name, own, {1, 1});
}

Complex ofOne(const PointLaw& law, double omega) {
  return tangentByStates(*stateful(law), 0.0, Vector::Zero(1), Vector::Zero(1), omega).front();
}

/// A spring k and a dashpot c in series: f = -k i omega T/(1 + i omega T) d, T = c/k.
TEST(HarmonicTangent, OfMaxwellsElement) {
  const double k = 300, c = 20;
  const auto law = made("Maxwell", {{"Stiffness", k}, {"Damping", c}});
  for (const double omega : {0.1, 15.0, 1e4}) {
    const Complex lag(0, omega * c / k), whole = -k * lag / (1.0 + lag);
    EXPECT_LT(std::abs(-k + ofOne(*law, omega) - whole), 1e-12 * k) << omega;
  }
}

TEST(HarmonicTangent, IsNoneWhereStatesStay) {
  const auto plastic = made("Elastic-Plastic", {{"Stiffness", 1e4}, {"Yield Force", 10}});
  const auto drive = made("Speed Control", {{"Speed", 0.0},
                                            {"Proportional Gain", 50},
                                            {"Integral Gain", 20},
                                            {"Initial Force", 0.0},
                                            {"Force Limit", 100}});
  for (const auto& law : {plastic, drive}) EXPECT_EQ(std::abs(ofOne(*law, 3.0)), 0.0);
}

/// delta = (U - U(t - tau)) - slope (phi - phi(t - tau)): 1 - e^{-i omega tau} of the held tangent.
TEST(HarmonicTangent, OfCuttingHasTheDelayOfAPitch) {
  CuttingParameters p;
  p.blades = 4;
  p.radius = 0.1;
  p.specificEnergy = 50e6;
  p.inclination = 0.6;
  const auto law = std::make_shared<FormulaLaw<RegenerativeCutting>>(RegenerativeCutting(p), 1);
  const Vector d = Vector::Zero(2), v = Eigen::Vector2d(3e-3, 8.0);
  const double K = 4 * 0.1 * 0.6 * 50e6, tau = constants::twoPi / 4 / 8.0, slope = v[0] / v[1];
  for (const double omega : {0.5, 9.0}) {
    const auto change = tangentByStates(*law, 0.0, d, v, omega);
    const Complex back = std::polar(1.0, -omega * tau);
    EXPECT_LT(std::abs(change[0] - K * back), 1e-9 * K);
    EXPECT_LT(std::abs(change[1] + K * slope * back), 1e-9 * K);
  }
  const auto still = tangentByStates(*law, 0.0, d, Vector::Zero(2), 9.0);
  for (const auto& entry : still) EXPECT_EQ(std::abs(entry), 0.0) << "nothing passes the blades";
}

/// Has a delay of unknown length.
struct Unsaid : Formula<1, 0, 1> {
  template <class T>
  void operator()(const PointAt<T>& at, T* f, T*) const {
    f[0] = -100.0 * (at.d[0] - at.held[0]);
  }
  Power power(const PointAt<double>&, const double*) const { return {}; }
};

TEST(HarmonicTangent, NamesTheSetsWhoseStatesMove) {
  SecondOrderModel model;
  model.mass = Sparse(Matrix::Identity(1, 1).sparseView());
  model.initialDisplacement = model.initialVelocity = Vector::Zero(1);
  const auto add = [&](const std::string& name, std::shared_ptr<const PointLaw> law) {
    model.points.push_back({name, std::move(law), {1}, model.mass, Vector::Zero(1)});
  };
  add("slow", made("Maxwell", {{"Stiffness", 300}, {"Damping", 20}}));
  add("yields", made("Elastic-Plastic", {{"Stiffness", 1e4}, {"Yield Force", 10}}));
  add("unsaid", std::make_shared<FormulaLaw<Unsaid>>(Unsaid(), 1));
  EXPECT_EQ(setsWithMovingStates(model, 0.0), (std::vector<std::string>{"slow", "unsaid"}));
  EXPECT_EQ(setsWithUnknownStates(model, 0.0), std::vector<std::string>{"unsaid"});
}

}  // namespace HarmonicTangentTest
