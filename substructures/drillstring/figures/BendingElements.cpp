// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drillstring/figures/BendingElements.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>

#include "substructures/beam/NodalDofs.hpp"
#include "substructures/drillstring/SidedFeatures.hpp"

namespace tooljoint::drillstring {
namespace {

/// Strain range of the smallest counted bending cycle: 0.2 MPa in steel. Smaller ones are rounding
/// errors of a string at rest.
constexpr double leastStrainRange = 1e-6;

/// theta x a = -[a] theta, theta in the nodal frame
Eigen::Matrix<double, 2, 3> slopeOf(const Eigen::Matrix<double, 3, 2>& axes, const Vector3& a,
                                    const Matrix3& frame) {
  Matrix3 cross;
  cross << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
  return -axes.transpose() * cross * frame;
}

}  // namespace

std::vector<BendingElement> bendingElements(const DrillString& string,
                                            const path::PathState& path) {
  const auto bends = kinks(string, path);
  std::vector<BendingElement> out;
  for (std::size_t e = 0; e < string.elements.size(); ++e) {
    const auto& section = string.elements[e].section();
    const Eigen::Matrix<double, 3, 2> axes = path.elementFrame[e].leftCols<2>();
    BendingElement one;
    one.length = string.elements[e].length();
    for (std::size_t end : {0, 1})
      one.slope[end] = slopeOf(axes, path.sectionAxis[e + end], path.frame[e + end]);
    Eigen::Vector2d turn = axes.transpose() * (path.sectionAxis[e + 1] - path.sectionAxis[e]);
    if (!bends.empty())
      turn += one.slope[1] * bends[e].segment<3>(beam::nodal::perNode + beam::nodal::thetaX) -
              one.slope[0] * bends[e].segment<3>(beam::nodal::thetaX);
    one.pathCurvature = turn / one.length;
    const double inertia = std::max(section.inertiaX(), section.inertiaY());
    one.rigidity = section.youngModulus() * inertia;
    one.stressPerMoment = section.outerRadius() / inertia;
    if (section.outerRadius() > 0.0)
      one.leastRange = leastStrainRange * one.rigidity / section.outerRadius();
    out.push_back(one);
  }
  return out;
}

/// M = E I/l (theta2 x a2 - theta1 x a1)
std::vector<cases::BendingPlace> bendingPlaces(const DrillString& string,
                                               const path::PathState& path,
                                               const std::vector<int>& belowReleases) {
  constexpr std::array components{beam::nodal::thetaX, beam::nodal::thetaY, beam::nodal::thetaZ};
  std::vector<cases::BendingPlace> out;
  const auto elements = bendingElements(string, path);
  for (std::size_t number = 0; number < elements.size(); ++number) {
    const bool next = std::binary_search(belowReleases.begin(), belowReleases.end(), number);
    const std::size_t e = next ? number + 1 : number;
    const auto& element = elements[e];
    const double stiffness = element.rigidity / element.length;
    cases::BendingPlace place;
    place.depth = 0.5 * (string.nodes[number].s + string.nodes[number + 1].s);
    place.stressPerMoment = element.stressPerMoment;
    for (std::size_t axis : {0, 1})
      for (std::size_t end : {0, 1})
        for (std::size_t c = 0; c < components.size(); ++c)
          place.moment[axis].push_back(
              {static_cast<std::int64_t>(e + end + 1), components[c],
               (end == 1 ? stiffness : -stiffness) *
                   element.slope[end](static_cast<int>(axis), static_cast<int>(c))});
    out.push_back(place);
  }
  return out;
}

}  // namespace tooljoint::drillstring
