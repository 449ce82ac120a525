// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The centre line of a well as a curve in arc length. Global axes: X north, Y east, Z down; the
/// curve starts at the origin, at the surface.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "common/Types.hpp"
#include "deck/Registry.hpp"

namespace Teuchos {
class ParameterList;
}

namespace tooljoint::well {

/// A point of the centre line.
struct WellPoint {
  Vector3 position;   ///< global X, Y, Z [m]
  Vector3 tangent;    ///< unit vector, pointing down the hole
  Vector3 curvature;  ///< d tangent / ds [1/m], normal to the tangent
};

/// Centre line of a well. It continues straight outside [0, length()], so that a depth off by
/// rounding is no special case.
class Trajectory {
 public:
  virtual ~Trajectory() = default;
  /// Length along the hole [m].
  virtual double length() const = 0;
  /// The point at arc length s [m] from the surface.
  virtual WellPoint at(double s) const = 0;
  /// Increasing depths [m] where the curvature jumps (survey stations, the kick-off point); none
  /// for a smooth curve.
  virtual std::vector<double> breaks() const { return {}; }
  /// Remarks for the user on the file of the trajectory: its interpretation and unread parts. One
  /// sentence each.
  const std::vector<std::string>& remarks() const { return remarks_; }
  void addRemark(const std::string& remark) { remarks_.push_back(remark); }

 private:
  std::vector<std::string> remarks_;
};

/// Trajectories by name. A variant gets its own sublist and the base folder of relative file names.
using TrajectoryRegistry =
    deck::Registry<Trajectory, const Teuchos::ParameterList&, const std::string&>;

/// Helix about a vertical axis, X = a cos p - a, Y = a sin p, Z = b p with b = sqrt((L/alpha)^2 -
/// a^2) and p = alpha s/L (Nguyen et al. 2020, eq. 44, with the parameter scaled to arc length).
/// Curvature a/(a^2+b^2). Throws DeckError when the length is too short for the angle (L < alpha
/// a).
std::unique_ptr<Trajectory> helix(double radius, double angle, double length);

/// Straight line with a constant inclination from the vertical and an azimuth from X towards Y
/// [rad].
std::unique_ptr<Trajectory> straight(double length, double inclination = 0.0, double azimuth = 0.0);

/// Planar arc: a straight part down to the kick-off depth, then a circular arc from one inclination
/// to another, then a straight tangent section. Lengths are along the hole.
struct ArcShape {
  double kickOffDepth = 0.0;      ///< length of the straight part above the arc [m]
  double radius = 0.0;            ///< radius of curvature [m]
  double startInclination = 0.0;  ///< [rad]
  double endInclination = 0.0;    ///< [rad]
  double azimuth = 0.0;           ///< [rad]
  double tangentLength = 0.0;     ///< length of the straight part below the arc [m]
};
std::unique_ptr<Trajectory> arc(const ArcShape& shape);

/// A survey station.
struct Station {
  double depth;        ///< measured depth [m]
  double inclination;  ///< [rad]
  double azimuth;      ///< [rad]
};
/// Minimum curvature: between two stations a circular arc in the plane of their tangents (Sawaryn
/// and Thorogood, SPE Drilling & Completion 20, 2005). At least two stations, the first at depth 0,
/// depths increasing, no reversal of 180 degrees; throws DeckError otherwise.
std::unique_ptr<Trajectory> minimumCurvature(const std::vector<Station>& stations);

/// Stations of a file, and remarks on its interpretation.
struct SurveyTable {
  std::vector<Station> stations;
  std::vector<std::string>
      remarks;  ///< unread columns, rows and comments; a separator other than the comma
};

/// Stations from a table (see splitDelimited): measured depth, inclination, azimuth, by default in
/// m and degrees. A header names the columns in any order, with units in brackets or in a row of
/// their own below it:
///
///     MD [ft], Inc [deg], Azi [deg]          MD;Inclination;Azimuth
///                                            m;°;°
///
/// Without a header the order is as above. Units: any length or angle of deck/Units.hpp. Decimal
/// commas are accepted if cells are separated by another character, but not mixed with decimal
/// points. Lines starting with # are comments. Throws DeckError with one line "file:line: sentence"
/// per fault.
SurveyTable readSurveyTable(const std::string& file, const std::string& depthUnit = "m",
                            const std::string& angleUnit = "deg");

/// Only the stations of readSurveyTable.
std::vector<Station> readSurvey(const std::string& file, const std::string& depthUnit = "m",
                                const std::string& angleUnit = "deg");

}  // namespace tooljoint::well
