// SPDX-License-Identifier: BSD-3-Clause
#include "coupling/input/PointLaws.hpp"

#include <cmath>
#include <utility>

#include "common/Error.hpp"
#include "common/Index.hpp"
#include "common/Indexing.hpp"
#include "common/Text.hpp"
#include "model/Friction.hpp"

namespace tooljoint::coupling {

namespace {

using model::Channel;

void require(bool good, const std::string& what, double found, const std::string& expected) {
  if (!good)
    throw ModelError("The " + what + " is " + formatNumber(found) + "; it must be " + expected +
                     ".");
}

/// A batch of points of one kind, each with its own parameters.
template <class Parameters, class Law>
class Batch : public model::PointLaw {
 public:
  explicit Batch(std::vector<Parameters> points) : points_(std::move(points)) {}
  int size() const override { return static_cast<int>(points_.size()); }
  int width() const override { return 1; }
  std::shared_ptr<const model::PointLaw> subset(const std::vector<int>& points) const override {
    auto copy = std::make_shared<Law>(static_cast<const Law&>(*this));
    copy->points_.clear();
    for (int p : points) copy->points_.push_back(points_[at(p)]);
    return copy;
  }

 protected:
  std::vector<Parameters> points_;
};

/// f = -k d - k3 d^3 - c v
class Springs final : public Batch<SpringParameters, Springs> {
 public:
  using Batch::Batch;
  void evaluate(double, const std::vector<int>& active, const double* d, const double* v,
                double* f) const override {
    for (int p : active) f[p] = force(p, d[p], v[p]);
  }
  void evaluateWithTangent(double, const std::vector<int>& active, const double* d, const double* v,
                           double* f, double* dfdd, double* dfdv) const override {
    for (int p : active) {
      const auto& s = points_[at(p)];
      f[p] = force(p, d[p], v[p]);
      dfdd[p] = -s.stiffness - 3 * s.cubicStiffness * d[p] * d[p];
      dfdv[p] = -s.damping;
    }
  }
  void clearanceLeft(const std::vector<int>& points, const double*, double* gap) const override {
    for (int p : points) gap[p] = 0.0;
  }
  Power power(double, const std::vector<int>& points, const double* d,
              const double* v) const override {
    Power sum;
    for (int p : points) {
      const auto& s = points_[at(p)];
      sum.stored += 0.5 * s.stiffness * d[p] * d[p] + 0.25 * s.cubicStiffness * std::pow(d[p], 4);
      sum.damping += s.damping * v[p] * v[p];
    }
    return sum;
  }
  std::vector<Channel> channels() const override {
    return {{"spring_force", "N", "Force of the spring and dashpot along their coordinate"}};
  }
  void record(double, const double* d, const double* v, double* out) const override {
    for (int p = 0; p < size(); ++p) out[p] = force(p, d[p], v[p]);
  }

 private:
  double force(int p, double d, double v) const {
    const auto& s = points_[at(p)];
    return -s.stiffness * d - s.cubicStiffness * d * d * d - s.damping * v;
  }
};

/// The normal force of a stop and its derivatives.
struct Normal {
  double force, dd, dv;
};

/// g = 0 | (p + s)^2 / 4s | p
double ramp(double p, double s) { return p <= -s ? 0.0 : p >= s ? p : (p + s) * (p + s) / (4 * s); }
double rampSlope(double p, double s) { return p <= -s ? 0.0 : p >= s ? 1.0 : (p + s) / (2 * s); }
double rampIntegral(double p, double s) {
  return p <= -s ? 0.0 : p >= s ? 0.5 * p * p + s * s / 6 : (p + s) * (p + s) * (p + s) / (12 * s);
}

/// f = k g(p) max(0, 1 + chi p'), p = -(d + gap)
Normal normal(const StopParameters& s, double d, double v) {
  const double p = -(d + s.gap), g = ramp(p, s.smoothing);
  if (g == 0.0) return {0, 0, 0};
  const double factor = 1 - s.damping * v;
  if (factor <= 0) return {0, 0, 0};
  return {s.stiffness * g * factor, -s.stiffness * rampSlope(p, s.smoothing) * factor,
          -s.stiffness * g * s.damping};
}

/// Coordinates (separation, tangential displacements); friction only with tangents.
class Stops final : public Batch<StopParameters, Stops>, public model::Frictional {
 public:
  Stops(std::vector<StopParameters> points, int tangents)
      : Batch(std::move(points)), tangents_(tangents) {}
  int width() const override { return 1 + tangents_; }

