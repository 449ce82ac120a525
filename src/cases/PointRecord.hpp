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
  /// `set` is one of the model's, which must outlive the record.
  PointRecord(const model::SecondOrderModel& model, const model::PointSet& set);

  /// Evaluates the channels of the law at this sample.
  void sample(const Sample& sample);

  const model::PointSet& set() const { return *set_; }
  const std::vector<model::Channel>& channels() const { return channels_; }
  /// Position of the channel with this name, -1 when the law has none.
  int find(const std::string& name) const;
  /// Values of a channel, one per point.
  const double* values(int channel) const {
    return values_.data() + static_cast<Eigen::Index>(channel) * set_->law->size();
  }

 private:
  const model::PointSet* set_;
  Eigen::Index firstState_ = 0;  ///< of the set among the states of the model
  std::vector<model::Channel> channels_;
  std::vector<Eigen::Index> recovered_;  ///< rows of the recovery that are the rows of the set;
                                         ///< empty where some are not among them
  Vector shift_;                         ///< d less these
  linalg::GroupedRows rows_;             ///< of the set, where they are needed
  Vector d_, v_, values_;
};

}  // namespace tooljoint::cases
