// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Pictures for ParaView: a chain of nodes moving inside its channel, in the global frame. The
/// numbers are in the group /xdmf of results.h5; results.xdmf refers to them.
#pragma once

#include <string>
#include <vector>

#include "common/Types.hpp"
#include "io/ResultsFile.hpp"

namespace tooljoint::io {

/// Data that are constant in time.
struct XdmfScene {
  std::vector<Vector3> positions;  ///< nodes in the order of the chain, global [m]
  std::vector<Matrix3> frames;     ///< nodal frames, columns are the axes in global components
  std::vector<double> radius;      ///< outer radius of the chain at each node [m]; empty for none
  std::vector<double> wallRadius;  ///< radius of the channel at each node [m]; empty for no wall
  int wallSectors = 24;            ///< points around the channel
};

/// One picture; arrays are node-major. Null arrays are omitted, the same ones in every picture.
struct XdmfFrame {
  double time = 0.0;                     ///< [s]
  const double* displacement = nullptr;  ///< nodes x 6, nodal frames [m, rad]
  const double* velocity = nullptr;      ///< nodes x 6, nodal frames [m/s, rad/s]
  const double* normalForce = nullptr;   ///< nodes [N]
  double rotarySpeed = 0.0;              ///< speed of the frame theta_z is measured in [rad/s]
};

/// Collects pictures at intervals of at least `interval` into an open results file. Vectors are
/// rotated into the global frame: displacement (nodes x 3), speed = length of the translational
/// velocity, spin = rotarySpeed + dtheta_z/dt.
class XdmfRecorder {
 public:
  /// Error(Internal) for sizes that do not match.
  XdmfRecorder(ResultsFile& file, const XdmfScene& scene, double interval);

  /// True if a picture is due at this time; the fields are needed only then.
  bool due(double time) const;
  /// Adds a picture if one is due.
  void append(const XdmfFrame& frame);

  std::size_t pictures() const { return times_.size(); }

  /// save() appends the times of the pictures, restore() reads them back, for a results file whose
  /// series continue those of another; `frame` has the fields of a picture, but no numbers.
  void save(std::vector<double>& memory) const;
  void restore(const double*& memory, const XdmfFrame& frame);

  /// Text of the XDMF file for a results file with this name in the same folder ("results.h5").
  std::string text(const std::string& resultsName) const;

 private:
  void writeWall(ResultsFile& file, const XdmfScene& scene);
  void addSeries(const XdmfFrame& first);

  ResultsFile& file_;
  std::vector<Matrix3> frames_;
  double interval_;
  bool hasRadius_ = false;
  std::size_t wallPoints_ = 0;
  std::size_t wallFacets_ = 0;
  std::vector<double> times_;
  std::vector<double> row_;
  TimeSeries* time_ = nullptr;
  TimeSeries* displacement_ = nullptr;
  TimeSeries* speed_ = nullptr;
  TimeSeries* spin_ = nullptr;
  TimeSeries* normalForce_ = nullptr;
};

}  // namespace tooljoint::io