  void evaluate(double, const std::vector<int>& active, const double* d, const double* v,
                double* f) const override {
    const int w = width();
    for (int p : active) {
      const auto& s = points_[at(p)];
      const Normal n = normal(s, d[p * w], v[p * w]);
      f[p * w] = n.force;
      const double slip = slipSize(s, v + p * w);
      for (int t = 1; t < w; ++t) f[p * w + t] = -s.friction * n.force * v[p * w + t] / slip;
    }
  }

  void evaluateWithTangent(double, const std::vector<int>& active, const double* d, const double* v,
                           double* f, double* dfdd, double* dfdv) const override {
    const int w = width();
    for (int p : active) {
      const auto& s = points_[at(p)];
      const double* velocity = v + p * w;
      const Normal n = normal(s, d[p * w], velocity[0]);
      const double slip = slipSize(s, velocity);
      double* K = dfdd + p * w * w;
      double* C = dfdv + p * w * w;
      std::fill(K, K + w * w, 0.0);
      std::fill(C, C + w * w, 0.0);
      f[p * w] = n.force;
      K[0] = n.dd;
      C[0] = n.dv;
      for (int t = 1; t < w; ++t) {
        const double direction = velocity[t] / slip;
        f[p * w + t] = -s.friction * n.force * direction;
        K[t * w] = -s.friction * n.dd * direction;
        C[t * w] = -s.friction * n.dv * direction;
        // d(v_t / |v|_r) / dv_u = (delta_tu - v_t v_u / |v|_r^2) / |v|_r
        for (int u = 1; u < w; ++u)
          C[t * w + u] = -s.friction * n.force *
                         ((t == u ? 1.0 : 0.0) - direction * velocity[u] / slip) / slip;
      }
    }
  }

  std::shared_ptr<const model::PointLaw> withoutFriction() const override {
    auto smooth = points_;
    bool rough = false;
    for (auto& s : smooth) rough = rough || std::exchange(s.friction, 0.0) > 0.0;
    return rough ? std::make_shared<Stops>(std::move(smooth), tangents_) : nullptr;
  }

  int reach() const override { return 1; }
  void clearanceLeft(const std::vector<int>& points, const double* d, double* gap) const override {
    for (int p : points) gap[p] = d[p * width()] + points_[at(p)].gap - points_[at(p)].smoothing;
  }

  Power power(double, const std::vector<int>& points, const double* d,
              const double* v) const override {
    Power sum;
    const int w = width();
    for (int p : points) {
      const auto& s = points_[at(p)];
      const double depth = -(d[p * w] + s.gap), rate = -v[p * w];
      const Normal n = normal(s, d[p * w], v[p * w]);
      sum.stored += s.stiffness * rampIntegral(depth, s.smoothing);
      sum.damping += (n.force - s.stiffness * ramp(depth, s.smoothing)) * rate;
      const double slip = slipSize(s, v + p * w);
      for (int t = 1; t < w; ++t)
        sum.friction += s.friction * n.force * v[p * w + t] * v[p * w + t] / slip;
    }
    return sum;
  }

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
      const auto& s = points_[at(p)];
      const double force = normal(s, d[p * w], v[p * w]).force;
      out[p] = force;
      out[n + p] = d[p * w] + s.gap;
      if (tangents_ == 0) continue;
      const double slip = slipSize(s, v + p * w);
      out[2 * n + p] = s.friction * force *
                       std::sqrt(std::max(0.0, slip * slip - s.slipVelocity * s.slipVelocity)) /
                       slip;
    }
  }

