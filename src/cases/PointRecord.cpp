// SPDX-License-Identifier: BSD-3-Clause
#include "cases/PointRecord.hpp"

#include <algorithm>

#include "model/laws/StatefulPointLaw.hpp"

namespace tooljoint::cases {

PointRecord::PointRecord(const model::SecondOrderModel& model, const model::PointSet& set)
    : set_(&set),
      channels_(set.law->channels()),
      rows_(set.rows),
      d_(set.offset),
      v_(set.offset),
      values_(Vector::Zero(static_cast<Eigen::Index>(channels_.size()) * set.law->size())) {
  for (const auto& before : model.points) {
    if (&before == &set) break;
    firstState_ += model::stateSize(*before.law);
  }
}

void PointRecord::sample(const Sample& sample) {
  // d = offset + R q, v = R q'
  rows_.multiply(sample.q, d_);
  d_ += set_->offset;
  rows_.multiply(sample.qDot, v_);
  model::record(*set_->law, sample.t, d_.data(), v_.data(), sample.states.data() + firstState_,
                values_.data());
}

int PointRecord::find(const std::string& name) const {
  const auto it = std::find_if(channels_.begin(), channels_.end(),
                               [&](const model::Channel& channel) { return channel.name == name; });
  return it == channels_.end() ? -1 : static_cast<int>(it - channels_.begin());
}

}  // namespace tooljoint::cases
