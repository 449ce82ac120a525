// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/contact/PointLawContact.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "common/Index.hpp"
#include "common/Types.hpp"
#include "model/laws/PointLaw.hpp"
#include "model/laws/PointLawRegistry.hpp"
#include "substructures/contact/WallKinematics.hpp"

namespace tooljoint::contact {
namespace {

constexpr int most = 3;  ///< largest number of coordinates of a contact law
constexpr int W = 4;     ///< coordinates of a node: u, v, w, theta_z
using Map = Eigen::Matrix<double, Eigen::Dynamic, W, Eigen::RowMajor, most, W>;
using RowsOut = Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;

class PointLawInBore final : public model::StatefulPointLaw, public model::Turning {
 public:
  PointLawInBore(ContactPoints points, std::shared_ptr<const model::PointLaw> law,
                 RotarySpeed speed, double feed)
      : points_(std::move(points)),
        law_(std::move(law)),
        with_(model::stateful(*law_)),
        speed_(std::move(speed)),
        feed_(feed),
        n_(law_->width()),
        tangents_(size(), n_, rated()) {
    for (auto* array : {&y_, &yDot_, &force_}) array->assign(at(size() * n_), 0.0);
    rates_.assign(at(size() * rated()), 0.0);
    all_.resize(at(size()));
    std::iota(all_.begin(), all_.end(), 0);
  }
  int size() const override { return points_.size(); }
  int width() const override { return W; }
  int states() const override { return with_ != nullptr ? with_->states() : 0; }
  int rated() const override { return with_ != nullptr ? with_->rated() : 0; }

  void initialState(double t, const double* d, const double* v, double* x) const override {
    if (with_ == nullptr) return;
    place(t, all_, d, v);
    with_->initialState(t, y_.data(), yDot_.data(), x);
  }
  void accept(double t, const double* d, const double* v, double* x) const override {
    if (with_ == nullptr) return;
    place(t, all_, d, v);
    with_->accept(t, y_.data(), yDot_.data(), x);
  }

  void forces(double t, const std::vector<int>& points, const double* d, const double* v,
              const double* x, double* f, double* g) const override {
    lawForces(t, points, d, v, x, g);
    for (int p : points) {
      const Map J = jacobian(p, kinematics(p, d, v));
      Eigen::Map<Eigen::Vector4d>(f + W * p).noalias() =
          J.transpose() * Eigen::Map<const Vector>(&force_[at(n_ * p)], n_);
    }
  }

  void forcesWithTangents(double t, const std::vector<int>& points, const double* d,
                          const double* v, const double* x, double* f, double* g,
                          const model::StateTangents& tangents) const override {
    place(t, points, d, v);
    model::StateTangents own = tangents_.write();
    own.gx = tangents.gx;
    if (with_ != nullptr)
      with_->forcesWithTangents(t, points, y_.data(), yDot_.data(), x, force_.data(), g, own);
    else
      law_->evaluateWithTangent(t, points, y_.data(), yDot_.data(), force_.data(), own.fd, own.fv);
    const int r = rated();
    for (int p : points) {
      const auto where = kinematics(p, d, v);
      const Map J = jacobian(p, where), byD = placeSlope(where),
                rateByD = rateSlope(where, v + W * p);
      const auto [fd, fv, fx, gd, gv, gx] = tangents_.of(p);
      const double* force = &force_[at(n_ * p)];
      Eigen::Map<Eigen::Vector4d>(f + W * p).noalias() =
          J.transpose() * Eigen::Map<const Vector>(force, n_);
      RowsOut(tangents.fv + p * W * W, W, W) = J.transpose().lazyProduct(Map(fv.lazyProduct(J)));
      RowsOut dfdd(tangents.fd + p * W * W, W, W);
      dfdd = J.transpose().lazyProduct(Map(fd.lazyProduct(byD) + fv.lazyProduct(rateByD)));
      addTurning(where, force, dfdd);
      if (r == 0) continue;
      RowsOut(tangents.fx + p * W * r, W, r) = J.transpose().lazyProduct(fx);
      RowsOut(tangents.gd + p * W * r, r, W) = gd.lazyProduct(byD) + gv.lazyProduct(rateByD);
      RowsOut(tangents.gv + p * W * r, r, W) = gv.lazyProduct(J);
    }
  }

  std::optional<std::complex<double>> heldFactor(double t, std::complex<double> s, int point,
                                                 const double* d, const double* v) const override {
    if (with_ == nullptr) return 1.0;
    place(t, all_, d, v);
    return with_->heldFactor(t, s, point, y_.data(), yDot_.data());
  }

  int reach() const override { return 3; }
  void clearanceLeft(const std::vector<int>& points, const double* d, double* gap) const override {
    for (int p : points) y_[at(n_ * p)] = separation(p, d);
    law_->clearanceLeft(points, y_.data(), gap);
  }

