// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/beam/VonMises.hpp"

#include <algorithm>
#include <cmath>

namespace tooljoint::beam {

double vonMises(const Section& section, double tension, double torque, double curvature) {
  double largest = 0.0;
  for (const double radius : {section.innerRadius(), section.outerRadius()}) {
    const double axial =
        std::abs(tension) / section.area() + section.youngModulus() * curvature * radius;
    const double shear = torque * radius / section.torsion();
    largest = std::max(largest, std::sqrt(axial * axial + 3.0 * shear * shear));
  }
  return largest;
}

}  // namespace tooljoint::beam
