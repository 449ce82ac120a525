// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drillstring/SidedFeatures.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "common/Index.hpp"
#include "substructures/well/Frames.hpp"

namespace tooljoint::drillstring {

namespace nodal = beam::nodal;

Eigen::Vector2d towardsSide(const DrillString& string, const path::PathState& path,
                            double direction) {
  const Matrix3& bit = path.frame.back();
  const Eigen::Vector2d high = (bit.transpose() * well::highSide(bit.col(2))).head<2>();
  const Eigen::Vector2d right(-high.y(), high.x());
  const double angle = string.toolFace + direction;
  return std::cos(angle) * high + std::sin(angle) * right;
}

std::vector<beam::Vector12> kinks(const DrillString& string, const path::PathState& path) {
  if (string.bends.empty()) return {};
  std::vector<beam::Vector12> turned(string.elements.size(), beam::Vector12::Zero());
  for (const auto& bend : string.bends) {
    // theta x z = (theta_y, -theta_x) points to that side
    const Eigen::Vector2d slope = bend.size * towardsSide(string, path, bend.direction);
    turned[at(bend.node)](nodal::thetaX) -= slope.y();
    turned[at(bend.node)](nodal::thetaY) += slope.x();
  }
  return turned;
}

std::vector<Eigen::Vector2d> gaugeOffsets(const DrillString& string, const path::PathState& path,
                                          const contact::ContactPoints& points) {
  if (string.eccentricGauges.empty()) return {};
  std::vector<Eigen::Vector2d> offsets(points.node.size(), Eigen::Vector2d::Zero());
  for (const auto& gauge : string.eccentricGauges) {
    const auto found = std::find(points.node.begin(), points.node.end(), gauge.node + 1);
    if (found == points.node.end()) continue;
    offsets[at(found - points.node.begin())] +=
        gauge.size * towardsSide(string, path, gauge.direction);
  }
  return offsets;
}

void addPads(const DrillString& string, const path::PathState& path, PathEquations& equations) {
  if (string.pads.empty()) return;
  Vector load = Vector::Zero(equations.load.size());
  for (const auto& pad : string.pads)
    load.segment<2>(kNodeDofs * pad.node) -= pad.size * towardsSide(string, path, pad.direction);
  equations.load += load;
  auto& model = equations.model;
  model.loads.push_back({"pad", model.lawIndex(model::ScalarLaw::one()), std::move(load)});
}

}  // namespace tooljoint::drillstring
