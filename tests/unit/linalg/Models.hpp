// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Small mechanical models with known answers.
#pragma once

#include <cmath>
#include <vector>

#include "common/Types.hpp"

namespace tooljoint::testing {

/// Stiffness and mass.
struct Pencil {
  Sparse K, M;
};

inline Sparse assembled(int n, const Triplets& entries) {
  Sparse matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

inline Sparse sparse(const Matrix& A) { return A.sparseView(0.0, 0.0); }

/// n masses m in a row, springs k between neighbours; springs to the wall at both ends unless free.
/// Held: lambda_j = 4 k/m sin^2(j pi / (2 (n+1))), j = 1..n. Free: 4 k/m sin^2(j pi / (2 n)), j =
/// 0..n-1.
inline Pencil springChain(int n, double k, double m, bool free = false) {
  Triplets stiffness, mass;
  for (int i = 0; i < n; ++i) {
    const int springs = (i > 0 || !free) + (i + 1 < n || !free);
    stiffness.emplace_back(i, i, springs * k);
    mass.emplace_back(i, i, m);
    if (i + 1 < n) {
      stiffness.emplace_back(i, i + 1, -k);
      stiffness.emplace_back(i + 1, i, -k);
    }
  }
  return {assembled(n, stiffness), assembled(n, mass)};
}

/// Several uncoupled models as one.
inline Pencil sideBySide(const std::vector<Pencil>& parts) {
  Triplets stiffness, mass;
  int offset = 0;
  for (const Pencil& part : parts) {
    for (int row = 0; row < part.K.rows(); ++row) {
      for (Sparse::InnerIterator it(part.K, row); it; ++it)
        stiffness.emplace_back(offset + row, offset + it.col(), it.value());
      for (Sparse::InnerIterator it(part.M, row); it; ++it)
        mass.emplace_back(offset + row, offset + it.col(), it.value());
    }
    offset += static_cast<int>(part.K.rows());
  }
  return {assembled(offset, stiffness), assembled(offset, mass)};
}

/// Unsymmetric: diffusion with strong transport to one side and a skew coupling over three places
/// (as gyroscopics give).
inline Sparse transport(int n) {
  Triplets entries;
  for (int i = 0; i < n; ++i) {
    entries.emplace_back(i, i, 2.5 + 0.1 * std::sin(i));
    if (i + 1 < n) entries.emplace_back(i, i + 1, -0.2);
    if (i > 0) entries.emplace_back(i, i - 1, -1.9);
    if (i + 3 < n) {
      entries.emplace_back(i, i + 3, 0.7);
      entries.emplace_back(i + 3, i, -0.7);
    }
  }
  return assembled(n, entries);
}

/// `planes` uncoupled Euler-Bernoulli beams (v, theta per node) of `elements` elements, length L,
/// unit mass per length and bending stiffness EI, simply supported at both ends or free: every
/// eigenvalue comes `planes` times. Simply supported: lambda_j = EI (j pi / L)^4. Free: zero twice
/// per plane, then EI (4.730041/L)^4 ...
inline Pencil beam(int elements, double L, double EI, int planes = 1, bool free = false,
                   double axialForce = 0.0) {
  const double l = L / elements;
  const int perPlane = 2 * (elements + 1) - (free ? 0 : 2);
  const auto dof = [&](int plane, int node, int component) {
    const int full = 2 * node + component;
    if (free) return plane * perPlane + full;
    if (component == 0 && (node == 0 || node == elements)) return -1;
    const int removed = (full > 0 ? 1 : 0) + (full > 2 * elements ? 1 : 0);
    return plane * perPlane + full - removed;
  };
  const double kb = EI / (l * l * l), m = l / 420.0, g = axialForce / (30.0 * l);
  const double ke[4][4] = {{12, 6 * l, -12, 6 * l},
                           {6 * l, 4 * l * l, -6 * l, 2 * l * l},
                           {-12, -6 * l, 12, -6 * l},
                           {6 * l, 2 * l * l, -6 * l, 4 * l * l}};
  const double ge[4][4] = {{36, 3 * l, -36, 3 * l},
                           {3 * l, 4 * l * l, -3 * l, -l * l},
                           {-36, -3 * l, 36, -3 * l},
                           {3 * l, -l * l, -3 * l, 4 * l * l}};
  const double me[4][4] = {{156, 22 * l, 54, -13 * l},
                           {22 * l, 4 * l * l, 13 * l, -3 * l * l},
                           {54, 13 * l, 156, -22 * l},
                           {-13 * l, -3 * l * l, -22 * l, 4 * l * l}};
  Triplets stiffness, mass;
  for (int plane = 0; plane < planes; ++plane)
    for (int e = 0; e < elements; ++e)
      for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) {
          const int row = dof(plane, e + i / 2, i % 2), column = dof(plane, e + j / 2, j % 2);
          if (row < 0 || column < 0) continue;
          stiffness.emplace_back(row, column, kb * ke[i][j] + g * ge[i][j]);
          mass.emplace_back(row, column, m * me[i][j]);
        }
  const int n = planes * perPlane;
  return {assembled(n, stiffness), assembled(n, mass)};
}

/// Mass, damping with gyroscopics, and stiffness.
struct Shaft {
  Sparse M, C, K;
};

/// `n` masses with two lateral coordinates each in a chain of springs between walls (or free),
/// gyroscopic coupling g and damping c.
inline Shaft shaft(int n, double g, double c, bool free) {
  Triplets m, d, k;
  for (int i = 0; i < n; ++i)
    for (int x = 0; x < 2; ++x) {
      const int row = 2 * i + x;
      m.emplace_back(row, row, 1.0 + 0.01 * i);
      d.emplace_back(row, row, c * (1.0 + 0.1 * x));
      d.emplace_back(row, 2 * i + 1 - x, x == 0 ? g : -g);
      const double ends = free ? (i > 0) + (i + 1 < n) : 2.0;
      k.emplace_back(row, row, 100.0 * (1.0 + 0.1 * x) * ends);
      if (i + 1 < n) {
        k.emplace_back(row, row + 2, -100.0 * (1.0 + 0.1 * x));
        k.emplace_back(row + 2, row, -100.0 * (1.0 + 0.1 * x));
      }
    }
  const auto matrix = [n](const Triplets& t) {
    Sparse A(2 * n, 2 * n);
    A.setFromTriplets(t.begin(), t.end());
    return A;
  };
  return {matrix(m), matrix(d), matrix(k)};
}

}  // namespace tooljoint::testing
