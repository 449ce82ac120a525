// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/beam/VonMises.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace VonMisesTest {

using namespace tooljoint::beam;

TEST(VonMises, IsTheAxialStressTheBendingStressOrTheShearOfAPipe) {
  const Section pipe = Section::hollow(0.0635, 0.0543, Material{});
  EXPECT_DOUBLE_EQ(vonMises(pipe, -1e5, 0.0, 0.0), 1e5 / pipe.area());
  EXPECT_DOUBLE_EQ(vonMises(pipe, 0.0, 0.0, 1e-3), 2.1e11 * 1e-3 * 0.0635) << "at the outer wall";
  EXPECT_NEAR(vonMises(pipe, 0.0, 5e3, 0.0), std::sqrt(3.0) * 5e3 * 0.0635 / pipe.torsion(), 1e-6);
  EXPECT_DOUBLE_EQ(vonMises(pipe, 1e5, 5e3, 1e-3),
                   std::hypot(1e5 / pipe.area() + 2.1e11 * 1e-3 * 0.0635,
                              std::sqrt(3.0) * 5e3 * 0.0635 / pipe.torsion()));
}

/// From the six stresses: axial by true tension and bending, radial and around by Lame, shear.
double fromStresses(double outer, double inner, double tension, double inside, double outside,
                    double torque, double curvature, double radius) {
  const Section pipe = Section::hollow(outer, inner, Material{});
  const double area = M_PI * (outer * outer - inner * inner);
  const double trueTension =
      tension + inside * M_PI * inner * inner - outside * M_PI * outer * outer;
  const double a =
      (inside * inner * inner - outside * outer * outer) / (outer * outer - inner * inner);
  const double b =
      (inside - outside) * std::pow(inner * outer, 2) / (outer * outer - inner * inner);
  const double radial = a - b / (radius * radius), hoop = a + b / (radius * radius);
  const double shear = torque * radius / pipe.torsion();
  double largest = 0.0;
  for (const double side : {-1.0, 1.0}) {
    const double axial = trueTension / area + side * 2.1e11 * curvature * radius;
    largest =
        std::max(largest, std::sqrt(0.5 * (std::pow(axial - radial, 2) +
                                           std::pow(radial - hoop, 2) + std::pow(hoop - axial, 2)) +
                                    3.0 * shear * shear));
  }
  return largest;
}

TEST(VonMises, IsThatOfAThickWallUnderPressureTensionBendingAndTorsion) {
  const double outer = 0.0635, inner = 0.0543;
  const Section pipe = Section::hollow(outer, inner, Material{});
  for (const double tension : {-2e5, 9e5})
    for (const double inside : {3e7, 9e7}) {
      const double outside = 4e7, torque = 1.2e4, curvature = 5e-3;
      const double expected =
          std::max(fromStresses(outer, inner, tension, inside, outside, torque, curvature, inner),
                   fromStresses(outer, inner, tension, inside, outside, torque, curvature, outer));
      EXPECT_NEAR(vonMises(pipe, tension, torque, curvature, inside - outside), expected,
                  1e-9 * expected);
    }
  // the stress of pressure alone is largest inside, where the wall carries p in its plane and p
  // across it
  EXPECT_NEAR(vonMises(pipe, 0.0, 0.0, 0.0, 3e7),
              std::sqrt(3.0) * 3e7 * outer * outer / (outer * outer - inner * inner), 1e-3);
}

TEST(VonMises, LeavesTheInsideOfABarWithoutPressure) {
  EXPECT_DOUBLE_EQ(vonMises(Section::hollow(0.05, 0.0, Material{}), 0.0, 0.0, 0.0, 3e7), 0.0);
}

}  // namespace VonMisesTest
