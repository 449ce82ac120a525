// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Turns a kernel of the normal force into a contact law. Included by the laws' own files only.
///
/// A kernel is a class with
///   void prepare(const ContactPoints&)                               constants per point, once
///   double forceOnly(size_t i, double G, double rate) const          F_n
///   NormalForce force(size_t i, double G, double rate) const         F_n and its derivatives
///   double elastic(size_t i, double G, double lambda, double& dG) const   F_n at rest and its
///   derivative; lambda 0 = the
///                                                                    point's own regularisation
///   double pull(size_t i, double lambda) const                       what an open point is pulled
///   with at most double energy(size_t i, double G) const                          int_0^G of the
///   elastic part double skin(size_t i) const                                      gap beyond which
///   the force is negligible [m];
///                                                                    infinite when it never is
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "common/Constants.hpp"
#include "common/report/EvaluationCounters.hpp"
#include "model/laws/Coulomb.hpp"
#include "model/laws/Friction.hpp"
#include "model/laws/HuntCrossley.hpp"
#include "model/laws/PointLaw.hpp"
#include "substructures/contact/ContactLaw.hpp"
#include "substructures/contact/WallKinematics.hpp"

namespace tooljoint::contact {

using constants::pi;

/// atan2(1, -x) = pi/2 + atan(x) without cancellation for large negative x; by its asymptote for
/// |x| > 32, where the first term left out is below 1e-19.
inline double risingAngle(double x) {
  const double size = std::abs(x);
  if (size < 32.0) return std::atan2(1.0, -x);
  const double y = 1.0 / size;
  const double y2 = y * y;
  const double a =
      y *
      (1.0 - y2 * (1.0 / 3.0 - y2 * (1.0 / 5.0 - y2 * (1.0 / 7.0 - y2 * (1.0 / 9.0 - y2 / 11.0)))));
  return x > 0.0 ? pi - a : a;
}

/// atan(x) = pi/2 - (asymptote) for x >= 0.
inline double positiveAngle(double x) {
  return x < 32.0 ? std::atan(x) : 0.5 * pi - risingAngle(-x);
}

/// (x^2 atan(x) + atan(x) - x)/2 = int_0^x y atan(y) dy for x >= 0, without cancellation for small
/// x.
inline double angleMoment(double x) {
  if (x < 1e-2) return x * x * x * (1.0 / 3.0 - x * x * (1.0 / 15.0 - x * x / 35.0));
  return 0.5 * ((x * x + 1.0) * positiveAngle(x) - x);
}

using model::FrictionCurve;
using model::NormalForce;

template <class Kernel>
class BoreholeContactOf final : public BoreholeContact,
                                public model::Frictional,
                                public model::Turning {
 public:
  BoreholeContactOf(ContactPoints points, Kernel kernel, RotarySpeed speed)
      : BoreholeContact(std::move(points)),
        original_(kernel),
        kernel_(std::move(kernel)),
        speed_(std::move(speed)) {
    kernel_.prepare(points_);
    frictionless_ = points_.frictionless();
    if (frictionless_) return;
    for (int i = 0; i < size(); ++i) {
      const ContactPoint p = points_.at(i);
      friction_.emplace_back(p.muStatic, p.muDynamic, p.regularisationVelocity);
    }
  }

  void evaluate(double t, const std::vector<int>& active, const double* d, const double* v,
                double* f) const override {
    contactCount() += static_cast<long>(active.size());
    if (frictionless_) {
      for (const int p : active)
        frictionlessForce(static_cast<std::size_t>(p), d + 3 * p, v + 3 * p, f + 3 * p);
      return;
    }
    const double omega = speed_(t);
    long slid = 0;
    for (const int p : active)
      slid += force(static_cast<std::size_t>(p), omega, d + 3 * p, v + 3 * p, f + 3 * p);
    frictionCount() += slid;
  }

  void evaluateWithTangent(double t, const std::vector<int>& active, const double* d,
                           const double* v, double* f, double* dfdd, double* dfdv) const override {
    contactCount() += static_cast<long>(active.size());
    const double omega = frictionless_ ? 0.0 : speed_(t);
    long slid = 0;
    for (const int p : active)
      slid += tangent(static_cast<std::size_t>(p), omega, d + 3 * p, v + 3 * p, f + 3 * p,
                      dfdd + 9 * p, dfdv + 9 * p);
    if (slid > 0) frictionCount() += slid;
  }

  int reach() const override { return 2; }
  void clearanceLeft(const std::vector<int>& points, const double* d, double* gap) const override {
    for (int p : points) {
      const auto i = static_cast<std::size_t>(p);
      const double skin = kernel_.skin(i);
      const double r = std::sqrt(d[3 * p] * d[3 * p] + d[3 * p + 1] * d[3 * p + 1]);
      gap[p] = std::isfinite(skin) ? points_.clearance[i] - r - skin : 0.0;
    }
  }

  Power power(double t, const std::vector<int>& points, const double* d,
              const double* v) const override {
    Power sum;
    const double omega = frictionless_ ? 0.0 : speed_(t);
    for (int p : points) {
      const auto i = static_cast<std::size_t>(p);
      const WallKinematics at = where(i, d + 3 * p, v + 3 * p);
      double dG = 0.0;
      const double normal = kernel_.force(i, at.penetration, at.rate).value;
      sum.stored += kernel_.energy(i, at.penetration);
      sum.damping += (normal - kernel_.elastic(i, at.penetration, 0.0, dG)) * at.rate;
      if (frictionless_ || friction_[i].h == 0.0) continue;
      const double sliding = at.slip + (omega + v[3 * p + 2]) * points_.contactRadius[i];
      const double traction = friction_[i].value(sliding) * normal;
      sum.friction += traction * sliding;
      sum.drive += traction * omega * points_.contactRadius[i];
    }
    return sum;
  }

  std::vector<model::Channel> channels() const override { return contactChannels(!frictionless_); }

  void record(double t, const double* d, const double* v, double* out) const override {
    const double omega = frictionless_ ? 0.0 : speed_(t);
    const int n = size();
    for (int p = 0; p < n; ++p) {
      const auto i = static_cast<std::size_t>(p);
      const WallKinematics at = where(i, d + 3 * p, v + 3 * p);
      const double normal = kernel_.force(i, at.penetration, at.rate).value;
      out[p] = normal;
      out[n + p] = -at.penetration;
      if (frictionless_) continue;
      const double radius = points_.contactRadius[i];
      const double traction =
          friction_[i].value(at.slip + (omega + v[3 * p + 2]) * radius) * normal;
      out[2 * n + p] = -traction;
      out[3 * n + p] = -traction * radius;
    }
  }

  std::shared_ptr<const model::PointLaw> withoutFriction() const override {
    if (frictionless_) return nullptr;
    ContactPoints smooth = points_;
    std::fill(smooth.muStatic.begin(), smooth.muStatic.end(), 0.0);
    std::fill(smooth.muDynamic.begin(), smooth.muDynamic.end(), 0.0);
    return std::make_shared<BoreholeContactOf>(std::move(smooth), original_, speed_);
  }

  std::shared_ptr<const model::PointLaw> atSpeed(double speed) const override {
    return std::make_shared<BoreholeContactOf>(points_, original_,
                                               [speed](double /*t*/) { return speed; });
  }

  std::shared_ptr<const model::PointLaw> subset(const std::vector<int>& positions) const override {
    return std::make_shared<BoreholeContactOf>(points_.subset(positions), original_, speed_);
  }

 private:
  static long& contactCount() {
    static long& n = counter("contact evaluations");
    return n;
  }
  static long& frictionCount() {
    static long& n = counter("friction evaluations");
    return n;
  }

  WallKinematics where(std::size_t i, const double* d, const double* v) const {
    return WallKinematics(d[0], d[1], v[0], v[1], points_.clearance[i]);
  }

  void frictionlessForce(std::size_t i, const double* d, const double* v, double* f) const {
    const WallKinematics at = where(i, d, v);
    const double normal = kernel_.forceOnly(i, at.penetration, at.rate);
    f[0] = -normal * at.nu;
    f[1] = -normal * at.nv;
    f[2] = 0.0;
  }

  /// Returns 1 when friction was evaluated.
  int force(std::size_t i, double omega, const double* d, const double* v, double* f) const {
    const WallKinematics at = where(i, d, v);
    const double normal = kernel_.forceOnly(i, at.penetration, at.rate);
    const FrictionCurve& curve = friction_[i];
    const double radius = points_.contactRadius[i];
    const bool slides = normal != 0.0 && curve.h != 0.0;
    const double traction = slides ? curve.value(at.slip + (omega + v[2]) * radius) * normal : 0.0;
    f[0] = -normal * at.nu + traction * at.nv;
    f[1] = -normal * at.nv - traction * at.nu;
    f[2] = -traction * radius;
    return slides ? 1 : 0;
  }

  /// Forces and tangents; `N` is the normal force, `T` = mu N the traction against t. Returns 1
  /// when friction was evaluated.
  int tangent(std::size_t i, double omega, const double* d, const double* v, double* f,
              double* dfdd, double* dfdv) const {
    const WallKinematics at = where(i, d, v);
    const double nu = at.nu, nv = at.nv;
    // derivatives of the rate and of the slip with respect to u, v: (velocity - n rate)/r and so on
    const double rateU = (v[0] - nu * at.rate) * at.inverse;
    const double rateV = (v[1] - nv * at.rate) * at.inverse;
    const NormalForce normal = kernel_.force(i, at.penetration, at.rate);
    const double N = normal.value;
    const double Nu = normal.dG * nu + normal.dRate * rateU;
    const double Nv = normal.dG * nv + normal.dRate * rateV;
    const double NuDot = normal.dRate * nu, NvDot = normal.dRate * nv;
    // dn/d(u,v) = (I - n n')/r
    const double nuu = (1.0 - nu * nu) * at.inverse, nuv = -nu * nv * at.inverse;
    const double nvv = (1.0 - nv * nv) * at.inverse;
    f[0] = -N * nu;
    f[1] = -N * nv;
    f[2] = 0.0;
    dfdd[0] = -Nu * nu - N * nuu;
    dfdd[1] = -Nv * nu - N * nuv;
    dfdd[3] = -Nu * nv - N * nuv;
    dfdd[4] = -Nv * nv - N * nvv;
    dfdd[2] = dfdd[5] = dfdd[6] = dfdd[7] = dfdd[8] = 0.0;
    dfdv[0] = -NuDot * nu;
    dfdv[1] = -NvDot * nu;
    dfdv[3] = -NuDot * nv;
    dfdv[4] = -NvDot * nv;
    dfdv[2] = dfdv[5] = dfdv[6] = dfdv[7] = dfdv[8] = 0.0;
    // outside the skin of a clamped law nothing acts and nothing changes
    if (frictionless_ || friction_[i].h == 0.0 ||
        (N == 0.0 && normal.dG == 0.0 && normal.dRate == 0.0))
      return 0;

    const double radius = points_.contactRadius[i];
    double slope = 0.0;
    const double mu = friction_[i].value(at.slip + (omega + v[2]) * radius, slope);
    const double slipU = (v[1] - nu * at.slip) * at.inverse;
    const double slipV = (-v[0] - nv * at.slip) * at.inverse;
    const double T = mu * N, TzDot = slope * N * radius;
    const double Tu = mu * Nu + slope * N * slipU;
    const double Tv = mu * Nv + slope * N * slipV;
    const double TuDot = mu * NuDot - slope * N * nv;
    const double TvDot = mu * NvDot + slope * N * nu;
    f[0] += T * nv;
    f[1] -= T * nu;
    f[2] = -T * radius;
    dfdd[0] += Tu * nv + T * nuv;
    dfdd[1] += Tv * nv + T * nvv;
    dfdd[3] -= Tu * nu + T * nuu;
    dfdd[4] -= Tv * nu + T * nuv;
    dfdd[6] = -Tu * radius;
    dfdd[7] = -Tv * radius;
    dfdv[0] += TuDot * nv;
    dfdv[1] += TvDot * nv;
    dfdv[2] = TzDot * nv;
    dfdv[3] -= TuDot * nu;
    dfdv[4] -= TvDot * nu;
    dfdv[5] = -TzDot * nu;
    dfdv[6] = -TuDot * radius;
    dfdv[7] = -TvDot * radius;
    dfdv[8] = -TzDot * radius;
    return 1;
  }

  Kernel original_;  // before prepare(), for subset()
  Kernel kernel_;
  RotarySpeed speed_;
  std::vector<FrictionCurve> friction_;  // empty without friction
  bool frictionless_ = true;
};

template <class Kernel>
class StaticContactOf final : public StaticContact {
 public:
  StaticContactOf(ContactPoints points, Kernel kernel)
      : StaticContact(std::move(points)), kernel_(std::move(kernel)) {
    kernel_.prepare(points_);
  }

