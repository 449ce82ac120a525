// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A point law on dofs of one node of the string. Displacements of the string are measured in a
/// moving frame: it turns with the set speed of the drive and advances with the block.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "model/laws/PointLaw.hpp"

namespace tooljoint::drilling {

/// Position and velocity of the frame in one coordinate at time t.
struct FramePosition {
  double position = 0.0;  ///< [m, rad]
  double velocity = 0.0;  ///< [m/s, rad/s]
};
using FrameMotion = std::function<FramePosition(double t)>;

/// Coordinate of a law on the string.
struct StringCoordinate {
  int component = 0;       ///< 0-based, of the node
  FrameMotion frame = {};  ///< none: the law acts on the displacement itself
  model::Channel channel;  ///< recorded quantity: `sign` times the force
  double sign = 1.0;
  double offset = 0.0;  ///< added to the recorded value
};

/// A recorded rate of a state of the law, with a constant added.
struct RateChannel {
  int state = 0;  ///< 0-based, of the rated ones
  model::Channel channel;
  double offset = 0.0;
};

/// A law at a node. StringModel adds it to the equations of motion.
struct PointOnString {
  std::string name;  ///< of the point set
  int node = 0;      ///< 0-based
  std::vector<int> components;
  std::shared_ptr<const model::PointLaw> law;
};

/// The law in total coordinates y = d + s(t), y' = v + s'(t). The channels of the coordinates come
/// first, then those of the rates. The power of the frame, -f s', is counted as power of the drive.
PointOnString onString(const std::string& name, int node,
                       const std::vector<StringCoordinate>& coordinates,
                       std::shared_ptr<const model::PointLaw> law,
                       const std::vector<RateChannel>& rates = {});

}  // namespace tooljoint::drilling
