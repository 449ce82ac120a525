// SPDX-License-Identifier: BSD-3-Clause
#include "transient/accuracy/FrictionPeaks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/Index.hpp"
#include "transient/Integrator.hpp"

namespace tooljoint::transient {
namespace {

/// a: largest change of the velocity at the end of a step by a peak that it has not seen, over that
/// velocity. It falls with the length of the step: 0.1 or less once h W |df/dv| is.
constexpr double mostPassed = 0.1;
/// Halvings of the velocities at both ends, down to 1/1000, at which the peak is sought.
constexpr int looks = 10;

}  // namespace

void FrictionPeaks::bind(CompiledModel& model, const MassFactor& mass) {
  model_ = &model;
  mobility_.clear();
  bool some = false;
  for (const auto& batch : model.points()) {
    mobility_.emplace_back();
    if (batch.law().hasWalls()) continue;
    const int w = batch.width();
    auto& rows = mobility_.back();
    rows.assign(at(batch.points()) * at(w), 0.0);
    velocity_.resize(std::max(velocity_.size(), at(w)));
    force_.resize(velocity_.size());
    std::vector<double> block(at(w * w));
    for (int p : batch.everyPoint()) {
      batch.project(p, mass.inverse(), block.data());
      for (int k = 0; k < w; ++k) rows[at(p * w + k)] = block[at(k * w + k)];
    }
    some = some || !batch.everyPoint().empty();
  }
  any_ = model.cut().any(some);
}

bool FrictionPeaks::resolved(const State& from, const State& to, double h) {
  if (!any_) return true;
  bool passed = false;
  for (int b = 0; b < sizeOf(mobility_); ++b)
    if (!mobility_[at(b)].empty())
      for (int p : model_->points()[at(b)].everyPoint())
        passed = passed || passes(b, p, from, to, h);
  return !model_->cut().any(passed);
}

bool FrictionPeaks::passes(int b, int p, const State& from, const State& to, double h) {
  PointBatch& batch = model_->points()[at(b)];
  const int w = batch.width(), first = p * w;
  for (int k = 0; k < w; ++k) {
    const double begin = batch.rowTimesVector(first + k, from.v.data()),
                 end = batch.rowTimesVector(first + k, to.v.data());
    if (!(begin * end < 0)) continue;
    const double way = end > 0 ? 1.0 : -1.0, atEnd = -way * batch.force()[first + k];
    std::copy_n(batch.v() + first, w, velocity_.begin());
    const auto largest = [&](double velocity) {
      double most = -std::numeric_limits<double>::infinity();
      for (int look = 0; look <= looks; ++look) {
        velocity_[at(k)] = std::ldexp(velocity, -look);
        batch.evaluateElsewhere(to.t, p, batch.d() + first, velocity_.data(), force_.data(),
                                nullptr, nullptr);
        most = std::max(most, -way * force_[at(k)]);
      }
      return most;
    };
    const double peak = largest(end);
    if (h * mobility_[at(b)][at(first + k)] * (peak - atEnd) > mostPassed * std::abs(end) &&
        largest(begin) < peak)
      return true;
  }
  return false;
}

}  // namespace tooljoint::transient
