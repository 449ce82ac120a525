// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The hole around the string: a centre line and a bore radius that may vary with depth. Deck list
/// `Well`.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "deck/ListSpec.hpp"
#include "substructures/well/Trajectory.hpp"

namespace tooljoint::well {

/// A section of the hole with its own radius (a casing, an open-hole section, a wash-out).
struct BoreInterval {
  std::string name;
  double from;    ///< measured depth [m]
  double to;      ///< measured depth [m]
  double radius;  ///< [m]
};

/// Centre line and bore radius.
class Well {
 public:
  /// Throws DeckError when intervals are empty, overlap or have no positive radius.
  Well(std::shared_ptr<const Trajectory> trajectory, double boreRadius,
       std::vector<BoreInterval> intervals = {});

  const Trajectory& trajectory() const { return *trajectory_; }
  double length() const { return trajectory_->length(); }
  WellPoint at(double s) const { return trajectory_->at(s); }
  /// Bore radius [m] at the depth s [m]; the smaller one at the boundary of two sections.
  double boreRadius(double s) const;
  /// Angle between the tangent and the vertical at the depth s [rad].
  double inclination(double s) const;
  const std::vector<BoreInterval>& intervals() const { return intervals_; }
  /// The bore below the depth `top` [m] about another centre line that starts there.
  Well below(double top, std::shared_ptr<const Trajectory> centreLine) const;
  /// The same about the original centre line.
  Well below(double top) const;

 private:
  std::shared_ptr<const Trajectory> trajectory_;
  double boreRadius_;
  std::vector<BoreInterval> intervals_;  // by depth
};

/// Description of the list `Well`.
deck::ListSpec parameters();

/// The well of a validated list `Well`; file names are relative to `folder`. Throws DeckError.
Well readWell(const Teuchos::ParameterList& list, const std::string& folder);

}  // namespace tooljoint::well
