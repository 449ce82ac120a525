// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drillstring/case/BendingElements.hpp"

#include <algorithm>
#include <string>

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

}  // namespace tooljoint::drillstring
