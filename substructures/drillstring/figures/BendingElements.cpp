// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drillstring/figures/BendingElements.hpp"

#include <algorithm>
#include <string>

#include "substructures/beam/NodalDofs.hpp"

namespace tooljoint::drillstring {
namespace {

/// Strain range of the smallest bending cycle that counts: 0.2 MPa in steel. Smaller ones are
/// rounding errors of a string at rest.
constexpr double leastStrainRange = 1e-6;

}  // namespace

std::vector<BendingElement> bendingElements(const DrillString& string,
                                            const path::PathState& path) {
  std::vector<BendingElement> out;
  for (std::size_t e = 0; e < string.elements.size(); ++e) {
    const auto& section = string.elements[e].section();
    const Eigen::Matrix<double, 3, 2> axes = path.elementFrame[e].leftCols<2>();
    BendingElement one;
    one.length = string.elements[e].length();
    const Eigen::Vector2d curvature =
        axes.transpose() * (path.frame[e + 1].col(2) - path.frame[e].col(2)) / one.length;
    one.pathCurvature = {curvature[0], curvature[1]};
    for (std::size_t end : {0, 1})
      one.slopeRotation[end] = axes.transpose() * path.frame[e + end].leftCols<2>();
    const double inertia = std::max(section.inertiaX(), section.inertiaY());
    one.rigidity = section.youngModulus() * inertia;
    one.stressPerMoment = section.outerRadius() / inertia;
    if (section.outerRadius() > 0.0)
      one.leastRange = leastStrainRange * one.rigidity / section.outerRadius();
    out.push_back(one);
  }
  return out;
}

/// M = E I/l (R2 t2 - R1 t1), t = (theta_y, -theta_x)
std::vector<cases::BendingPlace> bendingPlaces(const DrillString& string,
                                               const path::PathState& path) {
  std::vector<cases::BendingPlace> out;
  const auto elements = bendingElements(string, path);
  for (std::size_t e = 0; e < elements.size(); ++e) {
    const auto& element = elements[e];
    cases::BendingPlace place;
    place.depth = 0.5 * (string.nodes[e].s + string.nodes[e + 1].s);
    place.stressPerMoment = element.stressPerMoment;
    for (std::size_t axis : {0, 1})
      for (std::size_t end : {0, 1}) {
        const auto node = static_cast<std::int64_t>(e + end + 1);
        const Eigen::RowVector2d turn = (end == 1 ? 1.0 : -1.0) * element.rigidity /
                                        element.length *
                                        element.slopeRotation[end].row(static_cast<int>(axis));
        place.moment[axis].push_back({node, beam::nodal::thetaY, turn[0]});
        place.moment[axis].push_back({node, beam::nodal::thetaX, -turn[1]});
      }
    out.push_back(place);
  }
  return out;
}

}  // namespace tooljoint::drillstring
