// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Turns the coordinates of a model into motions of nodes and contact forces, sample by sample, and
/// writes them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/Recorder.hpp"
#include "app/Scene.hpp"
#include "app/Stages.hpp"
#include "io/OutputFolder.hpp"
#include "io/ResultsFile.hpp"
#include "io/Xdmf.hpp"
#include "linalg/blocks/GroupedRows.hpp"
#include "transient/Transient.hpp"

namespace tooljoint::app {

/// What a person asks first of a motion.
struct MotionFigures {
  long samples = 0;
  double minBitSpeed = 0.0;  ///< Omega + dtheta_z/dt of the last node [rad/s]
  double maxBitSpeed = 0.0;
  double sumBitSpeed = 0.0;
  double maxPenetration = 0.0;  ///< largest r - j0 of a contact node [m]
  std::vector<int> missed;  ///< contact nodes (1-based) the reduced model did not look at and that
                            ///< passed the wall
  double meanBitSpeed() const {
    return samples == 0 ? 0.0 : sumBitSpeed / static_cast<double>(samples);
  }
};

/// Recovers every sample, D = offset + Phi q, and writes the fields the deck's Output list asks for
/// into /transient.
class MotionRecorder : public Recorder {
 public:
  /// The arguments must outlive the recorder. Nothing is recovered that is neither written nor
  /// counted.
  MotionRecorder(const Scene& scene, const StaticStage& stage, const model::SecondOrderModel& model,
                 io::ResultsFile& file);

  void sample(double t, const Vector& q, const Vector& qDot, const Vector& qDDot) override;
  void save(std::vector<double>& memory) const override;
  void restore(const double*& memory) override;
  const MotionFigures& figures() const { return figures_; }
  /// motion.csv: time, rotary speed, bit speed, axial and angular position of the bit.
  void stageTable(io::OutputFolder& folder) const { table_.stage(folder); }
  /// results.xdmf beside results.h5.
  void stagePictures(io::OutputFolder& folder) const;
  /// Null when the deck asks for no pictures.
  const io::XdmfRecorder* pictures() const { return xdmf_.get(); }

 private:
  /// One point set: scratch for its coordinates and channels.
  struct Contact {
    const model::PointSet* set;
    int normalForce;  ///< channel, -1 when the law has none
    linalg::GroupedRows rows;
    Vector d, v, channels;
  };
  io::XdmfFrame frame(double t) const;
  void recordContact(double t, const Vector& q, const Vector& qDot);
  void measure(double t);

  const Scene& scene_;
  const model::SecondOrderModel& model_;
  linalg::GroupedRows recovery_;
  MotionFigures figures_;
  std::vector<Contact> contacts_;
  std::vector<char> watched_;  ///< per node: its contact is evaluated
  Vector displacement_, velocity_, acceleration_, normalForce_;
  io::TimeSeries* time_ = nullptr;
  io::TimeSeries* speed_ = nullptr;
  io::TimeSeries* displacementSeries_ = nullptr;
  io::TimeSeries* velocitySeries_ = nullptr;
  io::TimeSeries* accelerationSeries_ = nullptr;
  io::TimeSeries* forceSeries_ = nullptr;
  std::unique_ptr<io::XdmfRecorder> xdmf_;
  io::ResultsFile& file_;
  MotionTable table_;
  double nextFlush_ = 0.0;
  double flushInterval_ = 0.0;
};

}  // namespace tooljoint::app
