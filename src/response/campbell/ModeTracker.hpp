// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Tracks damped modes from one rotary speed to the next by their shapes.
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
  std::vector<int> wanted;  ///< positions of the modes to follow from here on
  std::vector<int> edge;    ///< positions of modes at the edge of a window, which may leave it
};

/// A tracked mode at the present speed.
struct TrackedMode {
  int track = 0;           ///< number, from 1 in the order of first appearance
  std::complex<double> s;  ///< [1/s]
  Eigen::VectorXcd shape;
  double mac = 1.0;   ///< smallest MAC of the steps since the last advance()
  bool edge = false;  ///< it may leave the window of frequencies

  template <class Archive>
  void serialize(Archive& archive) {
    archive(track, s, shape, mac, edge);
  }
};

/// Tracks modes. From speed to speed a mode continues as the one with the largest MAC (M-weighted,
/// estimate::modalAssurance; repeated values as subspaces, estimate::matchModes). A step with a MAC
/// below 0.9 is halved, at most five times; a mode that then has less than 0.3 ends. A new wanted
/// mode begins a track. Modes at the edge of a window end without smaller steps.
class ModeTracker {
 public:
  /// The modes at a speed [rad/s], somewhat more than the `followed` and the wanted ones.
  using Modes = std::function<VibratingModes(double speed, int followed)>;

  /// \param mass   of the shapes
  ModeTracker(Modes modes, const Sparse& mass);

  /// Advances to this speed; the first call numbers the modes by |s|.
  void advance(double speed);
  double speed() const { return at_.speed; }
  const std::vector<TrackedMode>& now() const { return at_.now; }

  /// The state of the tracking, to continue in another run.
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
  /// For each current mode its position among the candidates, -1 for none, and the MACs.
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
