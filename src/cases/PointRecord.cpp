// SPDX-License-Identifier: BSD-3-Clause
#include "cases/PointRecord.hpp"

#include <algorithm>
#include <map>

#include "common/Index.hpp"
#include "model/laws/StatefulPointLaw.hpp"

namespace tooljoint::cases {
namespace {

bool sameRow(const Sparse& a, Eigen::Index i, const Sparse& b, Eigen::Index j) {
  Sparse::InnerIterator x(a, i), y(b, j);
  for (; x && y; ++x, ++y)
    if (x.col() != y.col() || x.value() != y.value()) return false;
  return !x && !y;
}

/// For every row of the points the equal row of the recovery, a component of the node of the point;
/// empty if a point has no such row.
std::vector<Eigen::Index> recoveredRows(const model::SecondOrderModel& model,
                                        const model::PointSet& set) {
  const auto components = static_cast<Eigen::Index>(model.componentNames.size());
  std::map<std::int64_t, Eigen::Index> firstRow;
  for (std::size_t i = 0; i < model.recoveryNodes.size(); ++i)
    firstRow[model.recoveryNodes[i]] = static_cast<Eigen::Index>(i) * components;
  std::vector<Eigen::Index> rows;
  for (Eigen::Index i = 0; i < set.rows.rows(); ++i) {
    const auto node = firstRow.find(set.entities[at(i / set.law->width())]);
    if (node == firstRow.end()) return {};
    Eigen::Index row = node->second;
    const Eigen::Index end = row + components;
    while (row < end && !sameRow(model.recovery, row, set.rows, i)) ++row;
    if (row == end) return {};
    rows.push_back(row);
  }
  return rows;
}

}  // namespace

PointRecord::PointRecord(const model::SecondOrderModel& model, const model::PointSet& set)
    : set_(&set),
      channels_(set.law->channels()),
      recovered_(recoveredRows(model, set)),
      shift_(set.offset),
      d_(set.offset),
      v_(set.offset),
      values_(Vector::Zero(static_cast<Eigen::Index>(channels_.size()) * set.law->size())) {
  if (recovered_.empty()) rows_ = linalg::GroupedRows(set.rows);
  for (std::size_t i = 0; i < recovered_.size(); ++i)
    shift_[static_cast<Eigen::Index>(i)] -= model.recoveryOffset[recovered_[i]];
  for (const auto& before : model.points) {
    if (&before == &set) break;
    firstState_ += model::stateSize(*before.law);
  }
}

void PointRecord::sample(const Sample& sample) {
  // d = offset + R q, v = R q'
  if (recovered_.empty()) {
    rows_.multiply(sample.q, d_);
    d_ += set_->offset;
    rows_.multiply(sample.qDot, v_);
  } else {
    for (Eigen::Index i = 0; i < d_.size(); ++i) {
      const auto row = recovered_[at(i)];
      d_[i] = sample.displacement[row] + shift_[i];
      v_[i] = sample.velocity[row];
    }
  }
  model::record(*set_->law, sample.t, d_.data(), v_.data(), sample.states.data() + firstState_,
                values_.data());
}

int PointRecord::find(const std::string& name) const {
  const auto it = std::find_if(channels_.begin(), channels_.end(),
                               [&](const model::Channel& channel) { return channel.name == name; });
  return it == channels_.end() ? -1 : static_cast<int>(it - channels_.begin());
}

}  // namespace tooljoint::cases