  void normalForce(const Options& options, const double* uv, double* force,
                   double* slope) const override {
    for (int p = options.first; p < options.end(size()); ++p) {
      const auto i = static_cast<std::size_t>(p);
      double dG = 0.0;
      const WallKinematics at(uv[2 * p], uv[2 * p + 1], 0.0, 0.0, points_.clearance[i]);
      force[p] = elastic(options, i, at.penetration, dG);
      if (slope != nullptr) slope[p] = dG;
    }
  }

  double largestPull() const override {
    double largest = 0.0;
    for (int p = 0; p < size(); ++p)
      largest = std::max(largest, kernel_.pull(static_cast<std::size_t>(p), 0.0));
    return largest;
  }

 private:
  /// F_n and its derivative, lifted by the part of the pull that is left out.
  double elastic(const Options& options, std::size_t i, double G, double& dG) const {
    const double force = kernel_.elastic(i, G, options.lambda, dG) +
                         (1.0 - options.pull) * kernel_.pull(i, options.lambda);
    dG *= options.stiffnessScale;
    return options.stiffnessScale * force;
  }

  Kernel kernel_;
};

template <class Kernel>
class ContactLawOf final : public ContactLaw {
 public:
  explicit ContactLawOf(Kernel kernel = Kernel()) : kernel_(std::move(kernel)) {}
  std::shared_ptr<const model::PointLaw> inMotion(ContactPoints points,
                                                  RotarySpeed speed) const override {
    return std::make_shared<BoreholeContactOf<Kernel>>(std::move(points), kernel_,
                                                       std::move(speed));
  }
  std::shared_ptr<const StaticContact> atRest(ContactPoints points) const override {
    return std::make_shared<StaticContactOf<Kernel>>(std::move(points), kernel_);
  }

 private:
  Kernel kernel_;
};

}  // namespace tooljoint::contact
