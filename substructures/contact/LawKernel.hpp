// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Turns a kernel of the normal force into a contact law. Included only by the files of the laws.
///
/// A kernel is a class with
///
///     void prepare(const ContactPoints&)
///         constants per point, once
///     double forceOnly(size_t i, double G, double rate) const
///         F_n
///     NormalForce force(size_t i, double G, double rate) const
///         F_n and its derivatives
///     double elastic(size_t i, double G, double lambda, double& dG) const
///         F_n at rest and its derivative; lambda 0 = the point's own regularisation
///     double pull(size_t i, double lambda) const
///         largest force that pulls an open point to the wall
///     double energy(size_t i, double G) const
///         int_0^G of the elastic part
///     double skin(size_t i) const
///         gap beyond which the force is negligible [m]; infinite when it never is
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

/// atan2(1, -x) = pi/2 + atan(x) without cancellation for large negative x. For |x| > 32 by its
/// asymptote; the first omitted term is below 1e-19.
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
using model::SlidingVelocity;

/// \tparam Axial  friction against sliding along the hole too; without it no axial term is
/// evaluated
template <class Kernel, bool Axial>
class BoreholeContactOf final : public BoreholeContact,
                                public model::Frictional,
                                public model::Turning {
 public:
  static constexpr int W = Axial ? 4 : 3;  ///< coordinates: u, v, (w,) theta_z
  static constexpr int Z = W - 1;

  /// `feed`: speed of the frame, for axial friction [m/s].
  BoreholeContactOf(ContactPoints points, Kernel kernel, RotarySpeed speed, double feed)
      : BoreholeContact(std::move(points)),
        original_(kernel),
        kernel_(std::move(kernel)),
        speed_(std::move(speed)),
        feed_(feed) {
    kernel_.prepare(points_);
    frictionless_ = points_.frictionless();
    if (frictionless_) return;
    for (int i = 0; i < size(); ++i) {
      const ContactPoint p = points_.at(i);
      friction_.emplace_back(p.muStatic, p.muDynamic, p.regularisationVelocity);
    }
  }

  int width() const override { return W; }

  void evaluate(double t, const std::vector<int>& active, const double* d, const double* v,
                double* f) const override {
    contactCount() += static_cast<long>(active.size());
    if (frictionless_) {
      for (const int p : active)
        frictionlessForce(static_cast<std::size_t>(p), d + W * p, v + W * p, f + W * p);
      return;
    }
    const double omega = speed_(t);
    long slid = 0;
    for (const int p : active)
      slid += force(static_cast<std::size_t>(p), omega, d + W * p, v + W * p, f + W * p);
    frictionCount() += slid;
  }

  void evaluateWithTangent(double t, const std::vector<int>& active, const double* d,
                           const double* v, double* f, double* dfdd, double* dfdv) const override {
    contactCount() += static_cast<long>(active.size());
    const double omega = frictionless_ ? 0.0 : speed_(t);
    long slid = 0;
    for (const int p : active)
      slid += tangent(static_cast<std::size_t>(p), omega, d + W * p, v + W * p, f + W * p,
                      dfdd + W * W * p, dfdv + W * W * p);
    if (slid > 0) frictionCount() += slid;
  }

  int reach() const override { return 2; }
  void clearanceLeft(const std::vector<int>& points, const double* d, double* gap) const override {
    for (int p : points) {
      const auto i = static_cast<std::size_t>(p);
      const double skin = kernel_.skin(i);
      const double r = std::sqrt(d[W * p] * d[W * p] + d[W * p + 1] * d[W * p + 1]);
      gap[p] = std::isfinite(skin) ? points_.clearance[i] - r - skin : 0.0;
    }
  }

  Power power(double t, const std::vector<int>& points, const double* d,
              const double* v) const override {
    Power sum;
    const double omega = frictionless_ ? 0.0 : speed_(t);
    for (int p : points) {
      const auto i = static_cast<std::size_t>(p);
      const WallKinematics at = where(i, d + W * p, v + W * p);
      double dG = 0.0;
      const double normal = kernel_.force(i, at.penetration, at.rate).value;
      sum.stored += kernel_.energy(i, at.penetration);
      sum.damping += (normal - kernel_.elastic(i, at.penetration, 0.0, dG)) * at.rate;
      if (frictionless_ || friction_[i].h == 0.0) continue;
      const SlidingVelocity sliding = slidingAt(i, at, omega, v + W * p);
      const auto mu = coefficient(i, sliding);
      const double traction = mu.around * normal;
      sum.friction += traction * sliding.around;
      sum.drive += traction * omega * points_.contactRadius[i];
      if constexpr (Axial) {
        sum.friction += mu.along * normal * sliding.along;
        sum.drive += mu.along * normal * feed_;
      }
    }
    return sum;
  }

  std::vector<model::Channel> channels() const override {
    return contactChannels(!frictionless_, Axial);
  }

  void record(double t, const double* d, const double* v, double* out) const override {
    const double omega = frictionless_ ? 0.0 : speed_(t);
    const int n = size();
    for (int p = 0; p < n; ++p) {
      const auto i = static_cast<std::size_t>(p);
      const WallKinematics at = where(i, d + W * p, v + W * p);
      const double normal = kernel_.force(i, at.penetration, at.rate).value;
      out[p] = normal;
      out[n + p] = -at.penetration;
      if (frictionless_) continue;
      const double radius = points_.contactRadius[i];
      const auto mu = coefficient(i, slidingAt(i, at, omega, v + W * p));
      const double traction = mu.around * normal;
      out[2 * n + p] = -traction;
      out[3 * n + p] = -traction * radius;
      if constexpr (Axial) out[4 * n + p] = -mu.along * normal;
    }
  }

  std::shared_ptr<const model::PointLaw> withoutFriction() const override {
    if (frictionless_) return nullptr;
    ContactPoints smooth = points_;
    std::fill(smooth.muStatic.begin(), smooth.muStatic.end(), 0.0);
    std::fill(smooth.muDynamic.begin(), smooth.muDynamic.end(), 0.0);
    return std::make_shared<BoreholeContactOf>(std::move(smooth), original_, speed_, feed_);
  }

  double drive(double t, const std::vector<int>& points, const double* friction) const override {
    double torque = 0.0, along = 0.0;
    for (const int p : points) {
      torque += friction[W * p + Z];
      if constexpr (Axial) along += friction[W * p + 2];
    }
    return -(torque * speed_(t) + along * feed_);
  }

  std::shared_ptr<const model::PointLaw> atSpeed(double speed) const override {
    return std::make_shared<BoreholeContactOf>(
        points_, original_, [speed](double /*t*/) { return speed; }, feed_);
  }

  std::shared_ptr<const model::PointLaw> subset(const std::vector<int>& positions) const override {
    return std::make_shared<BoreholeContactOf>(points_.subset(positions), original_, speed_, feed_);
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

  SlidingVelocity slidingAt(std::size_t i, const WallKinematics& at, double omega,
                            const double* v) const {
    const double around = at.slip + (omega + v[Z]) * points_.contactRadius[i];
    if constexpr (Axial)
      return {around, feed_ + v[2]};
    else
      return {around, 0.0};
  }

  /// Friction divided by normal force, against the components of the sliding velocity.
  struct Coefficient {
    double around, along;
  };
  Coefficient coefficient(std::size_t i, const SlidingVelocity& sliding) const {
    if constexpr (Axial) {
      const model::SlidingFriction mu(friction_[i], sliding);
      return {mu.around, mu.along};
    } else {
      return {friction_[i].value(sliding.around), 0.0};
    }
  }

  void frictionlessForce(std::size_t i, const double* d, const double* v, double* f) const {
    const WallKinematics at = where(i, d, v);
    const double normal = kernel_.forceOnly(i, at.penetration, at.rate);
    f[0] = -normal * at.nu;
    f[1] = -normal * at.nv;
    for (int k = 2; k < W; ++k) f[k] = 0.0;
  }

  /// Returns 1 when friction was evaluated.
  int force(std::size_t i, double omega, const double* d, const double* v, double* f) const {
    const WallKinematics at = where(i, d, v);
    const double normal = kernel_.forceOnly(i, at.penetration, at.rate);
    const FrictionCurve& curve = friction_[i];
    const double radius = points_.contactRadius[i];
    const bool slides = normal != 0.0 && curve.h != 0.0;
    double traction = 0.0, drag = 0.0;
    if (slides) {
      const Coefficient mu = coefficient(i, slidingAt(i, at, omega, v));
      traction = mu.around * normal;
      if constexpr (Axial) drag = mu.along * normal;
    }
    f[0] = -normal * at.nu + traction * at.nv;
    f[1] = -normal * at.nv - traction * at.nu;
    if constexpr (Axial) f[2] = -drag;
    f[Z] = -traction * radius;
    return slides ? 1 : 0;
  }

  /// Forces and tangents. `N` is the normal force, `T` = mu N the traction against t, `along` N the
  /// traction along the hole. Returns 1 when friction was evaluated.
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
    for (int k = 2; k < W; ++k) f[k] = 0.0;
    std::fill(dfdd, dfdd + W * W, 0.0);
    std::fill(dfdv, dfdv + W * W, 0.0);
    double *du = dfdd, *dv = dfdd + W, *duDot = dfdv, *dvDot = dfdv + W;  // rows of F_u, F_v
    du[0] = -Nu * nu - N * nuu;
    du[1] = -Nv * nu - N * nuv;
    dv[0] = -Nu * nv - N * nuv;
    dv[1] = -Nv * nv - N * nvv;
    duDot[0] = -NuDot * nu;
    duDot[1] = -NvDot * nu;
    dvDot[0] = -NuDot * nv;
    dvDot[1] = -NvDot * nv;
    // outside the skin of a clamped law force and tangents are zero
    if (frictionless_ || friction_[i].h == 0.0 ||
        (N == 0.0 && normal.dG == 0.0 && normal.dRate == 0.0))
      return 0;

    const double radius = points_.contactRadius[i];
    const SlidingVelocity sliding = slidingAt(i, at, omega, v);
    double mu = 0.0, slope = 0.0;  // of the traction around; slope by v_c
    double along = 0.0, cross = 0.0, alongSlope = 0.0;
    if constexpr (Axial) {
      const model::SlidingFriction both(friction_[i], sliding);
      const model::SlidingFrictionSlope slopes(friction_[i], sliding);
      mu = both.around, along = both.along;
      slope = slopes.aroundAround, cross = slopes.aroundAlong, alongSlope = slopes.alongAlong;
    } else {
      mu = friction_[i].value(sliding.around, slope);
    }
    const double slipU = (v[1] - nu * at.slip) * at.inverse;
    const double slipV = (-v[0] - nv * at.slip) * at.inverse;
    const double T = mu * N, TzDot = slope * N * radius;
    const double Tu = mu * Nu + slope * N * slipU;
    const double Tv = mu * Nv + slope * N * slipV;
    const double TuDot = mu * NuDot - slope * N * nv;
    const double TvDot = mu * NvDot + slope * N * nu;
    f[0] += T * nv;
    f[1] -= T * nu;
    f[Z] = -T * radius;
    du[0] += Tu * nv + T * nuv;
    du[1] += Tv * nv + T * nvv;
    dv[0] -= Tu * nu + T * nuu;
    dv[1] -= Tv * nu + T * nuv;
    double *dz = dfdd + Z * W, *dzDot = dfdv + Z * W;
    dz[0] = -Tu * radius;
    dz[1] = -Tv * radius;
    duDot[0] += TuDot * nv;
    duDot[1] += TvDot * nv;
    duDot[Z] = TzDot * nv;
    dvDot[0] -= TuDot * nu;
    dvDot[1] -= TvDot * nu;
    dvDot[Z] = -TzDot * nu;
    dzDot[0] = -TuDot * radius;
    dzDot[1] = -TvDot * radius;
    dzDot[Z] = -TzDot * radius;
    if constexpr (Axial) {
      const double TwDot = cross * N;
      duDot[2] = TwDot * nv;
      dvDot[2] = -TwDot * nu;
      dzDot[2] = -TwDot * radius;
      f[2] = -along * N;
      double *dw = dfdd + 2 * W, *dwDot = dfdv + 2 * W;
      dw[0] = -along * Nu - cross * N * slipU;
      dw[1] = -along * Nv - cross * N * slipV;
      dwDot[0] = -along * NuDot + cross * N * nv;
      dwDot[1] = -along * NvDot - cross * N * nu;
      dwDot[2] = -alongSlope * N;
      dwDot[3] = -cross * N * radius;
    }
    return 1;
  }

  Kernel original_;  // before prepare(), for subset()
  Kernel kernel_;
  RotarySpeed speed_;
  double feed_;
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
  /// F_n and its derivative; the force is raised by the fraction 1 - pull of the attraction.
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
  std::shared_ptr<const StaticContact> atRest(ContactPoints points) const override {
    return std::make_shared<StaticContactOf<Kernel>>(std::move(points), kernel_);
  }

 private:
  std::shared_ptr<const model::PointLaw> makeInMotion(ContactPoints points, RotarySpeed speed,
                                                      const AxialSliding& axial) const override {
    if (axial.friction)
      return std::make_shared<BoreholeContactOf<Kernel, true>>(std::move(points), kernel_,
                                                               std::move(speed), axial.feed);
    return std::make_shared<BoreholeContactOf<Kernel, false>>(std::move(points), kernel_,
                                                              std::move(speed), axial.feed);
  }

  Kernel kernel_;
};

}  // namespace tooljoint::contact
