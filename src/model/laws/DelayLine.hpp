// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Recent history of a few quantities, for laws with a delay: y(t - tau) of the accepted motion.
#pragma once

namespace tooljoint::model {

/// Samples of `values` quantities y with their rates y' over the last `span` seconds, kept in held
/// states of a StatefulPointLaw: nothing is allocated, and a checkpoint contains them. Samples are
/// at least span / (samples - 2) apart, so that short steps do not need more of them. Between
/// samples y is the cubic of values and rates, with an error of (distance)^4 y'''' / 384.
class DelayLine {
 public:
  enum class Shape {
    Cubic,
    Monotone,  ///< if a rate does not fit the adjacent samples, the cubic is limited to the range
               ///< of its two values (F. N. Fritsch and R. E. Carlson, SIAM J. Numer. Anal. 17
               ///< (1980) 238-246)
  };
  /// span > 0 [s], samples >= 4. Throws ModelError otherwise.
  DelayLine(int values, double span, int samples, Shape shape = Shape::Cubic);
  /// Size of its memory.
  int states() const { return header + samples_ * row_; }

  /// At rest at y for all time before t.
  void start(double t, const double* y, double* memory) const;
  /// Steady motion at the rates yDot up to t.
  void start(double t, const double* y, const double* yDot, double* memory) const;
  /// The motion is accepted up to t. Call at the end of every step.
  void append(double t, const double* y, const double* yDot, double* memory) const;
  /// y (and y' unless null) at the time t, not after the last append(). Throws ConvergenceError for
  /// a later time (a delay shorter than the step), ModelError for a time more than `span` earlier.
  void at(double t, const double* memory, double* y, double* yDot = nullptr) const;
  /// Time of the newest and of the oldest sample, and the newest y.
  double newest(const double* memory) const { return sample(memory, 0)[0]; }
  double oldest(const double* memory) const {
    return sample(memory, static_cast<int>(memory[0]) - 1)[0];
  }
  /// Raises samples from t0 to t1 >= t0 to at least the values of the line from (t0, y0) to (t1,
  /// y1); raised samples take its rate.
  void raise(double t0, const double* y0, double t1, const double* y1, double* memory) const;
  /// Smallest distance of samples.
  double spacing() const { return spacing_; }

 private:
  static constexpr int header = 2;  ///< number of samples, slot of the newest
  const double* sample(const double* memory, int age) const;

  int values_, samples_, row_;
  double spacing_;
  Shape shape_;
};

}  // namespace tooljoint::model
