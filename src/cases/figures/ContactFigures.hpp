// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Normal contact forces at points: mean, peak, fraction of time in contact.
#pragma once

#include <vector>

#include "cases/figures/SignalFigures.hpp"
#include "common/Types.hpp"

namespace tooljoint::cases {

class ContactFigures {
 public:
  explicit ContactFigures(Eigen::Index points)
      : sum_(Vector::Zero(points)), peak_(sum_), touching_(sum_) {}

  /// One sample: the force at every point [N]; a positive force means contact.
  void add(const Vector& forces);

  Vector mean() const { return overSamples(sum_); }  ///< 0 if open [N]
  const Vector& peak() const { return peak_; }       ///< [N]
  Vector duty() const { return overSamples(touching_); }

  void save(std::vector<double>& memory) const;
  void restore(const double*& memory);

 private:
  Vector overSamples(const Vector& sum) const;

  long samples_ = 0;
  Vector sum_, peak_, touching_;  ///< touching_: samples in contact
};

}  // namespace tooljoint::cases
