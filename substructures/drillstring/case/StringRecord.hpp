// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Recorded quantities of the motion of a string in addition to its nodes: rotary speed; speed,
/// torque and hook load at the surface; normal forces; bit speed; penetrations; pictures.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cases/PointRecord.hpp"
#include "substructures/drillstring/case/BitSampler.hpp"
#include "substructures/drillstring/case/StringFigures.hpp"
#include "substructures/drillstring/case/SurfaceSampler.hpp"
#include "substructures/drillstring/scene/Scene.hpp"
#include "substructures/drillstring/scene/Stages.hpp"

namespace tooljoint::drillstring {

/// The main results of a motion.
struct MotionFigures {
  long samples = 0;
  double minBitSpeed = 0.0;  ///< Omega + dtheta_z/dt of the last node [rad/s]
  double maxBitSpeed = 0.0;
  double sumBitSpeed = 0.0;
  double maxPenetration = 0.0;  ///< largest r - j0 of a contact node [m]
  std::vector<int> missed;      ///< contact nodes (1-based) without contact in the reduced model
                                ///< that passed the wall
  double meanBitSpeed() const {
    return samples == 0 ? 0.0 : sumBitSpeed / static_cast<double>(samples);
  }
};

class StringRecord : public cases::MotionRecord {
 public:
  /// The arguments must outlive the record. Only quantities that are written or counted are
  /// evaluated.
  StringRecord(const Scene& scene, const StaticStage& stage, const model::SecondOrderModel& model);

  void sample(const cases::Sample& sample) override;
  std::array<cases::FieldText, 3> fields() const override;
  std::vector<cases::Channel> channels() const override;
  /// Time, rotary speed, bit speed, axial and angular position of the bit.
  std::vector<io::Csv::Column> columns() const override;
  const std::vector<double>& row() const override { return row_; }
  void save(std::vector<double>& memory) const override;
  void restore(const double*& memory) override;
  void summarise(io::Summary& summary) const override;
  std::string describe() const override;
  void write(io::ResultsFile& file) const override { merits_.write(file); }
  void stageTables(io::OutputFolder& folder) const override { merits_.stageTables(folder); }
  std::vector<std::string> warnings() const override;
  const io::XdmfScene* picture() const override { return picture_ ? &*picture_ : nullptr; }
  void complete(double t, io::XdmfFrame& frame) const override;

 private:
  struct Contact {
    cases::PointRecord record;
    int normalForce;  ///< channel
  };
  void sampleContact(const cases::Sample& sample);
  void measureBit(const cases::Sample& sample);
  void measureWall(const Vector& displacement);

  const Scene& scene_;
  MotionFigures figures_;
  StringFigures merits_;
  BitSampler bit_;
  SurfaceSampler surface_;
  bool recordsForce_ = false;
  std::vector<Contact> contacts_;
  std::vector<cases::PointRecord> drilling_;  ///< bit and top drive
  std::vector<char> watched_;                 ///< per node: its contact is evaluated
  double rotarySpeed_ = 0.0;                  ///< [rad/s]
  Vector normalForce_;                        ///< per node [N]
  std::vector<double> row_;
  std::optional<io::XdmfScene> picture_;
};

}  // namespace tooljoint::drillstring