  Power powers(double t, const std::vector<int>& points, const double* d, const double* v,
               const double* x, const double* xDot) const override {
    place(t, points, d, v);
    Power sum = with_ != nullptr ? with_->powers(t, points, y_.data(), yDot_.data(), x, xDot)
                                 : law_->power(t, points, y_.data(), yDot_.data());
    if (n_ == 1) return sum;
    // rotary drive and block change y_1 and y_2 without motion of the node: their forces do work on
    // the law
    lawForces(t, points, d, v, x, rates_.data());
    const double omega = speed_(t);
    for (int p : points) {
      sum.drive -= force_[at(n_ * p + 1)] * omega * points_.contactRadius[at(p)];
      if (n_ > 2) sum.drive -= force_[at(n_ * p + 2)] * feed_;
    }
    return sum;
  }

  std::vector<model::Channel> channels() const override { return contactChannels(n_ > 1, n_ > 2); }
  void recordState(double t, const double* d, const double* v, const double* x,
                   double* out) const override {
    lawForces(t, all_, d, v, x, rates_.data());
    const int n = size();
    for (int p = 0; p < n; ++p) {
      out[p] = force_[at(n_ * p)];
      out[n + p] = separation(p, d);
      if (n_ == 1) continue;
      out[2 * n + p] = force_[at(n_ * p + 1)];
      out[3 * n + p] = force_[at(n_ * p + 1)] * points_.contactRadius[at(p)];
      if (n_ > 2) out[4 * n + p] = force_[at(n_ * p + 2)];
    }
  }

  std::shared_ptr<const model::PointLaw> atSpeed(double speed) const override {
    return std::make_shared<PointLawInBore>(
        points_, law_, [speed](double /*t*/) { return speed; }, feed_);
  }

  std::shared_ptr<const model::PointLaw> subset(const std::vector<int>& positions) const override {
    return std::make_shared<PointLawInBore>(points_.subset(positions), law_->subset(positions),
                                            speed_, feed_);
  }

 private:
  double separation(int p, const double* d) const {
    return -WallKinematics(d[W * p], d[W * p + 1], 0, 0, points_.clearance[at(p)]).penetration;
  }
  WallKinematics kinematics(int p, const double* d, const double* v) const {
    return {d[W * p], d[W * p + 1], v[W * p], v[W * p + 1], points_.clearance[at(p)]};
  }
  /// Coordinates of the law and their velocities.
  void place(double t, const std::vector<int>& points, const double* d, const double* v) const {
    const double omega = n_ > 1 ? speed_(t) : 0.0;
    for (int p : points) {
      const auto where = kinematics(p, d, v);
      double *y = &y_[at(n_ * p)], *yDot = &yDot_[at(n_ * p)];
      y[0] = -where.penetration;
      yDot[0] = -where.rate;
      if (n_ > 1) yDot[1] = where.slip + (omega + v[W * p + 3]) * points_.contactRadius[at(p)];
      if (n_ > 2) y[2] = d[W * p + 2] + feed_ * t, yDot[2] = v[W * p + 2] + feed_;
    }
  }
  void lawForces(double t, const std::vector<int>& points, const double* d, const double* v,
                 const double* x, double* g) const {
    place(t, points, d, v);
    if (with_ != nullptr)
      with_->forces(t, points, y_.data(), yDot_.data(), x, force_.data(), g);
    else
      law_->evaluate(t, points, y_.data(), yDot_.data(), force_.data());
  }

  /// dy'/d(u', v', w', theta_z')
  Map jacobian(int p, const WallKinematics& where) const {
    Map J = Map::Zero(n_, W);
    J(0, 0) = -where.nu, J(0, 1) = -where.nv;
    if (n_ > 1) J(1, 0) = -where.nv, J(1, 1) = where.nu, J(1, 3) = points_.contactRadius[at(p)];
    if (n_ > 2) J(2, 2) = 1.0;
    return J;
  }
  /// dy/d(u, v, w, theta_z); y_1 has none.
  Map placeSlope(const WallKinematics& where) const {
    Map slope = Map::Zero(n_, W);
    slope(0, 0) = -where.nu, slope(0, 1) = -where.nv;
    if (n_ > 2) slope(2, 2) = 1.0;
    return slope;
  }
  /// dy'/d(u, v, w, theta_z)
  Map rateSlope(const WallKinematics& where, const double* v) const {
    Map slope = Map::Zero(n_, W);
    slope(0, 0) = -(v[0] - where.nu * where.rate) * where.inverse;
    slope(0, 1) = -(v[1] - where.nv * where.rate) * where.inverse;
    if (n_ > 1) {
      slope(1, 0) = (v[1] - where.nu * where.slip) * where.inverse;
      slope(1, 1) = (-v[0] - where.nv * where.slip) * where.inverse;
    }
    return slope;
  }
  /// dJ'/d(u, v) f
  void addTurning(const WallKinematics& where, const double* f, RowsOut& dfdd) const {
    const double nuu = (1 - where.nu * where.nu) * where.inverse,
                 nuv = -where.nu * where.nv * where.inverse,
                 nvv = (1 - where.nv * where.nv) * where.inverse, around = n_ > 1 ? f[1] : 0.0;
    dfdd(0, 0) += -nuu * f[0] - nuv * around;
    dfdd(0, 1) += -nuv * f[0] - nvv * around;
    dfdd(1, 0) += -nuv * f[0] + nuu * around;
    dfdd(1, 1) += -nvv * f[0] + nuv * around;
  }

