// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Point laws that depend on the rotary speed.
#pragma once

#include <memory>

#include "model/laws/PointLaw.hpp"

namespace tooljoint::model {

/// Beside PointLaw for laws whose points turn with the rotary speed: friction at a wall.
class Turning {
 public:
  virtual ~Turning() = default;
  /// The same law at a constant rotary speed [rad/s].
  virtual std::shared_ptr<const PointLaw> atSpeed(double speed) const = 0;
};

/// The law itself where it does not depend on the rotary speed.
inline std::shared_ptr<const PointLaw> atSpeed(const std::shared_ptr<const PointLaw>& law,
                                               double speed) {
  const auto* turning = dynamic_cast<const Turning*>(law.get());
  return turning != nullptr ? turning->atSpeed(speed) : law;
}

}  // namespace tooljoint::model
