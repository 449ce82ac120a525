// SPDX-License-Identifier: BSD-3-Clause
#include "transient/contact/MetWall.hpp"

#include <algorithm>
#include <cmath>

#include "common/Index.hpp"

namespace tooljoint::transient {
namespace {

/// Fraction of the depth behind a wall at which its damping is evaluated again, for its onset
/// value.
constexpr double onsetShare = 1.0 / 16.0;
/// Bisections on the way out of a wall, to find where it begins.
constexpr int bisections = 24;

}  // namespace

void MetWall::bind(CompiledModel& model) {
  std::size_t widest = 0;
  for (const auto& batch : model.points()) widest = std::max(widest, at(batch.width()));
  f_.assign(widest, 0.0);
  dfdd_.assign(widest * widest, 0.0);
  dfdv_ = dfdd_;
  normal_ = elsewhere_ = f_;
}

void MetWall::face(PointBatch& batch, int point, const double* mobility, double t) {
  batch_ = &batch;
  point_ = point;
  t_ = t;
  frequency_ = mobility_ = push_ = depth_ = damping_ = rise_ = 0;
  const int w = batch.width();
  batch.evaluateHere(t, point, true);
  const double *f = batch.force() + point * w, *J = batch.dfdd() + point * w * w;
  double size = 0;
  for (int k = 0; k < w; ++k) {
    normal_[at(k)] = 0;
    for (int i = 0; i < w; ++i) normal_[at(k)] -= J[i * w + k] * f[i];
    size = std::hypot(size, normal_[at(k)]);
  }
  if (!(size > 0)) return;
  for (int k = 0; k < w; ++k) normal_[at(k)] /= size;
  for (int i = 0; i < w; ++i) {
    push_ += normal_[at(i)] * f[i] / batch.scale(point);
    for (int k = 0; k < w; ++k) mobility_ += normal_[at(i)] * mobility[i * w + k] * normal_[at(k)];
  }
}

/// The wall lies behind the depth in which a regularised law begins. It is evaluated first at the
/// depth that the point reaches in the whole step, then at speed / w.
void MetWall::measure(double speed, double h) {
  if (!(mobility_ > 0)) return;
  depth_ = h * speed;
  for (bool first = true; depth_ > 0; first = false) {
    const auto [stiffness, damping] = behind(depth_);
    damping_ = std::max(0.0, damping * mobility_);
    frequency_ = stiffness > 0 ? std::sqrt(stiffness * mobility_) : 0;
    if (!first || frequency_ == 0 || frequency_ * h < 1) break;
    depth_ = speed / frequency_;
  }
}

/// W c = damping + rise * (depth behind the start of the wall), from two depths.
void MetWall::findOnset(double farthest) {
  if (!(damping_ > 0)) return;
  const double begin = beginning(farthest);
  const double near = mobility_ * behind(onsetShare * depth_ - begin)[1],
               far = mobility_ * behind(depth_ - begin)[1];
  rise_ = std::max(0.0, (far - near) / ((1 - onsetShare) * depth_));
  damping_ = std::max(0.0, near - rise_ * onsetShare * depth_);
}

/// Distance from the point outwards to the start of the wall, at most `farthest`: where the
/// stiffness is half of that behind it. The forces of regularised laws extend further.
double MetWall::beginning(double farthest) {
  const double half = 0.5 * frequency_ * frequency_ / mobility_;
  double inside = 0, outside = farthest;
  for (int i = 0; i < bisections; ++i) {
    const double middle = 0.5 * (inside + outside);
    (behind(-middle)[0] > half ? inside : outside) = middle;
  }
  return inside;
}

/// k and c at this depth behind the point, at its speed.
std::array<double, 2> MetWall::behind(double depth) {
  const int w = batch_->width();
  const double *d = batch_->d() + point_ * w, *v = batch_->v() + point_ * w;
  for (int k = 0; k < w; ++k)
    elsewhere_[at(k)] = d[k] - std::copysign(depth, push_ * depth) * normal_[at(k)];
  batch_->evaluateElsewhere(t_, point_, elsewhere_.data(), v, f_.data(), dfdd_.data(),
                            dfdv_.data());
  double stiffness = 0, damping = 0;
  for (int i = 0; i < w; ++i)
    for (int k = 0; k < w; ++k) {
      const double both = normal_[at(i)] * normal_[at(k)] / batch_->scale(point_);
      stiffness -= both * dfdd_[at(i * w + k)];
      damping -= both * dfdv_[at(i * w + k)];
    }
  return {stiffness, damping};
}

double MetWall::along(const Vector& v) const {
  double sum = 0;
  for (int k = 0; k < batch_->width(); ++k)
    sum += normal_[at(k)] * batch_->rowTimesVector(point_ * batch_->width() + k, v.data());
  return sum;
}

double MetWall::along(const double* rows) const {
  double sum = 0;
  for (int k = 0; k < batch_->width(); ++k) sum += normal_[at(k)] * rows[k];
  return sum;
}

}  // namespace tooljoint::transient
