// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What is recorded of the motion of imported parts beside their nodes: the channels of all point
/// laws and the largest displacements.
#pragma once

#include <string>
#include <vector>

#include "cases/MotionRecord.hpp"
#include "cases/PointRecord.hpp"
#include "model/SecondOrderModel.hpp"

namespace tooljoint::cases {

/// SI unit of a component of a node by its name; "" where it tells neither a translation nor a
/// rotation.
std::string unitOf(const std::string& component);

class ImportedRecord : public MotionRecord {
 public:
  /// `model` must outlive the record. \param forces record the channels of the point laws
  ImportedRecord(const model::SecondOrderModel& model, bool forces);

  void sample(const Sample& sample) override;
  std::array<FieldText, 3> fields() const override;
  std::vector<Channel> channels() const override;
  /// The time, and the largest displacement of each component over all nodes.
  std::vector<io::Csv::Column> columns() const override;
  const std::vector<double>& row() const override { return row_; }
  void save(std::vector<double>& memory) const override;
  void restore(const double*& memory) override;
  void summarise(io::Summary& summary) const override;
  std::string describe() const override;

 private:
  const model::ComponentNames& components_;
  std::vector<PointRecord> points_;
  std::vector<double> row_;
  double largest_ = 0.0;
};

}  // namespace tooljoint::cases
