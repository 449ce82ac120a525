// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/well/ArcChain.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace tooljoint::well {

Vector3 direction(double inclination, double azimuth) {
  return {std::sin(inclination) * std::cos(azimuth), std::sin(inclination) * std::sin(azimuth),
          std::cos(inclination)};
}

ArcChain::ArcChain(const Vector3& firstTangent) : endTangent_(firstTangent.normalized()) {}

void ArcChain::addStraight(double length) {
  if (length > 0.0) append(length, Vector3::Zero(), 0.0);
}

void ArcChain::addArc(double length, const Vector3& tangent) {
  // beta = angle between the tangents; e2 = unit vector in their plane, normal to the first
  const Vector3 normal = endTangent_.cross(tangent);
  const double beta = std::atan2(normal.norm(), endTangent_.dot(tangent));
  if (beta < 1e-14) {
    append(length, Vector3::Zero(), 0.0);
    return;
  }
  append(length, normal.cross(endTangent_).normalized(), beta / length);
  endTangent_ = tangent.normalized();
}

void ArcChain::append(double length, const Vector3& e2, double kappa) {
  pieces_.push_back({length_, length, endPosition_, endTangent_, e2, kappa});
  const WellPoint end = evaluate(pieces_.back(), length);
  length_ += length;
  endPosition_ = end.position;
  endTangent_ = end.tangent;
}

WellPoint ArcChain::evaluate(const Piece& piece, double x) {
  if (piece.kappa == 0.0) return {piece.position + x * piece.e1, piece.e1, Vector3::Zero()};
  // int cos(kappa x) = sin(kappa x)/kappa, int sin(kappa x) = 2 sin^2(kappa x/2)/kappa
  const double angle = piece.kappa * x;
  const double sine = std::sin(angle);
  const double cosine = std::cos(angle);
  const double half = std::sin(0.5 * angle);
  return {piece.position + (sine * piece.e1 + 2.0 * half * half * piece.e2) / piece.kappa,
          (cosine * piece.e1 + sine * piece.e2).normalized(),
          piece.kappa * (cosine * piece.e2 - sine * piece.e1)};
}

WellPoint ArcChain::at(double s) const {
  if (s < 0.0) return {s * pieces_.front().e1, pieces_.front().e1, Vector3::Zero()};
  if (s > length_)
    return {endPosition_ + (s - length_) * endTangent_, endTangent_, Vector3::Zero()};
  // the last piece that starts at or above s
  auto next = std::upper_bound(pieces_.begin(), pieces_.end(), s,
                               [](double depth, const Piece& p) { return depth < p.start; });
  const Piece& piece = *std::prev(next);
  return evaluate(piece, s - piece.start);
}

std::vector<double> ArcChain::breaks() const {
  std::vector<double> depths;
  for (std::size_t i = 1; i < pieces_.size(); ++i) depths.push_back(pieces_[i].start);
  return depths;
}

}  // namespace tooljoint::well
