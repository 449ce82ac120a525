// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Damped modes followed from one rotary speed to the next by their shapes.
#pragma once

#include <complex>
#include <functional>
#include <vector>

#include "common/Types.hpp"

namespace tooljoint::response {

/// Modes that vibrate (Im s > 0), by |s|.
struct VibratingModes {
  Eigen::VectorXcd values;  ///< s [1/s]
  Eigen::MatrixXcd shapes;
};

/// A mode on its way through the speeds.
struct TrackedMode {
  int track = 0;           ///< number, from 1 in the order of first appearance
  std::complex<double> s;  ///< [1/s]
  Eigen::VectorXcd shape;
  double mac = 1.0;  ///< least MAC of the steps since the last advance()
};

/// Follows the lowest modes. From speed to speed a mode goes on as the one with the largest MAC
/// (M-weighted, estimate::modalAssurance; repeated values as subspaces, estimate::matchModes). A
/// step over which a MAC falls below 0.9 is halved, five times at most; what then has less than 0.3
/// ends. A mode that is new among the lowest ones begins a track.
class ModeTracker {
 public:
  /// The modes at a speed [rad/s]: at least `count` where there are so many.
  using Modes = std::function<VibratingModes(double speed, int count)>;

  /// \param mass   of the shapes
  /// \param count  modes at least followed
  ModeTracker(Modes modes, Sparse mass, int count);

  /// Goes on to this speed, by |s| at the first call.
  void advance(double speed);
  double speed() const { return speed_; }
  const std::vector<TrackedMode>& now() const { return now_; }

 private:
  void step(double speed, int halvings);
  /// Positions among the candidates of the modes of now, -1 for none, and their MACs.
  struct Partners {
    std::vector<int> candidate;
    std::vector<double> mac;
    double least = 1.0;
  };
  Partners match(const VibratingModes& candidates) const;
  void start(const VibratingModes& candidates, const std::vector<int>& taken);

  Modes modes_;
  Sparse mass_;
  int count_;
  int tracks_ = 0;
  double speed_ = 0.0;
  bool started_ = false;
  std::vector<TrackedMode> now_;
};

}  // namespace tooljoint::response
