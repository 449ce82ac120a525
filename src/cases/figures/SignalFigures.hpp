// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Mean, root mean square and extremes of sampled signals, sample by sample.
#pragma once

#include <string>
#include <vector>

#include "common/Types.hpp"
#include "io/summary/Summary.hpp"

namespace tooljoint::cases {

/// Values of one signal. All are 0 before the first sample.
class SignalFigures {
 public:
  void add(double value);

  long samples() const { return samples_; }
  double mean() const;
  double rms() const;  ///< about zero
  double min() const { return min_; }
  double max() const { return max_; }
  /// (max - min)/(2 mean): 0 for a constant signal, 1 for a + a sin, above 1 for a signal that
  /// changes its sign. 0 if the mean is 0.
  double fluctuationIndex() const;

  /// Sets KEY.mean, .rms, .min and .max, times `scale`.
  void summarise(const std::string& key, double scale, io::Summary& summary) const;

  void save(std::vector<double>& memory) const;
  void restore(const double*& memory);

 private:
  long samples_ = 0;
  double sum_ = 0.0, squares_ = 0.0, min_ = 0.0, max_ = 0.0;
};

/// A position in a table of values and the value there.
struct WorstPlace {
  Eigen::Index row = 0;
  double value = 0.0;
};
/// The largest value, the first of equal ones. `values` has at least one entry.
WorstPlace worst(const Vector& values);

/// Root mean square and peak of magnitudes at many nodes.
class MagnitudeFigures {
 public:
  explicit MagnitudeFigures(Eigen::Index nodes)
      : squares_(Vector::Zero(nodes)), peak_(Vector::Zero(nodes)) {}

  /// One sample: the magnitude at every node, >= 0.
  void add(const Vector& magnitudes);

  Vector rms() const;
  const Vector& peak() const { return peak_; }
  /// Over all nodes and samples.
  double overallRms() const;

  void save(std::vector<double>& memory) const;
  void restore(const double*& memory);

 private:
  long samples_ = 0;
  Vector squares_, peak_;
};

/// saveVector() appends a vector to the memory of a checkpoint; restoreVector() reads it into a
/// vector of the same size.
void saveVector(const Vector& values, std::vector<double>& memory);
void restoreVector(Vector& values, const double*& memory);

}  // namespace tooljoint::cases
