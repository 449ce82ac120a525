// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The channels of one point set along a motion.
#pragma once

#include <string>
#include <vector>

#include "cases/MotionRecord.hpp"
#include "linalg/blocks/GroupedRows.hpp"
#include "model/SecondOrderModel.hpp"

namespace tooljoint::cases {

class PointRecord {
 public:
  /// `set` belongs to the model, which must outlive the record.
  PointRecord(const model::SecondOrderModel& model, const model::PointSet& set);

  /// Evaluates the channels of the law at this sample.
  void sample(const Sample& sample);

  const model::PointSet& set() const { return *set_; }
  const std::vector<model::Channel>& channels() const { return channels_; }
  /// Position of the channel with this name, -1 if the law has none.
  int find(const std::string& name) const;
  /// Values of a channel, one per point.
  const double* values(int channel) const {
    return values_.data() + static_cast<Eigen::Index>(channel) * set_->law->size();
  }

 private:
  const model::PointSet* set_;
  Eigen::Index firstState_ = 0;  ///< of the set among the states of the model
  std::vector<model::Channel> channels_;
  std::vector<Eigen::Index> recovered_;  ///< rows of the recovery equal to the rows of the set;
                                         ///< empty if some are not among them
  Vector shift_;                         ///< d minus these rows
  linalg::GroupedRows rows_;             ///< of the set, if recovered_ is empty
  Vector d_, v_, values_;
};

}  // namespace tooljoint::cases