 private:
  /// sqrt(|w|^2 + v_r^2) of the tangential velocity.
  double slipSize(const StopParameters& s, const double* v) const {
    double square = s.slipVelocity * s.slipVelocity;
    for (int t = 1; t < width(); ++t) square += v[t] * v[t];
    return std::sqrt(square);
  }
  int tangents_;
};

/// f = -F v / sqrt(v^2 + v_r^2)
class Frictions final : public Batch<FrictionParameters, Frictions> {
 public:
  using Batch::Batch;
  void evaluate(double, const std::vector<int>& active, const double*, const double* v,
                double* f) const override {
    for (int p : active) f[p] = force(p, v[p]);
  }
  void evaluateWithTangent(double, const std::vector<int>& active, const double*, const double* v,
                           double* f, double* dfdd, double* dfdv) const override {
    for (int p : active) {
      const auto& s = points_[at(p)];
      const double square = v[p] * v[p] + s.slipVelocity * s.slipVelocity;
      f[p] = force(p, v[p]);
      dfdd[p] = 0.0;
      dfdv[p] = -s.force * s.slipVelocity * s.slipVelocity / (square * std::sqrt(square));
    }
  }
  void clearanceLeft(const std::vector<int>& points, const double*, double* gap) const override {
    for (int p : points) gap[p] = 0.0;
  }
  Power power(double, const std::vector<int>& points, const double*,
              const double* v) const override {
    Power sum;
    for (int p : points) sum.friction -= force(p, v[p]) * v[p];
    return sum;
  }
  std::vector<Channel> channels() const override {
    return {{"friction_force", "N", "Friction force along its coordinate"}};
  }
  void record(double, const double*, const double* v, double* out) const override {
    for (int p = 0; p < size(); ++p) out[p] = force(p, v[p]);
  }

 private:
  double force(int p, double v) const {
    const auto& s = points_[at(p)];
    return -s.force * v / std::sqrt(v * v + s.slipVelocity * s.slipVelocity);
  }
};

void check(const std::vector<StopParameters>& points) {
  for (const auto& s : points) {
    require(s.stiffness > 0, "stiffness of a stop", s.stiffness, "positive");
    require(s.damping >= 0, "damping of a stop", s.damping, "zero or positive");
    require(s.smoothing >= 0, "smoothing of a stop", s.smoothing, "zero or positive");
    require(s.friction >= 0, "friction of a stop", s.friction, "zero or positive");
    require(s.slipVelocity > 0, "slip velocity of a stop", s.slipVelocity, "positive");
  }
}

}  // namespace

std::shared_ptr<const model::PointLaw> springs(const std::vector<SpringParameters>& points) {
  for (const auto& s : points) {
    require(s.stiffness >= 0, "stiffness of a spring", s.stiffness, "zero or positive");
    require(s.cubicStiffness >= 0, "cubic stiffness of a spring", s.cubicStiffness,
            "zero or positive");
    require(s.damping >= 0, "damping of a dashpot", s.damping, "zero or positive");
  }
  return std::make_shared<Springs>(points);
}

std::shared_ptr<const model::PointLaw> stops(const std::vector<StopParameters>& points) {
  check(points);
  return std::make_shared<Stops>(points, 0);
}

std::shared_ptr<const model::PointLaw> slidingStops(const std::vector<StopParameters>& points,
                                                    int tangents) {
  check(points);
  if (tangents < 1 || tangents > 2)
    throw ModelError("A sliding stop has one or two tangential coordinates; " +
                     std::to_string(tangents) + " were asked for.");
  return std::make_shared<Stops>(points, tangents);
}

std::shared_ptr<const model::PointLaw> frictions(const std::vector<FrictionParameters>& points) {
  for (const auto& s : points) {
    require(s.force >= 0, "force of a friction", s.force, "zero or positive");
    require(s.slipVelocity > 0, "slip velocity of a friction", s.slipVelocity, "positive");
  }
  return std::make_shared<Frictions>(points);
}

}  // namespace tooljoint::coupling
