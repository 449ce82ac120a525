// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/beam/VonMises.hpp"

#include <algorithm>
#include <cmath>

namespace tooljoint::beam {

double vonMises(const Section& section, double tension, double torque, double curvature,
                double pressure) {
  const double inner = std::pow(section.innerRadius(), 2),
               outer = std::pow(section.outerRadius(), 2);
  double largest = 0.0;
  for (const double radius : {section.innerRadius(), section.outerRadius()}) {
    const double axial =
        std::abs(tension) / section.area() + section.youngModulus() * curvature * radius;
    const double shear = torque * radius / section.torsion();
    // b/R^2 at the inner and at the outer wall; a bar has no pressure inside
    const double other = radius == section.innerRadius() ? outer : inner;
    const double wall = inner > 0.0 ? pressure * other / (outer - inner) : 0.0;
    largest = std::max(largest, std::sqrt(axial * axial + 3.0 * wall * wall + 3.0 * shear * shear));
  }
  return largest;
}

}  // namespace tooljoint::beam
