// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drillstring/analyses/bottom_hole/BottomHoleState.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "common/Index.hpp"
#include "substructures/beam/NodalDofs.hpp"
#include "substructures/beam/VonMises.hpp"
#include "substructures/drillstring/SidedFeatures.hpp"
#include "substructures/well/Frames.hpp"

namespace tooljoint::drillstring {
namespace {

namespace nodal = beam::nodal;

/// The curvature at a node is that of the hole above it, which ends at the bit [m].
constexpr double justAbove = 1e-6;

class Findings {
 public:
  Findings(const Scene& part, const StaticStage& stage)
      : part_(part),
        stage_(stage),
        d_(stage.state.displacement),
        kinks_(kinks(part.string, stage.path)),
        last_(part.string.elementCount()) {
    const double mud = part.mud ? mud::readProperties(part.list().sublist("Mud")).density : 0.0;
    for (std::size_t e = 0; e < part.string.elements.size(); ++e) {
      const auto& section = part.string.elements[e].section();
      const auto& nodes = part.string.nodes;
      const Matrix3& triad = stage.path.elementFrame[e];
      weight_.push_back(
          (section.massPerLength() - mud * section.area()) * loads::acceleration(part.loads) +
          triad * loads::steadyBesideWeight(
                      part.loads, {section, triad, nodes[e].s, nodes[e + 1].s}, part.rotary));
    }
    for (int n = 0; n <= last_; ++n) {
      const Matrix3& frame = stage.path.frame[at(n)];
      const Vector3 high = well::highSide(frame.col(2));
      sides_.emplace_back();
      sides_.back() << high, frame.col(2).cross(high);
    }
  }

  BottomHoleState state(std::optional<double> surveyTool) const {
    BottomHoleState found;
    found.sideForce = -(wallForce(last_) + lateralReaction(last_));
    found.tilt = toSides(last_, slope(last_));
    if (surveyTool) found.sag = sagAt(part_.string.length() - *surveyTool);
    for (int n = last_; n >= 0; --n) found.stations.push_back(station(n));
    addBending(found);
    addGauges(found);
    checkBalance(found);
    found.stable = stage_.stability.stable();
    return found;
  }

 private:
  /// Converts components in the nodal frame to components to the sides.
  Sides toSides(int n, const Eigen::Vector2d& inFrame) const {
    return sides_[at(n)].transpose() * (stage_.path.frame[at(n)].leftCols<2>() * inFrame);
  }

  Eigen::Vector2d lateral(int n) const { return d_.segment<2>(nodal::perNode * n); }
  /// Axis of a section in the path state, in the nodal frame.
  Vector3 sectionAxis(int n) const { return stage_.path.axisInFrame(at(n)); }
  /// Slope of a section relative to the hole at its displaced position: that of the path state plus
  /// theta x axis, minus the turn kappa w of the hole. A string off the axis of a curved hole has a
  /// shorter or longer way than the axis, and slides along the hole.
  Eigen::Vector2d slope(int n) const {
    const Vector3 axis = sectionAxis(n);
    const Vector3 theta = d_.segment<3>(nodal::perNode * n + nodal::thetaX);
    const double depth = std::min(stage_.path.arcLength[at(n)], part_.well.length());
    const Vector3 curvature = part_.well.at(depth - justAbove).curvature;
    const Vector3 turn = stage_.path.frame[at(n)].transpose() * curvature;
    return (axis + theta.cross(axis) - d_(nodal::perNode * n + nodal::w) * turn).head<2>();
  }
  Sides wallForce(int n) const { return toSides(n, stage_.state.contactForce.col(n)); }
  Sides lateralReaction(int n) const {
    return toSides(n, stage_.state.reaction.segment<2>(nodal::perNode * n));
  }

  /// Rotation of a section, linear between nodes.
  Sides sagAt(double depth) const {
    const auto depths = part_.string.depths();
    const auto below = std::upper_bound(depths.begin(), depths.end(), depth) - depths.begin();
    const int lower = std::clamp(static_cast<int>(below), 1, last_);
    const double share =
        (depth - depths[at(lower - 1)]) / (depths[at(lower)] - depths[at(lower - 1)]);
    return (1.0 - share) * toSides(lower - 1, slope(lower - 1)) +
           share * toSides(lower, slope(lower));
  }

