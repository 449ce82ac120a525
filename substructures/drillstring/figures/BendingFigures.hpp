// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Cycles of the bending moment of a string that turns: rainflow counts and fatigue damage of every
/// element.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "cases/figures/Rainflow.hpp"
#include "common/Types.hpp"
#include "io/OutputParameters.hpp"

namespace tooljoint::drillstring {

/// Planes of the rotating pipe in which the moment is counted, over half a turn: the fibres at both
/// ends of a plane have the same ranges.
constexpr std::size_t kBendingPlanes = 4;

/// Bending of one element relative to the bent path, in its two lateral axes.
struct BendingElement {
  /// Curvature of the string on its path, with its bends straightened [1/m].
  Eigen::Vector2d pathCurvature = Eigen::Vector2d::Zero();
  /// theta x a of both ends in these axes, with the axis a of the cross section on the path and
  /// theta in the nodal frame. The spin of a section about its axis causes no bending.
  std::array<Eigen::Matrix<double, 2, 3>, 2> slope;
  double length = 0.0;           ///< [m]
  double rigidity = 0.0;         ///< E I [N m2]
  double stressPerMoment = 0.0;  ///< R/I at the outer wall [1/m3]
  double leastRange = 0.0;       ///< smaller cycles are not counted [N m]
};

/// E I times the turn of the axes of the cross sections a' = a + theta x a from node to node over
/// the length, in the axes of the element [N m]: the mean moment of element `index`. \param
/// displacement  6 per node in nodal frames
Eigen::Vector2d meanMoment(const BendingElement& element, std::size_t index,
                           const Vector& displacement);

/// Counts of one element: cycles in the plane with the largest range, and the damage in the worst
/// plane.
struct BendingCounts {
  double cycles = 0.0;
  double largestRange = 0.0;  ///< [N m]
  double damage = 0.0;        ///< fraction of the life; 0 without an S-N line
};

/// Cycles of the mean moment of the elements. A plane of the pipe at the angle alpha is turned by
/// phi = int Omega + theta_z; its moment is M_x cos(phi + alpha) + M_y sin(phi + alpha).
class BendingFigures {
 public:
  BendingFigures(std::vector<BendingElement> elements, std::optional<io::SnLine> line);

  /// \param displacement 6 per node in nodal frames \param angle int Omega dt [rad]
  void add(const Vector& displacement, double angle);

  /// Per element, as if the history ended here.
  std::vector<BendingCounts> counts() const;
  bool hasDamage() const { return line_.has_value(); }

  void save(std::vector<double>& memory) const;
  void restore(const double*& memory);

 private:
  struct Plane {
    cases::Rainflow rainflow;
    cases::CycleTotals totals;
  };
  using Planes = std::array<Plane, kBendingPlanes>;

  double exponent() const { return line_ ? line_->slope : 0.0; }
  void count(std::size_t element, const cases::LoadCycle& cycle, cases::CycleTotals& totals) const;
  double damage(std::size_t element, const cases::CycleTotals& totals) const;

  std::vector<BendingElement> elements_;
  std::optional<io::SnLine> line_;
  std::vector<Planes> planes_;
  std::array<double, kBendingPlanes> planeCosine_{}, planeSine_{};
};

}  // namespace tooljoint::drillstring
