// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Results for one static state of a buckled string, and the theoretical values.
#pragma once

#include <vector>

#include "substructures/drillstring/buckling/BucklingPath.hpp"
#include "substructures/drillstring/scene/Stages.hpp"
#include "substructures/equilibrium/StaticProblem.hpp"

namespace tooljoint::drillstring {

/// Evaluates states of one string on its path.
class BucklingMeasure {
 public:
  /// All must outlive the object.
  /// \param input  with the walls of the path
  BucklingMeasure(const Scene& scene, const path::PathState& path,
                  const equilibrium::StaticInput& input, const equilibrium::StaticProblem& problem);

  /// \param displacement  6 per node, from the unloaded string
  BucklingState state(double weight, const Vector& displacement) const;
  /// \param tension of each element without weight on bit [N]
  BucklingTheory theory(const Vector& tension) const;

  /// Per element: E I [N m2], mean radial clearance of its nodes [m].
  const std::vector<double>& rigidity() const { return rigidity_; }
  const std::vector<double>& clearance() const { return clearance_; }
  /// True if gravity presses the string to a side of the hole.
  bool liesLow() const;

 private:
  Matrix toSides(const Vector& displacement) const;
  double shortening(int element, const Vector& displacement) const;
  void addShape(BucklingState& state) const;
  /// Top of the compressed part above the bit; 0 without compression there [m].
  double neutralDepth(const BucklingState& state) const;
  void addMiddle(const Vector& displacement, BucklingState& state) const;

  const Scene& scene_;
  const path::PathState& path_;
  const equilibrium::StaticInput& input_;
  const equilibrium::StaticProblem& problem_;
  std::vector<double> depth_, weight_, rigidity_, clearance_;
  std::vector<beam::Matrix12> unitAxial_;  ///< K_gF of each element per unit tension
};

}  // namespace tooljoint::drillstring
