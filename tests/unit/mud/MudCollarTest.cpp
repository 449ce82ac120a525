// SPDX-License-Identifier: BSD-3-Clause
// Frequencies of a vertical string of collars in still mud.
#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <gtest/gtest.h>

#include "ReferenceCollar.hpp"
#include "common/Constants.hpp"
#include "linalg/DenseDecompositions.hpp"

namespace tooljoint::mud {
namespace MudCollarTest {

using constants::pi;

/// Gravity along the element [m/s2].
const Vector3 downElement(0.0, 0.0, 9.81);

/// Lowest lateral frequencies [Hz] of a vertical string of collars, pinned at both ends, hung at
/// the top and pushed by the weight on bit, in still mud: tension from the axial displacements,
/// which is the effective tension.
Vector collarFrequencies(int elements, bool shearAndRotaryInertia) {
  MudProperties p = referenceMud();
  p.flowRate = 0.0;
  const AnnularFlow mud(p);
  const beam::Section section = shearAndRotaryInertia ? collar() : collar().withoutShear();
  const double l = 100.0 / elements;
  const Eigen::Index n = elements + 1;
  const ElementContribution c = mud.element(section, boreRadius, l, downElement);
  const beam::Vector12 weight =
      beam::distributedLoad(section.massPerLength() * downElement, l) + c.load;

  Matrix axial = Matrix::Zero(n, n);
  Vector load = Vector::Zero(n);
  load[n - 1] = -1e4;
  for (Eigen::Index e = 0; e + 1 < n; ++e) {
    axial.block<2, 2>(e, e) +=
        section.axialRigidity() / l * (Eigen::Matrix2d() << 1, -1, -1, 1).finished();
    load[e] += weight[2];
    load[e + 1] += weight[8];
  }
  Vector w = Vector::Zero(n);
  w.tail(n - 1) =
      linalg::solveSymmetric(axial.bottomRightCorner(n - 1, n - 1), Vector(load.tail(n - 1)));

  const std::array<int, 4> plane{0, 4, 6, 10};  // u, theta_y
  Matrix stiffness = Matrix::Zero(2 * n, 2 * n);
  Matrix mass = Matrix::Zero(2 * n, 2 * n);
  for (Eigen::Index e = 0; e + 1 < n; ++e) {
    const double tension = section.axialRigidity() * (w[e + 1] - w[e]) / l;
    const beam::Matrix12 k = beam::stiffness(section, l) + tension * beam::geometricAxial(l);
    const beam::Matrix12 own = shearAndRotaryInertia
                                   ? beam::mass(section, l)
                                   : beam::Matrix12(section.massPerLength() * beam::lateralMass(l));
    const beam::Matrix12 m = own + c.mass;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < 4; ++j) {
        const auto row = 2 * e + static_cast<Eigen::Index>(i);
        const auto col = 2 * e + static_cast<Eigen::Index>(j);
        stiffness(row, col) += k(plane[i], plane[j]);
        mass(row, col) += m(plane[i], plane[j]);
      }
    }
  }
  // pinned: drop u of the first and of the last node
  std::vector<Eigen::Index> freeDofs;
  for (Eigen::Index i = 0; i < 2 * n; ++i)
    if (i != 0 && i != 2 * n - 2) freeDofs.push_back(i);
  const auto modes =
      linalg::symmetricPairs(stiffness(freeDofs, freeDofs), mass(freeDofs, freeDofs));
  return modes.values.head(4).cwiseSqrt() / (2.0 * pi);
}

/// Known frequencies of this string, to the five digits they are given with.
TEST(MudCollar, FrequenciesOfTheVerticalString) {
  const std::array<double, 4> known{0.06657, 0.17119, 0.31738, 0.51114};
  const Vector found = collarFrequencies(100, false);
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_NEAR(found[static_cast<Eigen::Index>(i)], known[i], 1e-5) << "mode " << i + 1;
}

/// Shear and rotary inertia lower them by (pi n R/L)^2-like amounts: less than 1e-4 of the fourth.
TEST(MudCollar, TimoshenkoTermsAreSmallAndLower) {
  const Vector slender = collarFrequencies(100, false);
  const Vector thick = collarFrequencies(100, true);
  for (Eigen::Index i = 0; i < 4; ++i) {
    EXPECT_LT(thick[i], slender[i]);
    EXPECT_NEAR(thick[i], slender[i], 1e-4 * slender[i]);
  }
}

}  // namespace MudCollarTest
}  // namespace tooljoint::mud
