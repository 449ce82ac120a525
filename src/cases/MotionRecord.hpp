// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Recorded quantities of a case in addition to the time and the motion of its nodes: channels of
/// the results file, the rows of motion.csv, values for the summary, pictures.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "common/Types.hpp"
#include "io/Csv.hpp"
#include "io/OutputFolder.hpp"
#include "io/ResultsFile.hpp"
#include "io/Xdmf.hpp"
#include "io/summary/Summary.hpp"

namespace tooljoint::cases {

/// One sample of a motion: coordinates of the model, and the motion of the nodes.
struct Sample {
  double t = 0.0;  ///< [s]
  const Vector& q;
  const Vector& qDot;
  const Vector& displacement;  ///< rows of the recovery: offset + Phi q
  const Vector& velocity;      ///< Phi q'
  const Vector& acceleration;  ///< Phi q''
  const Vector& states;        ///< of the point laws, set by set; empty if no law has states
};

/// A time series of the results file.
struct Channel {
  std::string path;
  io::Shape shape;
  std::string unit, longName;
  const double* values;  ///< values of the latest sample, as many as the shape has entries
};

/// Unit and long name of a field of all nodes.
struct FieldText {
  std::string unit, longName;
};

/// Made by a case for one model, full or reduced. The lists below keep order and size, and the
/// values of the channels keep their addresses, from the construction on.
class MotionRecord {
 public:
  virtual ~MotionRecord() = default;

  /// Updates channels, row and results with this sample.
  virtual void sample(const Sample& sample) = 0;

  /// Texts of displacement, velocity and acceleration.
  virtual std::array<FieldText, 3> fields() const = 0;
  virtual std::vector<Channel> channels() const = 0;
  /// Columns of motion.csv, the time first, and their values at the latest sample.
  virtual std::vector<io::Csv::Column> columns() const = 0;
  virtual const std::vector<double>& row() const = 0;

  /// save() appends the data of previous samples that a continued run needs; restore() reads them
  /// back.
  virtual void save(std::vector<double>& memory) const = 0;
  virtual void restore(const double*& memory) = 0;

  /// The main results, as summary keys and as one line of the log.
  virtual void summarise(io::Summary& summary) const = 0;
  virtual std::string describe() const = 0;
  /// Results for nodes: groups of results.h5 after the motion, and tables.
  virtual void write(io::ResultsFile& file) const { (void)file; }
  virtual void stageTables(io::OutputFolder& folder) const { (void)folder; }
  /// Doubts about the motion, one sentence each.
  virtual std::vector<std::string> warnings() const { return {}; }

  /// Null for a case without geometry.
  virtual const io::XdmfScene* picture() const { return nullptr; }
  /// Adds the data of a picture other than displacements and velocities at time t.
  virtual void complete(double t, io::XdmfFrame& frame) const {
    (void)t;
    (void)frame;
  }
};

}  // namespace tooljoint::cases
