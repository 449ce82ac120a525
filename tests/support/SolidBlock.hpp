// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A block of trilinear hexahedra as a part, for tests of large parts.
#pragma once

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "common/Index.hpp"
#include "tests/support/SampleParts.hpp"

namespace tooljoint::samples {

/// Stiffness and mass of a steel box with edges h [m], 2 x 2 x 2 points of Gauss.
inline std::array<Matrix, 2> hexahedron(const Vector3& h) {
  const double young = 2.06e11, poisson = 0.3, density = 7850;
  const double lambda = young * poisson / ((1 + poisson) * (1 - 2 * poisson)),
               shear = young / (2 * (1 + poisson));
  Matrix D = Matrix::Zero(6, 6);
  D.topLeftCorner(3, 3).setConstant(lambda);
  D.diagonal() << Vector3::Constant(lambda + 2 * shear), Vector3::Constant(shear);
  const auto sign = [](int corner, int axis) { return (corner >> axis & 1) != 0 ? 1.0 : -1.0; };
  Matrix K = Matrix::Zero(24, 24), M = Matrix::Zero(24, 24);
  for (int point = 0; point < 8; ++point) {
    Matrix B = Matrix::Zero(6, 24), N = Matrix::Zero(3, 24);
    for (int node = 0; node < 8; ++node) {
      Vector3 one, slope;
      for (int a = 0; a < 3; ++a)
        one[a] = 0.5 * (1 + sign(node, a) * sign(point, a) / std::sqrt(3));
      for (int a = 0; a < 3; ++a)
        slope[a] = sign(node, a) / h[a] * one[(a + 1) % 3] * one[(a + 2) % 3];
      N.block(0, 3 * node, 3, 3) = one.prod() * Matrix3::Identity();
      B.block(0, 3 * node, 6, 3) << slope[0], 0, 0, 0, slope[1], 0, 0, 0, slope[2], slope[1],
          slope[0], 0, 0, slope[2], slope[1], slope[2], 0, slope[0];
    }
    const double weight = h.prod() / 8;
    K += weight * B.transpose() * D * B;
    M += weight * density * N.transpose() * N;
  }
  return {K, M};
}

/// nx x ny x nz elements of edges 10 cm; nodes are numbered from 1, x fastest. The end x = 0 is
/// clamped unless `free`.
inline Substructure solidBlock(int nx, int ny, int nz, bool free = false) {
  Substructure part;
  part.name = "block";
  auto& m = part.model;
  m.componentNames = std::vector<std::string>{"u", "v", "w"};
  const auto node = [&](int x, int y, int z) { return x + (nx + 1) * (y + (ny + 1) * z); };
  std::vector<int> position(at(3 * node(nx, ny, nz) + 3), -1);
  for (int z = 0; z <= nz; ++z)
    for (int y = 0; y <= ny; ++y)
      for (int x = free ? 0 : 1; x <= nx; ++x)
        for (int c = 0; c < 3; ++c) {
          position[at(3 * node(x, y, z) + c)] = static_cast<int>(m.dofs.size());
          m.dofs.push_back(DofLabel::physical(node(x, y, z) + 1, c));
        }
  const auto [k, mass] = hexahedron(Vector3(0.1, 0.1, 0.1));
  Triplets K, M;
  for (int z = 0; z < nz; ++z)
    for (int y = 0; y < ny; ++y)
      for (int x = 0; x < nx; ++x) {
        std::vector<int> dofs;
        for (int corner = 0; corner < 8; ++corner)
          for (int c = 0; c < 3; ++c)
            dofs.push_back(position[at(
                3 * node(x + (corner & 1), y + (corner >> 1 & 1), z + (corner >> 2 & 1)) + c)]);
        add(K, k, dofs);
        add(M, mass, dofs);
      }
  const auto n = static_cast<int>(m.dofs.size());
  m.stiffness = std::vector<model::MatrixTerm>{{"elastic", square(n, K), 0}};
  m.mass = square(n, M);
  complete(part);
  return part;
}

}  // namespace tooljoint::samples
