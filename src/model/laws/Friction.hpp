// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Point laws whose friction can be left out.
#pragma once

#include <memory>
#include <vector>

#include "model/laws/PointLaw.hpp"

namespace tooljoint::model {

/// Beside PointLaw for laws with friction. The friction of a sliding contact depends on its normal
/// force but not the other way round: its tangent is not symmetric, and the symmetric part is
/// indefinite, so undamped modes are those of the law without it.
class Frictional {
 public:
  virtual ~Frictional() = default;
  /// The same law with its normal forces alone; null when no point has friction.
  virtual std::shared_ptr<const PointLaw> withoutFriction() const = 0;
  /// Power [W] that the prescribed motion behind the points feeds in against their friction:
  /// `friction`, where forces of all points stand as in evaluate(). 0 for walls at rest.
  virtual double drive(double t, const std::vector<int>& points, const double* friction) const = 0;
};

/// The law itself where it has no friction.
inline std::shared_ptr<const PointLaw> withoutFriction(const std::shared_ptr<const PointLaw>& law) {
  const auto* frictional = dynamic_cast<const Frictional*>(law.get());
  auto smooth = frictional != nullptr ? frictional->withoutFriction() : nullptr;
  return smooth ? smooth : law;
}

}  // namespace tooljoint::model
