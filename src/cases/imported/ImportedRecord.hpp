// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Recorded quantities of imported parts in addition to the motion of their nodes: the channels of
/// all point laws and the largest displacements.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "cases/MotionRecord.hpp"
#include "cases/PointRecord.hpp"
#include "cases/figures/ContactFigures.hpp"
#include "cases/figures/FigureWindow.hpp"
#include "cases/figures/SignalFigures.hpp"
#include "model/SecondOrderModel.hpp"

namespace tooljoint::cases {

/// SI unit of a component of a node by its name; "" if it is neither a translation nor a rotation.
std::string unitOf(const std::string& component);

class ImportedRecord : public MotionRecord {
 public:
  /// Part name and number within the part of a node, from its number in the model.
  using NodeNames = std::function<std::pair<std::string, long>(std::int64_t)>;

  /// `model` must outlive the record.
  /// \param forces  record the channels of the point laws, in addition to the results of stops
  /// \param window  of the results
  ImportedRecord(const model::SecondOrderModel& model, bool forces, const FigureWindow& window,
                 NodeNames names);

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
  void write(io::ResultsFile& file) const override;

 private:
  /// A one-sided contact.
  struct Stop {
    std::size_t record;  ///< among points_
    int force;           ///< its channel
    ContactFigures figures;
  };

  void measure(const Sample& sample);
  /// largest_ of the components in m, in rad and without unit.
  std::map<std::string, double> largestByUnit() const;
  void summariseStops(io::Summary& summary) const;
  void summarise(const std::string& key, const MagnitudeFigures& figures,
                 io::Summary& summary) const;

  const model::SecondOrderModel& model_;
  const model::ComponentNames& components_;
  std::vector<PointRecord> points_;
  std::vector<Stop> stops_;
  bool recordsForces_;
  std::vector<double> row_;
  std::vector<double> largest_;  ///< of all nodes, by component
  FigureWindow window_;
  NodeNames names_;
  std::vector<int> measured_;  ///< components in the magnitudes
  long samples_ = 0;           ///< in the window
  double first_ = 0.0, last_ = 0.0;
  MagnitudeFigures displacement_, acceleration_;
};

}  // namespace tooljoint::cases