  ContactPoints points_;
  std::shared_ptr<const model::PointLaw> law_;
  const model::StatefulPointLaw* with_;
  RotarySpeed speed_;
  double feed_;
  int n_;
  std::vector<int> all_;
  // values of the law in one evaluation
  mutable std::vector<double> y_, yDot_, force_, rates_;
  mutable model::StateTangentArrays tangents_;
};

/// The law at rest in its initial state. The sliding velocity around the hole is zero there: the
/// friction of such a law begins with the motion.
class PointLawAtRest final : public StaticContact {
 public:
  PointLawAtRest(ContactPoints points, std::shared_ptr<const model::PointLaw> law)
      : StaticContact(std::move(points)), law_(std::move(law)) {
    all_.resize(at(size()));
    std::iota(all_.begin(), all_.end(), 0);
  }

  void normalForce(const Options& options, const double* uv, double* force,
                   double* slope) const override {
    const int n = law_->width();
    std::vector<double> y(at(size() * n)), still(y.size()), f(y.size()), fd(at(size() * n * n)),
        fv(fd.size());
    for (int p = 0; p < size(); ++p)
      y[at(n * p)] =
          -WallKinematics(uv[2 * p], uv[2 * p + 1], 0, 0, points_.clearance[at(p)]).penetration;
    law_->evaluateWithTangent(0.0, all_, y.data(), still.data(), f.data(), fd.data(), fv.data());
    if (slope != nullptr && model::stateful(*law_) != nullptr) {
      // the initial state depends on the position, so this slope differs from that at constant
      // state
      const auto ahead = forcesAt(y, slopeStep), behind = forcesAt(y, -slopeStep);
      for (int p = 0; p < size(); ++p)
        fd[at(n * n * p)] = (ahead[at(n * p)] - behind[at(n * p)]) / (2 * slopeStep);
    }
    for (int p = 0; p < size(); ++p) {
      force[p] = options.stiffnessScale * f[at(n * p)];
      if (slope != nullptr) slope[p] = -options.stiffnessScale * fd[at(n * n * p)];
    }
  }
  double largestPull() const override { return 0.0; }

 private:
  std::vector<double> forcesAt(std::vector<double> y, double step) const {
    const std::vector<double> still(y.size());
    std::vector<double> f(y.size());
    for (int p = 0; p < size(); ++p) y[at(law_->width() * p)] += step;
    law_->evaluate(0.0, all_, y.data(), still.data(), f.data());
    return f;
  }

  static constexpr double slopeStep = 1e-8;  ///< step of central differences [m]
  std::shared_ptr<const model::PointLaw> law_;
  std::vector<int> all_;
};

class PointLawContact final : public ContactLaw {
 public:
  PointLawContact(std::string name, const Teuchos::ParameterList& own)
      : name_(std::move(name)), own_(own) {
    make(1);
  }
  std::shared_ptr<const StaticContact> atRest(ContactPoints points) const override {
    auto law = make(points.size());
    return std::make_shared<PointLawAtRest>(std::move(points), std::move(law));
  }
  bool hasFrictionAtRest() const override { return false; }

 private:
  std::shared_ptr<const model::PointLaw> makeInMotion(ContactPoints points, RotarySpeed speed,
                                                      const AxialSliding& axial) const override {
    auto law = make(points.size());
    return std::make_shared<PointLawInBore>(std::move(points), std::move(law), std::move(speed),
                                            axial.feed);
  }
  std::shared_ptr<const model::PointLaw> make(int points) const {
    return model::PointLawRegistry::instance().make(name_, own_, {points, most});
  }

  std::string name_;
  Teuchos::ParameterList own_;
};

}  // namespace

std::shared_ptr<const ContactLaw> pointLawContact(const std::string& name,
                                                  const Teuchos::ParameterList& own) {
  return std::make_shared<PointLawContact>(name, own);
}

}  // namespace tooljoint::contact
