// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/softstring/SoftString.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/Error.hpp"
#include "common/Text.hpp"
#include "substructures/softstring/Buckling.hpp"

namespace tooljoint::softstring {
namespace {

/// Points nearer to an end of an interval than this are taken from inside it [m].
constexpr double inside = 1e-7;
/// Axial strain at which a string pushed from above counts as locked up: steel yields before.
constexpr double lockedStrain = 0.01;

/// A piece of the way up in which nothing jumps.
struct Piece {
  double top, bottom;  ///< measured depths [m]
  int stretch;
};

/// The string below the surface in pieces, from the bit up.
std::vector<Piece> pieces(const std::vector<Stretch>& string, const Hole& hole, double bit) {
  std::vector<double> jumps = hole.breaks;
  std::sort(jumps.begin(), jumps.end());
  std::vector<Piece> found;
  double bottom = bit;
  for (std::size_t i = string.size(); i-- > 0 && bottom > 0.0;) {
    double top = bottom - string[i].length;
    if (top < inside) top = 0.0;
    for (double low = bottom; low > top;) {
      auto next = std::lower_bound(jumps.begin(), jumps.end(), low - inside);
      const double high = next == jumps.begin() ? top : std::max(top, *std::prev(next));
      found.push_back({high, low, static_cast<int>(i)});
      low = high;
    }
    bottom = top;
  }
  if (bottom > inside)
    throw ModelError("The string ends " + formatNumber(bottom) +
                     " m below the surface when its bit is at " + formatNumber(bit) +
                     " m. Give it more pipe, or a smaller depth of the bit.");
  return found;
}

}  // namespace

double sideForce(const well::WellPoint& point, double tension, double weight) {
  const Vector3 across = Vector3::UnitZ() - point.tangent.z() * point.tangent;
  return (tension * point.curvature + weight * across).norm();
}

Loads march(const std::vector<Stretch>& string, const Hole& hole, double bit,
            const Operation& operation, bool helix, double step) {
  using State = Eigen::Vector2d;  // T, M
  Loads loads;
  State y(-operation.weightOnBit, -operation.torqueOnBit);
  for (const Piece& piece : pieces(string, hole, bit)) {
    const Stretch& own = string[static_cast<std::size_t>(piece.stretch)];
    const double stiffness = own.section.youngModulus() * own.section.inertiaX();
    const double around = operation.rotarySpeed * own.frictionRadius;
    const double speed = std::hypot(operation.axialSpeed, around);
    const double along = speed > 0.0 ? operation.axialSpeed / speed : 0.0;
    const double turning = speed > 0.0 ? around / speed : 0.0;
    const double middle = 0.5 * (piece.top + piece.bottom);
    const double mu = hole.friction(middle);
    const double clearance = hole.radius(middle) - own.section.outerRadius();

    const auto normal = [&](double s, double tension) {
      const auto point = hole.at(std::clamp(s, piece.top + inside, piece.bottom - inside));
      double N = sideForce(point, tension, own.weight);
      if (helix && tension < 0.0 && clearance > 0.0 &&
          -tension > helicalLimit(point, own.weight, stiffness, clearance))
        N += helicalSideForce(-tension, stiffness, clearance);
      return std::make_pair(N, point.tangent.z());
    };
    const auto rate = [&](double s, const State& at) {
      const auto [N, down] = normal(s, at[0]);
      return State(-own.weight * down + mu * N * along, mu * N * own.frictionRadius * turning);
    };

    const double length = piece.bottom - piece.top;
    const int steps = std::max(1, static_cast<int>(std::ceil(length / step)));
    const double h = -length / steps;
    for (int k = 0; k < steps; ++k) {
      const double s = piece.bottom + k * h;
      loads.depth.push_back(s);
      loads.tension.push_back(y[0]);
      loads.torque.push_back(y[1]);
      loads.sideForce.push_back(normal(s, y[0]).first);
      loads.stretch.push_back(piece.stretch);
      const State k1 = rate(s, y), k2 = rate(s + 0.5 * h, y + 0.5 * h * k1),
                  k3 = rate(s + 0.5 * h, y + 0.5 * h * k2), k4 = rate(s + h, y + h * k3);
      const State next = y + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
      const State mean = y + h / 24.0 * (5.0 * k1 + 4.0 * k2 + 4.0 * k3 - k4);  // half a step on
      loads.twist += -h / 6.0 * (y[1] + 4.0 * mean[1] + next[1]) / own.section.torsionalRigidity();
      loads.stretching += -h / 6.0 * (y[0] + 4.0 * mean[0] + next[0]) / own.section.axialRigidity();
      y = next;
      const double strain = -y[0] / own.section.axialRigidity();
      if (!(strain <= lockedStrain)) {  // the side force may have become infinite within the step
        loads.lockUpDepth = s + h;
        return loads;
      }
    }
    loads.depth.push_back(piece.top);
    loads.tension.push_back(y[0]);
    loads.torque.push_back(y[1]);
    loads.sideForce.push_back(normal(piece.top, y[0]).first);
    loads.stretch.push_back(piece.stretch);
  }
  return loads;
}

}  // namespace tooljoint::softstring
