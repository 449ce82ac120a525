// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Converts coordinates of a model to the motion of its nodes, sample by sample.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "cases/MotionRecord.hpp"
#include "linalg/blocks/GroupedRows.hpp"
#include "model/SecondOrderModel.hpp"
#include "transient/Transient.hpp"
#include "transient/ranks/RankGather.hpp"
#include "transient/ranks/ShareSink.hpp"

namespace tooljoint::cases {

class SampleRecovery {
 public:
  /// `model` must outlive the object.
  explicit SampleRecovery(const model::SecondOrderModel& model) : model_(model) {}

  /// States of the point laws at the next sample.
  void states(const Vector& x) { states_ = x; }
  /// D = offset + Phi q and its rates. The sample refers to this object until the next call, and to
  /// `q` and `qDot`.
  Sample recover(double t, const Vector& q, const Vector& qDot, const Vector& qDDot);
  /// The same for a divided motion: each rank recovers its rows. Rank 0 gets the sample, other
  /// ranks nothing. Collective.
  std::optional<Sample> gather(const transient::SampleShare& mine);

 private:
  /// Data of gather() between the samples of one motion.
  struct Division {
    explicit Division(const transient::RankShare& share);
    std::vector<int> rows;         ///< of the recovery that belong to this rank
    linalg::GroupedRows recovery;  ///< of these rows
    transient::RankGather gather;
    std::array<Vector, 3> recovered;
  };

  const model::SecondOrderModel& model_;
  std::optional<linalg::GroupedRows> recovery_;
  std::unique_ptr<Division> division_;
  Vector q_, qDot_;  ///< of all ranks
  Vector displacement_, velocity_, acceleration_, states_;
};

/// Passes the motion of the nodes to a record and keeps nothing itself.
class RecordSink : public transient::SampleSink {
 public:
  /// The arguments must outlive the object.
  RecordSink(const model::SecondOrderModel& model, MotionRecord& record)
      : recovery_(model), record_(record) {}

  void sample(double t, const Vector& q, const Vector& qDot, const Vector& qDDot) override {
    record_.sample(recovery_.recover(t, q, qDot, qDDot));
  }
  void states(const Vector& x) override { recovery_.states(x); }

 private:
  SampleRecovery recovery_;
  MotionRecord& record_;
};

}  // namespace tooljoint::cases
