// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "model/laws/Connectors.hpp"
#include "model/laws/Coulomb.hpp"
#include "model/laws/Friction.hpp"
#include "model/laws/HuntCrossley.hpp"
#include "model/laws/PerPoint.hpp"
#include "model/laws/PointLawRegistry.hpp"

namespace tooljoint::model {
namespace {

HuntCrossley contact(const StopParameters& s) { return HuntCrossley(1.0, s.damping, s.smoothing); }

/// Coordinates (separation, tangential displacements); friction only with tangents.
class Stops final : public PerPoint<StopParameters, Stops>, public Frictional {
 public:
  Stops(const std::vector<StopParameters>& points, int tangents)
      : PerPoint(points), tangents_(tangents) {
    for (const auto& s : points) {
      require(s.stiffness > 0, "stiffness of a stop", s.stiffness, "positive");
      require(s.damping >= 0, "damping of a stop", s.damping, "zero or positive");
      require(s.smoothing >= 0, "smoothing of a stop", s.smoothing, "zero or positive");
      require(s.friction >= 0, "friction of a stop", s.friction, "zero or positive");
      require(s.slipVelocity > 0, "slip velocity of a stop", s.slipVelocity, "positive");
    }
  }
  int width() const override { return 1 + tangents_; }

  void evaluate(double, const std::vector<int>& active, const double* d, const double* v,
                double* f) const override {
    const int w = width();
    for (int p : active) {
      const double n = f[p * w] = normal(p, d[p * w], v[p * w]).value;
      const auto slip = sliding(p, v);
      for (int t = 0; t < tangents_; ++t) f[p * w + 1 + t] = slip.force(t, at(p).friction * n);
    }
  }

  void evaluateWithTangent(double, const std::vector<int>& active, const double* d, const double* v,
                           double* f, double* dfdd, double* dfdv) const override {
    const int w = width();
    for (int p : active) {
      const double mu = at(p).friction;
      const NormalForce n = normal(p, d[p * w], v[p * w]);
      const auto slip = sliding(p, v);
      double* K = dfdd + p * w * w;
      double* C = dfdv + p * w * w;
      std::fill(K, K + w * w, 0.0);
      std::fill(C, C + w * w, 0.0);
      // the penetration is -(d + gap)
      f[p * w] = n.value;
      K[0] = -n.dG;
      C[0] = -n.dRate;
      for (int t = 0; t < tangents_; ++t) {
        f[p * w + 1 + t] = slip.force(t, mu * n.value);
        K[(1 + t) * w] = -(mu * n.dG) * slip.direction(t);
        C[(1 + t) * w] = -(mu * n.dRate) * slip.direction(t);
        for (int u = 0; u < tangents_; ++u) C[(1 + t) * w + 1 + u] = slip.slope(t, u, mu * n.value);
      }
    }
  }

  std::shared_ptr<const PointLaw> withoutFriction() const override {
    auto smooth = points_;
    bool rough = false;
    for (auto& s : smooth) rough = rough || std::exchange(s.friction, 0.0) > 0.0;
    return rough ? std::make_shared<Stops>(smooth, tangents_) : nullptr;
  }

  int reach() const override { return 1; }
  void clearanceLeft(const std::vector<int>& points, const double* d, double* gap) const override {
    for (int p : points) gap[p] = d[p * width()] + at(p).gap - at(p).smoothing;
  }

  Power power(double, const std::vector<int>& points, const double* d,
              const double* v) const override {
    Power sum;
    const int w = width();
    for (int p : points) {
      const auto& s = at(p);
      const double depth = -(d[p * w] + s.gap), rate = -v[p * w];
      const double n = normal(p, d[p * w], v[p * w]).value;
      double slope = 0;
      sum.stored += contact(s).energy(s.stiffness, depth);
      sum.damping += (n - contact(s).elastic(s.stiffness, depth, slope)) * rate;
      const auto slip = sliding(p, v);
      for (int t = 0; t < tangents_; ++t) sum.friction += slip.loss(t, s.friction * n);
    }
    return sum;
  }