  BottomHoleStation station(int n) const {
    BottomHoleStation one;
    one.fromBit = part_.string.length() - part_.string.nodes[at(n)].s;
    one.deflection = toSides(n, lateral(n));
    one.clearance = part_.string.nodes[at(n)].clearance;
    one.wallForce = wallForce(n);
    return one;
  }

  /// D of an element with its bend, without spins of the sections about their axes, which cause no
  /// bending.
  beam::Vector12 bending(int e) const {
    beam::Vector12 d = d_.segment<12>(nodal::perNode * e);
    if (!kinks_.empty()) d += kinks_[at(e)];
    for (int end = 0; end < 2; ++end) {
      const Vector3 axis = sectionAxis(e + end);
      auto theta = d.segment<3>(nodal::perNode * end + nodal::thetaX);
      theta -= theta.dot(axis) * axis;
    }
    return d;
  }

  /// E I times the curvature vector at both ends of an element, global axes [N m]: that of the path
  /// state plus the end moments of K_a D minus those of the weight.
  std::array<Vector3, 2> endMoments(int e) const {
    const auto& path = stage_.path;
    const auto& element = *part_.string.elements[at(e)].formulation;
    const Matrix3& triad = path.elementFrame[at(e)];
    const auto turn = beam::rotation12(triad, path.frame[at(e)], path.frame[at(e + 1)]);
    const beam::Vector12 f = element.stiffness() * (turn * bending(e)) -
                             element.distributedLoad(triad.transpose() * weight_[at(e)]);
    // M_x = E I u'', M_y = E I v'' with theta = (-v', u')
    const Vector3 upper{-f(4), f(3), 0.0};
    const Vector3 lower{f(10), -f(9), 0.0};
    const beam::Vector12& onPath = path.force[at(e)];
    const Vector3 axis = triad.col(2);
    return {triad * upper - Vector3(onPath.segment<3>(3)).cross(axis),
            triad * lower + Vector3(onPath.segment<3>(9)).cross(axis)};
  }

  /// Moments at a node are the mean of both sides, stresses the larger value.
  void addBending(BottomHoleState& found) const {
    for (int e = 0; e < last_; ++e) {
      const auto moments = endMoments(e);
      const auto& section = part_.string.elements[at(e)].section();
      const double tension = stage_.path.axialForce(e) + stage_.state.axialForce(e);
      const double torque = stage_.path.torque(e) + stage_.state.torque(e);
      const double rigidity =
          section.youngModulus() * std::min(section.inertiaX(), section.inertiaY());
      for (int end = 0; end < 2; ++end) {
        const int n = e + end;
        const double share = n == 0 || n == last_ ? 1.0 : 0.5;
        auto& one = found.stations[at(last_ - n)];
        one.moment += share * (sides_[at(n)].transpose() * moments[at(end)]);
        one.axialForce += share * tension;
        one.torque += share * torque;
        one.vonMises = std::max(one.vonMises, beam::vonMises(section, tension, torque,
                                                             moments[at(end)].norm() / rigidity));
      }
    }
  }

  void addGauges(BottomHoleState& found) const {
    double highest = 0.0;  // gauge that touches, above the bit
    for (const auto& one : found.stations) {
      const int n = last_ - static_cast<int>(&one - found.stations.data());
      const Node& node = part_.string.nodes[at(n)];
      if (!node.gauge || n == last_ || n == 0) continue;
      found.gauges.push_back({node.component, one.fromBit, one.wallForce});
      if (one.wallForce.norm() > 0.0) highest = one.fromBit;
    }
    for (const auto& one : found.stations) {
      const int n = last_ - static_cast<int>(&one - found.stations.data());
      if (one.fromBit <= highest || part_.string.nodes[at(n)].gauge || n == 0) continue;
      if (!(one.wallForce.norm() > 0.0)) continue;
      found.tangency = one.fromBit;
      return;
    }
  }

  /// Displaced position of a node.
  Vector3 position(int n) const {
    return stage_.path.position[at(n)] +
           stage_.path.frame[at(n)] * d_.segment<3>(nodal::perNode * n);
  }

