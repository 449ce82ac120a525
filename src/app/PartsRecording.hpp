// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Writes the motion of a scene of parts, sample by sample.
#pragma once

#include <memory>
#include <vector>

#include "app/PartsDeck.hpp"
#include "io/Csv.hpp"
#include "io/OutputFolder.hpp"
#include "io/ResultsFile.hpp"
#include "transient/Transient.hpp"

namespace tooljoint::app {

/// Group /model: which node of which part a row is.
void writePartsModel(const PartsDeck& deck, const model::SecondOrderModel& model, io::ResultsFile& file);

/// The samples of an earlier run.
struct RecordedParts {
  /// FileError when the file lacks what a run records to be gone on with.
  RecordedParts(const std::string& resultsFile, const std::vector<std::string>& series);
  std::vector<std::string> paths;
  std::vector<std::vector<double>> values;
  std::vector<double> time;
};

/// Recovers every sample, D = offset + Phi q, and writes the fields of the list Output into /transient.
class PartsRecorder : public transient::SampleSink {
 public:
  /// The arguments must outlive the recorder.
  PartsRecorder(const PartsDeck& deck, const model::SecondOrderModel& model, io::ResultsFile& file);

  void sample(double t, const Vector& q, const Vector& qDot, const Vector& qDDot) override;
  /// Paths of what is recorded.
  std::vector<std::string> paths() const;
  /// Takes over the first samples of an earlier run of the same scene. FileError when it has fewer.
  void replay(const RecordedParts& motion, std::size_t samples);
  /// motion.csv: the largest displacement of each component over all nodes.
  void stageTable(io::OutputFolder& folder) const { table_.stage(folder.file("motion.csv")); }
  double largestDisplacement() const { return largest_; }

 private:
  struct Field {
    std::string path;
    io::TimeSeries* series;
  };
  struct Points {
    const model::PointSet* set;
    std::vector<io::TimeSeries*> channels;
    Vector d, v, values;
  };
  io::TimeSeries* add(const std::string& path, std::size_t rows, std::size_t columns, const std::string& unit,
                      const std::string& longName);
  void measure(double t, const double* displacement);

  const model::SecondOrderModel& model_;
  io::ResultsFile& file_;
  io::TimeSeries* time_;
  std::vector<Field> fields_;
  io::TimeSeries* displacementSeries_ = nullptr;
  io::TimeSeries* velocitySeries_ = nullptr;
  io::TimeSeries* accelerationSeries_ = nullptr;
  std::vector<Points> points_;
  Vector displacement_;
  io::Csv table_;
  double largest_ = 0.0;
  long samples_ = 0;
};

}  // namespace tooljoint::app
