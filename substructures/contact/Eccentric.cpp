// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/contact/Eccentric.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "common/Index.hpp"
#include "model/laws/Friction.hpp"

namespace tooljoint::contact {
namespace {

class EccentricAtRest final : public StaticContact {
 public:
  EccentricAtRest(std::shared_ptr<const StaticContact> concentric, Offsets offsets)
      : StaticContact(concentric->points()),
        concentric_(std::move(concentric)),
        offsets_(std::move(offsets)) {}

  void evaluate(const Options& options, const double* uv, double* f,
                double* tangent) const override {
    concentric_->evaluate(options, centres(uv).data(), f, tangent);
    for (int p = 0; p < size(); ++p) {
      addTorque(offsets_[at(p)], 1, f + kForces * p);
      if (tangent != nullptr) addTorque(offsets_[at(p)], 2, tangent + 2 * kForces * p);
    }
  }

  void normalForce(const Options& options, const double* uv, double* force,
                   double* slope) const override {
    concentric_->normalForce(options, centres(uv).data(), force, slope);
  }

  double largestPull() const override { return concentric_->largestPull(); }
  Eigen::Vector2d offset(int point) const override { return offsets_[at(point)]; }

 private:
  /// Row of T_z += o_u row of F_v - o_v row of F_u; each row has `columns` entries.
  static void addTorque(const Eigen::Vector2d& o, int columns, double* rows) {
    for (int c = 0; c < columns; ++c)
      rows[3 * columns + c] += o.x() * rows[columns + c] - o.y() * rows[c];
  }

  Vector centres(const double* uv) const {
    Vector shifted = Eigen::Map<const Vector>(uv, 2 * size());
    for (int p = 0; p < size(); ++p) shifted.segment<2>(2 * p) += offsets_[at(p)];
    return shifted;
  }

  std::shared_ptr<const StaticContact> concentric_;
  Offsets offsets_;
};

class EccentricInMotion final : public model::PointLaw,
                                public model::Frictional,
                                public model::Turning {
 public:
  EccentricInMotion(std::shared_ptr<const model::PointLaw> concentric, Offsets offsets)
      : concentric_(std::move(concentric)), offsets_(std::move(offsets)) {}

  int size() const override { return concentric_->size(); }
  int width() const override { return concentric_->width(); }

  void evaluate(double t, const std::vector<int>& active, const double* d, const double* v,
                double* f) const override {
    concentric_->evaluate(t, active, centres(active, d), v, f);
    for (const int p : active) addTorque(p, f + width() * p, 1);
  }

  void evaluateWithTangent(double t, const std::vector<int>& active, const double* d,
                           const double* v, double* f, double* dfdd, double* dfdv) const override {
    concentric_->evaluateWithTangent(t, active, centres(active, d), v, f, dfdd, dfdv);
    const int w = width();
    for (const int p : active) {
      addTorque(p, f + w * p, 1);
      addTorque(p, dfdd + w * w * p, w);
      addTorque(p, dfdv + w * w * p, w);
    }
  }

  void clearanceLeft(const std::vector<int>& points, const double* d, double* gap) const override {
    concentric_->clearanceLeft(points, centres(points, d), gap);
  }
  int reach() const override { return concentric_->reach(); }

  Power power(double t, const std::vector<int>& points, const double* d,
              const double* v) const override {
    return concentric_->power(t, points, centres(points, d), v);
  }

  std::vector<model::Channel> channels() const override { return concentric_->channels(); }
  void record(double t, const double* d, const double* v, double* out) const override {
    concentric_->record(t, centres(range(size()), d), v, out);
  }

  std::shared_ptr<const model::PointLaw> withoutFriction() const override {
    auto smooth = model::withoutFriction(concentric_);
    return smooth == concentric_ ? nullptr : eccentric(std::move(smooth), offsets_);
  }
  double drive(double t, const std::vector<int>& points, const double* friction) const override {
    thread_local std::vector<double> concentric;
    const int w = width();
    concentric.assign(friction, friction + w * size());
    for (const int p : points) {
      const Eigen::Vector2d& o = offsets_[at(p)];
      const double* f = friction + w * p;
      concentric[at(w * p + w - 1)] -= o.x() * f[1] - o.y() * f[0];
    }
    return dynamic_cast<const model::Frictional&>(*concentric_).drive(t, points, concentric.data());
  }
  std::shared_ptr<const model::PointLaw> atSpeed(double speed) const override {
    return eccentric(model::atSpeed(concentric_, speed), offsets_);
  }
  std::shared_ptr<const model::PointLaw> subset(const std::vector<int>& points) const override {
    Offsets chosen;
    for (const int p : points) chosen.push_back(offsets_[at(p)]);
    return eccentric(concentric_->subset(points), std::move(chosen));
  }

 private:
  /// Coordinates of the centres of contact, valid until the next call of this thread.
  const double* centres(const std::vector<int>& points, const double* d) const {
    thread_local std::vector<double> shifted;
    const std::size_t w = at(width());
    shifted.resize(w * offsets_.size());
    for (const int p : points) {
      const std::size_t i = w * at(p);
      shifted[i] = d[i] + offsets_[at(p)].x();
      shifted[i + 1] = d[i + 1] + offsets_[at(p)].y();
      std::copy(d + i + 2, d + i + w, shifted.begin() + static_cast<std::ptrdiff_t>(i + 2));
    }
    return shifted.data();
  }

  /// The last row of `rows` (F_u, F_v, perhaps F_w, T_z, each with `columns` entries) += o_u row 1
  /// - o_v row 0.
  void addTorque(int point, double* rows, int columns) const {
    const Eigen::Vector2d& o = offsets_[at(point)];
    for (int c = 0; c < columns; ++c)
      rows[(width() - 1) * columns + c] += o.x() * rows[columns + c] - o.y() * rows[c];
  }

  std::shared_ptr<const model::PointLaw> concentric_;
  Offsets offsets_;
};

}  // namespace

std::shared_ptr<const StaticContact> eccentric(std::shared_ptr<const StaticContact> concentric,
                                               Offsets offsets) {
  return std::make_shared<EccentricAtRest>(std::move(concentric), std::move(offsets));
}

std::shared_ptr<const model::PointLaw> eccentric(std::shared_ptr<const model::PointLaw> concentric,
                                                 Offsets offsets) {
  return std::make_shared<EccentricInMotion>(std::move(concentric), std::move(offsets));
}

}  // namespace tooljoint::contact