  /// Sum of the forces of walls, supports, pads, buoyed weight and weight on bit (in the direction
  /// of the hole at the bit), and the sum of their moments about the bit.
  void checkBalance(BottomHoleState& found) const {
    const auto& state = stage_.state;
    Vector3 force = Vector3::Zero(), moment = Vector3::Zero();
    double load = 0.0, turning = 0.0;
    const Vector3 bit = position(last_);
    const auto add = [&](const Vector3& where, const Vector3& one) {
      force += one;
      moment += (where - bit).cross(one);
      turning += (where - bit).cross(one).norm();
    };
    for (int n = 0; n <= last_; ++n) {
      const Matrix3& frame = stage_.path.frame[at(n)];
      Vector3 one = state.reaction.segment<3>(nodal::perNode * n);
      one.head<2>() += state.contactForce.col(n);
      add(position(n), frame * one);
      moment += frame * (state.reaction.segment<3>(nodal::perNode * n + nodal::thetaX) +
                         state.frictionTorque(n) * Vector3::UnitZ());
    }
    for (const auto& pad : part_.string.pads) {
      Vector3 one = Vector3::Zero();
      one.head<2>() = -pad.size * towardsSide(part_.string, stage_.path, pad.direction);
      add(position(pad.node), stage_.path.frame[at(pad.node)] * one);
    }
    for (int e = 0; e < last_; ++e) {
      const Vector3 one = part_.string.elements[at(e)].length() * weight_[at(e)];
      add(0.5 * (position(e) + position(e + 1)), one);
      load += one.norm();
    }
    const auto onBit = loads::pointLoads(part_.loads, part_.string.depths(), part_.rotary);
    for (const auto& one : onBit) {
      const Vector3 axis = stage_.path.frame[at(one.node - 1)].col(one.component % 3);
      if (one.component < nodal::thetaX)
        add(position(one.node - 1), one.value * axis), load += std::abs(one.value);
      else
        moment += one.value * axis;
    }
    found.forceDefect = load > 0.0 ? force.norm() / load : 0.0;
    found.momentDefect = turning > 0.0 ? moment.norm() / turning : 0.0;
  }

  const Scene& part_;
  const StaticStage& stage_;
  const Vector& d_;
  std::vector<beam::Vector12> kinks_;
  int last_;  ///< node at the bit, 0-based
  /// Buoyed weight and other loads per length of every element, global axes [N/m].
  std::vector<Vector3> weight_;
  std::vector<Eigen::Matrix<double, 3, 2>> sides_;  ///< high and right side at every node
};

}  // namespace

BottomHoleState bottomHoleState(const Scene& part, const StaticStage& stage,
                                std::optional<double> surveyTool) {
  return Findings(part, stage).state(surveyTool);
}

void addState(const BottomHoleState& one, BottomHoleState& sum) {
  sum.sideForce += one.sideForce;
  sum.tilt += one.tilt;
  sum.sag += one.sag;
  for (std::size_t i = 0; i < sum.gauges.size(); ++i) sum.gauges[i].force += one.gauges[i].force;
  for (std::size_t i = 0; i < sum.stations.size(); ++i) {
    auto& station = sum.stations[i];
    const auto& other = one.stations[i];
    station.deflection += other.deflection;
    station.wallForce += other.wallForce;
    station.moment += other.moment;
    station.axialForce += other.axialForce;
    station.torque += other.torque;
    station.vonMises = std::max(station.vonMises, other.vonMises);
  }
  sum.tangency = std::max(sum.tangency, one.tangency);
  sum.forceDefect = std::max(sum.forceDefect, one.forceDefect);
  sum.momentDefect = std::max(sum.momentDefect, one.momentDefect);
  sum.stable = sum.stable && one.stable;
}

void divideState(double count, BottomHoleState& sum) {
  sum.sideForce /= count;
  sum.tilt /= count;
  sum.sag /= count;
  for (auto& gauge : sum.gauges) gauge.force /= count;
  for (auto& station : sum.stations) {
    station.deflection /= count;
    station.wallForce /= count;
    station.moment /= count;
    station.axialForce /= count;
    station.torque /= count;
  }
}

}  // namespace tooljoint::drillstring
