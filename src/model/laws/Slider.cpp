// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "model/laws/Connectors.hpp"
#include "model/laws/Coulomb.hpp"
#include "model/laws/PerPoint.hpp"
#include "model/laws/PointLawRegistry.hpp"

namespace tooljoint::model {
namespace {

/// f = -F v / sqrt(v^2 + v_r^2)
class Frictions final : public PerPoint<FrictionParameters, Frictions> {
 public:
  bool hasWalls() const override { return false; }
  explicit Frictions(const std::vector<FrictionParameters>& points) : PerPoint(points) {
    for (const auto& s : points) {
      require(s.force >= 0, "force of a friction", s.force, "zero or positive");
      require(s.slipVelocity > 0, "slip velocity of a friction", s.slipVelocity, "positive");
    }
  }
  void evaluate(double, const std::vector<int>& active, const double*, const double* v,
                double* f) const override {
    for (int p : active) f[p] = force(p, v);
  }
  void evaluateWithTangent(double, const std::vector<int>& active, const double*, const double* v,
                           double* f, double* dfdd, double* dfdv) const override {
    for (int p : active) {
      f[p] = force(p, v);
      dfdd[p] = 0.0;
      dfdv[p] = sliding(p, v).slope(0, 0, at(p).force);
    }
  }
  Power power(double, const std::vector<int>& points, const double*,
              const double* v) const override {
    Power sum;
    for (int p : points) sum.friction -= force(p, v) * v[p];
    return sum;
  }
  std::vector<Channel> channels() const override {
    return {{"friction_force", "N", "Friction force along its coordinate"}};
  }
  void record(double, const double*, const double* v, double* out) const override {
    for (int p = 0; p < size(); ++p) out[p] = force(p, v);
  }

 private:
  SmoothedSliding sliding(int p, const double* v) const { return {v + p, 1, at(p).slipVelocity}; }
  double force(int p, const double* v) const { return sliding(p, v).force(0, at(p).force); }
};

std::unique_ptr<PointLaw> makeSlider(const Teuchos::ParameterList& own,
                                     const PointLawPlace& place) {
  const FrictionParameters friction{own.get<double>("Force"), own.get<double>("Slip Velocity")};
  return frictions(
      std::vector<FrictionParameters>(static_cast<std::size_t>(place.points), friction));
}

const bool sliderRegistered = PointLawRegistry::instance().add(
    "Slider",
    {"Coulomb friction of constant size.",
     deck::ListSpec("Slider",
                    "Coulomb friction of constant size, f = -Force v / sqrt(v^2 + v_r^2): a "
                    "slider at rest creeps.")
         .real("Force", "N", deck::Required{}, deck::Range::positive(),
               "Sliding force, or moment about a rotation.")
         .real("Slip Velocity", "m/s", 1e-3, deck::Range::positive(),
               "Regularisation velocity v_r.")
         .expert(),
     makeSlider});

}  // namespace

std::unique_ptr<PointLaw> frictions(const std::vector<FrictionParameters>& points) {
  return std::make_unique<Frictions>(points);
}

}  // namespace tooljoint::model