  double drive(double, const std::vector<int>&, const double*) const override { return 0; }

  std::vector<Channel> channels() const override {
    std::vector<Channel> list{
        {"stop_force", "N", "Force of the stop, positive when it pushes its sides apart"},
        {"stop_gap", "m", "Distance left at the stop, negative when it is met"}};
    if (tangents_ > 0)
      list.push_back({"friction_force", "N", "Friction force in the plane of the stop"});
    return list;
  }
  void record(double, const double* d, const double* v, double* out) const override {
    const int w = width(), n = size();
    for (int p = 0; p < n; ++p) {
      const auto& s = at(p);
      const double force = normal(p, d[p * w], v[p * w]).value;
      out[p] = force;
      out[n + p] = d[p * w] + s.gap;
      if (tangents_ == 0) continue;
      const double size = sliding(p, v).size();
      out[2 * n + p] = s.friction * force *
                       std::sqrt(std::max(0.0, size * size - s.slipVelocity * s.slipVelocity)) /
                       size;
    }
  }

 private:
  NormalForce normal(int p, double d, double v) const {
    const auto& s = at(p);
    return contact(s).force(s.stiffness, -(d + s.gap), -v);
  }
  SmoothedSliding sliding(int p, const double* v) const {
    return {v + p * width() + 1, tangents_, at(p).slipVelocity};
  }
  int tangents_;
};

std::unique_ptr<PointLaw> makeStop(const Teuchos::ParameterList& own, const PointLawPlace& place) {
  StopParameters stop;
  stop.gap = own.get<double>("Gap");
  stop.stiffness = own.get<double>("Stiffness");
  stop.damping = own.get<double>("Damping");
  stop.smoothing = own.get<double>("Smoothing");
  stop.friction = own.get<double>("Friction");
  stop.slipVelocity = own.get<double>("Slip Velocity");
  const std::vector<StopParameters> points(static_cast<std::size_t>(place.points), stop);
  if (!(stop.friction > 0)) return stops(points);
  if (place.coordinates < 2)
    throw DeckError(own.name() + "/Friction needs a Direction: friction acts across it. Give one.");
  return slidingStops(points, place.coordinates - 1);
}

const bool stopRegistered = PointLawRegistry::instance().add(
    "Stop",
    {"A one-sided contact (Hunt and Crossley 1975) with Coulomb friction across it.",
     deck::ListSpec("Stop", "A stop that is met when the separation falls to minus the gap.")
         .real("Gap", "m", 0.0, deck::Range::any(),
               "Separation left in the reference state; negative: pressed together.")
         .real("Stiffness", "N/m", deck::Required{}, deck::Range::positive(), "Contact stiffness.")
         .real("Damping", "s/m", 0.0, deck::Range::nonNegative(),
               "Damping factor of Hunt and Crossley (1975).")
         .real("Smoothing", "m", 0.0, deck::Range::nonNegative(),
               "Half width of the quadratic transition at touch.")
         .expert()
         .real("Friction", "", 0.0, deck::Range::nonNegative(),
               "Coulomb friction coefficient across the direction; 0: none. Needs a "
               "Direction.")
         .real("Slip Velocity", "m/s", 1e-3, deck::Range::positive(),
               "Regularisation velocity of the friction.")
         .expert(),
     makeStop});

}  // namespace

std::unique_ptr<PointLaw> stops(const std::vector<StopParameters>& points) {
  return std::make_unique<Stops>(points, 0);
}

std::unique_ptr<PointLaw> slidingStops(const std::vector<StopParameters>& points, int tangents) {
  if (tangents < 1 || tangents > 2)
    throw ModelError("A sliding stop has one or two tangential coordinates; " +
                     std::to_string(tangents) + " were requested.");
  return std::make_unique<Stops>(points, tangents);
}

}  // namespace tooljoint::model
