// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Damped modes followed from one rotary speed to the next by their shapes.
#pragma once

#include <complex>
#include <functional>
#include <utility>
#include <vector>

#include "common/Message.hpp"
#include "common/Types.hpp"

namespace tooljoint::response {

/// Modes that vibrate (Im s > 0), by |s|.
struct VibratingModes {
  Eigen::VectorXcd values;  ///< s [1/s]
  Eigen::MatrixXcd shapes;
  std::vector<int> wanted;  ///< positions of those that are followed from here on
  std::vector<int> edge;    ///< positions of those at the edge of a window: they may leave it
};

/// A mode on its way through the speeds.
struct TrackedMode {
  int track = 0;           ///< number, from 1 in the order of first appearance
  std::complex<double> s;  ///< [1/s]
  Eigen::VectorXcd shape;
  double mac = 1.0;   ///< least MAC of the steps since the last advance()
  bool edge = false;  ///< it may leave the window of frequencies

  template <class Archive>
  void serialize(Archive& archive) {
    archive(track, s, shape, mac, edge);
  }
};

/// Follows modes. From speed to speed a mode goes on as the one with the largest MAC
/// (M-weighted, estimate::modalAssurance; repeated values as subspaces, estimate::matchModes). A
/// step over which a MAC falls below 0.9 is halved, five times at most; what then has less than 0.3
/// ends. A wanted mode that is new begins a track. Modes at the edge of a window end without
/// smaller steps.
class ModeTracker {
 public:
  /// The modes at a speed [rad/s], some more than the `followed` ones and the wanted.
  using Modes = std::function<VibratingModes(double speed, int followed)>;

  /// \param mass   of the shapes
  ModeTracker(Modes modes, const Sparse& mass);

  /// Goes on to this speed, by |s| at the first call.
  void advance(double speed);
  double speed() const { return at_.speed; }
  const std::vector<TrackedMode>& now() const { return at_.now; }

  /// Where it is on its way, to go on from in another run.
  struct Position {
    int tracks = 0;
    double speed = 0.0;
    bool started = false;
    std::vector<TrackedMode> now;

    template <class Archive>
    void serialize(Archive& archive) {
      archive(tracks, speed, started, now);
    }
  };
  const Position& position() const { return at_; }
  void goOnFrom(Position position) { at_ = std::move(position); }

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
  Position at_;
};

}  // namespace tooljoint::response
