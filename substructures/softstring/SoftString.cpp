// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/softstring/SoftString.hpp"

#include <algorithm>
#include <cmath>

#include "common/Constants.hpp"
#include "substructures/softstring/Buckling.hpp"
#include "substructures/softstring/Pieces.hpp"

namespace tooljoint::softstring {
namespace {

/// Halvings to locate the start or end of a helix within a step: to nanometres.
constexpr int halvings = 32;

using State = Eigen::Vector2d;  // T, M

/// A step up the hole.
struct Step {
  State end;
  double twist = 0.0;       ///< over the step, integral of M/(G J) [rad]
  double stretching = 0.0;  ///< integral of T/(E A) [m]
};

/// The equations on one piece; only the helix is discontinuous there.
class PieceOfWay {
 public:
  PieceOfWay(const Piece& piece, const Stretch& own, const Hole& hole, const Operation& operation,
             bool helix)
      : piece_(piece),
        own_(own),
        hole_(hole),
        stiffness_(own.section.youngModulus() * own.section.inertiaX()) {
    const double middle = 0.5 * (piece.top + piece.bottom);
    const double around = operation.rotarySpeed * own.frictionRadius;
    const double speed = std::hypot(operation.axialSpeed, around),
                 mu = own.frictionFactor * hole.friction(middle);
    along_ = speed > 0.0 ? mu * operation.axialSpeed / speed : 0.0;
    turning_ = speed > 0.0 ? mu * around / speed : 0.0;
    drag_ = mudDrag(own.section, hole.radius(middle), hole.mud);
    clearance_ = hole.radius(middle) - own.section.outerRadius();
    mayBuckle_ = helix && clearance_ > 0.0;
  }

  bool isHelical(double s, double tension) const {
    return mayBuckle_ && tension < 0.0 &&
           -tension > helicalLimit(at(s), own_.weight, stiffness_, clearance_);
  }

  double sideForce(double s, double tension, bool helical) const {
    const double straight = softstring::sideForce(at(s), tension, own_.weight);
    return helical ? straight + helicalSideForce(-tension, stiffness_, clearance_) : straight;
  }

  /// Step from s by h < 0; the start or end of the helix is located within the step.
  Step step(double s, const State& from, double h) const {
    const bool helical = isHelical(s, from[0]);
    const Step whole = smooth(s, from, h, helical);
    if (isHelical(s + h, whole.end[0]) == helical) return whole;
    double before = 0.0, behind = h;
    for (int i = 0; i < halvings; ++i) {
      const double middle = 0.5 * (before + behind);
      const bool same = isHelical(s + middle, smooth(s, from, middle, helical).end[0]) == helical;
      (same ? before : behind) = middle;
    }
    const Step first = smooth(s, from, behind, helical),
               second = smooth(s + behind, first.end, h - behind, !helical);
    return {second.end, first.twist + second.twist, first.stretching + second.stretching};
  }

 private:
  well::WellPoint at(double s) const {
    return hole_.at(std::clamp(s, piece_.top + inside, piece_.bottom - inside));
  }

  State rate(double s, const State& y, bool helical) const {
    const double N = sideForce(s, y[0], helical);
    return {-own_.weight * at(s).tangent.z() + N * along_ + drag_,
            N * own_.frictionRadius * turning_};
  }

  /// Fourth-order Runge-Kutta.
  Step smooth(double s, const State& y, double h, bool helical) const {
    const State k1 = rate(s, y, helical), k2 = rate(s + 0.5 * h, y + 0.5 * h * k1, helical),
                k3 = rate(s + 0.5 * h, y + 0.5 * h * k2, helical),
                k4 = rate(s + h, y + h * k3, helical);
    const State end = y + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
    const State mean = y + h / 24.0 * (5.0 * k1 + 4.0 * k2 + 4.0 * k3 - k4);  // in mid-step
    const State integral = -h / 6.0 * (y + 4.0 * mean + end);
    return {end, integral[1] / own_.section.torsionalRigidity(),
            integral[0] / own_.section.axialRigidity()};
  }

  const Piece& piece_;
  const Stretch& own_;
  const Hole& hole_;
  double stiffness_;                     ///< E I [N m2]
  double along_ = 0.0, turning_ = 0.0;   ///< mu v_a/v, mu v_c/v
  double drag_ = 0.0, clearance_ = 0.0;  ///< d [N/m], r [m]
  bool mayBuckle_ = false;
};

}  // namespace

double sideForce(const well::WellPoint& point, double tension, double weight) {
  const Vector3 across = Vector3::UnitZ() - point.tangent.z() * point.tangent;
  return (tension * point.curvature + weight * across).norm();
}

double mudDrag(const beam::Section& section, double holeRadius, const Circulation& mud) {
  const double outer = section.outerRadius(), area = holeRadius * holeRadius - outer * outer;
  if (!mud.axialDrag || !(area > 0.0)) return 0.0;
  const double speed = mud.flowRate / (constants::pi * area);
  const double drag = mud.frictionCoefficient * mud.density * outer * speed * std::abs(speed);
  return mud.thrust ? drag * holeRadius / (holeRadius - outer) : drag;
}

Loads march(const std::vector<Stretch>& string, const Hole& hole, double bit,
            const Operation& operation, bool helix, double step) {
  Loads loads;
  State y(-operation.weightOnBit, -operation.torqueOnBit);
  for (const Piece& piece : pieces(string, hole, bit)) {
    const Stretch& own = string[static_cast<std::size_t>(piece.stretch)];
    const PieceOfWay way(piece, own, hole, operation, helix);
    const auto keep = [&](double s) {
      loads.depth.push_back(s);
      loads.tension.push_back(y[0]);
      loads.torque.push_back(y[1]);
      loads.sideForce.push_back(way.sideForce(s, y[0], way.isHelical(s, y[0])));
      loads.stretch.push_back(piece.stretch);
    };
    const double length = piece.bottom - piece.top;
    const int steps = std::max(1, static_cast<int>(std::ceil(length / step)));
    const double h = -length / steps;
    for (int k = 0; k < steps; ++k) {
      const double s = piece.bottom + k * h;
      keep(s);
      const Step taken = way.step(s, y, h);
      loads.twist += taken.twist;
      loads.stretching += taken.stretching;
      y = taken.end;
      const double strain = -y[0] / own.section.axialRigidity();
      if (!(strain <= lockedStrain)) {  // the side force may have become infinite within the step
        loads.lockUpDepth = s + h;
        return loads;
      }
    }
    keep(piece.top);
  }
  return loads;
}

}  // namespace tooljoint::softstring
