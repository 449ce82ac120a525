// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// From the coordinates of a model to the motion of its nodes, sample by sample.
#pragma once

#include "cases/MotionRecord.hpp"
#include "linalg/blocks/GroupedRows.hpp"
#include "model/SecondOrderModel.hpp"
#include "transient/Transient.hpp"

namespace tooljoint::cases {

class SampleRecovery {
 public:
  /// `model` must outlive the object.
  explicit SampleRecovery(const model::SecondOrderModel& model)
      : model_(model), recovery_(model.recovery) {}

  /// States of the point laws at the next sample.
  void states(const Vector& x) { states_ = x; }
  /// D = offset + Phi q and its rates. What it refers to is that of this object, until the next
  /// call, and `q` and `qDot`.
  Sample recover(double t, const Vector& q, const Vector& qDot, const Vector& qDDot) {
    // D = offset + Phi q, D' = Phi q', D'' = Phi q''
    recovery_.multiply({&q, &qDot, &qDDot}, {&displacement_, &velocity_, &acceleration_});
    displacement_ += model_.recoveryOffset;
    return {t, q, qDot, displacement_, velocity_, acceleration_, states_};
  }

 private:
  const model::SecondOrderModel& model_;
  linalg::GroupedRows recovery_;
  Vector displacement_, velocity_, acceleration_, states_;
};

/// Hands the motion of the nodes to a record, which alone keeps something of it.
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
