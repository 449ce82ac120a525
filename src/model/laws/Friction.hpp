// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Point laws with separable friction.
#pragma once

#include <memory>
#include <vector>

#include "model/laws/PointLaw.hpp"

namespace tooljoint::model {

/// Added to PointLaw for laws with friction. The friction of a sliding contact depends on its
/// normal force, but not the other way round. Its tangent is unsymmetric and the symmetric part
/// indefinite, so undamped modes use the law without friction.
class Frictional {
 public:
  virtual ~Frictional() = default;
  /// The same law with only its normal forces; null if no point has friction.
  virtual std::shared_ptr<const PointLaw> withoutFriction() const = 0;
  /// Power [W] of the prescribed motion of the points against their friction forces `friction`, in
  /// the layout of evaluate() for all points. 0 for walls at rest.
  virtual double drive(double t, const std::vector<int>& points, const double* friction) const = 0;
};

/// The law without friction; the law itself if it has none.
inline std::shared_ptr<const PointLaw> withoutFriction(const std::shared_ptr<const PointLaw>& law) {
  const auto* frictional = dynamic_cast<const Frictional*>(law.get());
  auto smooth = frictional != nullptr ? frictional->withoutFriction() : nullptr;
  return smooth ? smooth : law;
}

}  // namespace tooljoint::model
