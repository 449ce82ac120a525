// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A centre line of circular arcs and straight pieces; the base of the arc, straight and survey
/// trajectories.
#pragma once

#include <string>
#include <vector>

#include "substructures/well/Trajectory.hpp"

namespace tooljoint::well {

/// Unit tangent of a hole with this inclination from the vertical and this azimuth from X towards Y
/// [rad].
Vector3 direction(double inclination, double azimuth);

/// Chain of circular arcs with continuous tangent, started at the origin.
class ArcChain : public Trajectory {
 public:
  explicit ArcChain(const Vector3& firstTangent);
  /// Appends a straight piece [m]; no effect for zero length.
  void addStraight(double length);
  /// Appends the arc of this length [m] that turns the tangent to `tangent` in the plane of both
  /// (minimum curvature). The angle between them must be below pi.
  void addArc(double length, const Vector3& tangent);

  double length() const override { return length_; }
  WellPoint at(double s) const override;
  std::vector<double> breaks() const override;

 private:
  /// Tangent e1 cos(kappa x) + e2 sin(kappa x) at the distance x from the start of the piece.
  struct Piece {
    double start;
    double length;
    Vector3 position;
    Vector3 e1;
    Vector3 e2;
    double kappa;
  };
  static WellPoint evaluate(const Piece& piece, double x);
  void append(double length, const Vector3& e2, double kappa);

  std::vector<Piece> pieces_;
  double length_ = 0.0;
  Vector3 endPosition_ = Vector3::Zero();
  Vector3 endTangent_;
};

/// Stations from the numbers of a deck, three per station: measured depth, inclination and azimuth
/// in these units. Throws DeckError with one line "path:station: sentence" per fault, as
/// readSurveyTable.
std::vector<Station> surveyStations(const std::vector<double>& numbers, const std::string& path,
                                    const std::string& depthUnit, const std::string& angleUnit);

}  // namespace tooljoint::well
