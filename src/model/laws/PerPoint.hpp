// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Base of laws whose points have their own parameters.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/Error.hpp"
#include "common/Text.hpp"
#include "model/laws/PointLaw.hpp"

namespace tooljoint::model {

/// A batch of points of one law, each with its own parameters; `Law` is the class derived from it.
template <class Parameters, class Law>
class PerPoint : public PointLaw {
 public:
  explicit PerPoint(std::vector<Parameters> points) : points_(std::move(points)) {}
  int size() const override { return static_cast<int>(points_.size()); }
  int width() const override { return 1; }
  void clearanceLeft(const std::vector<int>& points, const double*, double* gap) const override {
    for (int p : points) gap[p] = 0.0;
  }
  std::shared_ptr<const PointLaw> subset(const std::vector<int>& points) const override {
    auto copy = std::make_shared<Law>(static_cast<const Law&>(*this));
    copy->points_.clear();
    for (int p : points) copy->points_.push_back(at(p));
    return copy;
  }

 protected:
  const Parameters& at(int point) const { return points_[static_cast<std::size_t>(point)]; }
  static void require(bool good, const std::string& what, double found,
                      const std::string& expected) {
    if (!good)
      throw ModelError("The " + what + " is " + formatNumber(found) + "; it must be " + expected +
                       ".");
  }

  std::vector<Parameters> points_;
};

}  // namespace tooljoint::model
