// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Writes the motion of a scene of parts, sample by sample.
#pragma once

#include <memory>
#include <vector>

#include "app/PartsDeck.hpp"
#include "app/Recorder.hpp"
#include "io/OutputFolder.hpp"
#include "io/ResultsFile.hpp"
#include "transient/Transient.hpp"

namespace tooljoint::app {

/// Group /model: which node of which part a row is.
void writePartsModel(const PartsDeck& deck, const model::SecondOrderModel& model,
                     io::ResultsFile& file);

/// Recovers every sample, D = offset + Phi q, and writes the fields of the list Output into
/// /transient.
class PartsRecorder : public Recorder {
 public:
  /// The arguments must outlive the recorder.
  PartsRecorder(const PartsDeck& deck, const model::SecondOrderModel& model, io::ResultsFile& file);

  void sample(double t, const Vector& q, const Vector& qDot, const Vector& qDDot) override;
  void save(std::vector<double>& memory) const override;
  void restore(const double*& memory) override;
  /// motion.csv: the largest displacement of each component over all nodes.
  void stageTable(io::OutputFolder& folder) const { table_.stage(folder); }
  double largestDisplacement() const { return largest_; }

 private:
  struct Points {
    const model::PointSet* set;
    std::vector<io::TimeSeries*> channels;
    Vector d, v, values;
  };
  io::TimeSeries* add(const std::string& path, std::size_t rows, std::size_t columns,
                      const std::string& unit, const std::string& longName);
  void measure(double t, const double* displacement);

  const model::SecondOrderModel& model_;
  io::ResultsFile& file_;
  io::TimeSeries* time_;
  io::TimeSeries* displacementSeries_ = nullptr;
  io::TimeSeries* velocitySeries_ = nullptr;
  io::TimeSeries* accelerationSeries_ = nullptr;
  std::vector<Points> points_;
  Vector displacement_;
  MotionTable table_;
  double largest_ = 0.0;
  long samples_ = 0;
};

}  // namespace tooljoint::app
