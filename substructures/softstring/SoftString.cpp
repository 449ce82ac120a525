// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/softstring/SoftString.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/Constants.hpp"
#include "substructures/softstring/Buckling.hpp"
#include "substructures/softstring/Pieces.hpp"

namespace tooljoint::softstring {
namespace {

/// Axial strain at which a string pushed from above counts as locked up: steel yields before.
constexpr double lockedStrain = 0.01;

}  // namespace

double sideForce(const well::WellPoint& point, double tension, double weight) {
  const Vector3 across = Vector3::UnitZ() - point.tangent.z() * point.tangent;
  return (tension * point.curvature + weight * across).norm();
}

double mudDrag(const beam::Section& section, double holeRadius, const Circulation& mud) {
  const double outer = section.outerRadius(), area = holeRadius * holeRadius - outer * outer;
  if (!mud.axialDrag || !(area > 0.0)) return 0.0;
  const double speed = mud.flowRate / (constants::pi * area);
  return mud.frictionCoefficient * mud.density * outer * speed * std::abs(speed);
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
    const double drag = mudDrag(own.section, hole.radius(middle), hole.mud);
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
      return State(-own.weight * down + mu * N * along + drag,
                   mu * N * own.frictionRadius * turning);
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
