// SPDX-License-Identifier: BSD-3-Clause
#include "cases/figures/OrbitFigures.hpp"

#include <cmath>

namespace tooljoint::cases {

OrbitFigures::OrbitFigures(Eigen::Index nodes) {
  for (Vector* sum : {&moment_, &radius_, &forward_, &backward_, &rubbing_, &rolling_})
    *sum = Vector::Zero(nodes);
}

void OrbitFigures::add(const OrbitSample& sample) {
  const double sense = sample.rotarySpeed < 0.0 ? -1.0 : 1.0;
  const double least = whirlFraction * std::abs(sample.rotarySpeed);
  ++samples_;
  for (Eigen::Index i = 0; i < moment_.size(); ++i) {
    // r^2 theta' = u v' - v u'
    const double moment = sample.u[i] * sample.vDot[i] - sample.v[i] * sample.uDot[i];
    const double radius = sample.u[i] * sample.u[i] + sample.v[i] * sample.v[i];
    moment_[i] += moment;
    radius_[i] += radius;
    if (moment == 0.0 || std::abs(moment) < least * radius) continue;
    const bool forward = sense * moment > 0.0;
    const bool touches = sample.inContact[static_cast<std::size_t>(i)] != 0;
    (forward ? forward_ : backward_)[i] += 1.0;
    if (touches) (forward ? rubbing_ : rolling_)[i] += 1.0;
  }
}

Vector OrbitFigures::rate() const {
  Vector out = Vector::Zero(moment_.size());
  for (Eigen::Index i = 0; i < out.size(); ++i)
    if (radius_[i] > 0.0) out[i] = moment_[i] / radius_[i];
  return out;
}

WorstPlace OrbitFigures::most(const Vector& share) const {
  WorstPlace place{0, share[0]};
  for (Eigen::Index i = 1; i < share.size(); ++i)
    if (share[i] > place.value || (share[i] == place.value && radius_[i] > radius_[place.row]))
      place = {i, share[i]};
  return place;
}

Vector OrbitFigures::share(const Vector& counts) const {
  return samples_ == 0 ? counts : Vector(counts / static_cast<double>(samples_));
}

void OrbitFigures::save(std::vector<double>& memory) const {
  memory.push_back(static_cast<double>(samples_));
  for (const Vector* sum : {&moment_, &radius_, &forward_, &backward_, &rubbing_, &rolling_})
    saveVector(*sum, memory);
}

void OrbitFigures::restore(const double*& memory) {
  samples_ = static_cast<long>(*memory++);
  for (Vector* sum : {&moment_, &radius_, &forward_, &backward_, &rubbing_, &rolling_})
    restoreVector(*sum, memory);
}

}  // namespace tooljoint::cases
