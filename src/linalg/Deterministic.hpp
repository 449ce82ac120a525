// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Unstructured numbers that are the same in every run and on every rank, independent of earlier
/// calls.
#pragma once

#include <cstdint>

#include "common/Types.hpp"

namespace tooljoint::linalg {

/// rows x columns numbers in [-1, 1) that depend only on the arguments (splitmix64, Steele et al.
/// 2014).
inline Matrix scatteredNumbers(Eigen::Index rows, Eigen::Index columns, std::uint64_t seed) {
  Matrix numbers(rows, columns);
  std::uint64_t state = seed;
  for (Eigen::Index j = 0; j < columns; ++j)
    for (Eigen::Index i = 0; i < rows; ++i) {
      state += 0x9e3779b97f4a7c15ULL;
      std::uint64_t z = state;
      z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
      z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
      z ^= z >> 31;
      numbers(i, j) = static_cast<double>(z >> 11) * 0x1.0p-52 - 1.0;
    }
  return numbers;
}

/// Position of the entry of largest magnitude; the first one of several that agree to 1e-6.
inline Eigen::Index largestEntry(const Eigen::Ref<const Vector>& v) {
  const double largest = v.cwiseAbs().maxCoeff();
  Eigen::Index i = 0;
  while (std::abs(v[i]) < (1.0 - 1e-6) * largest) ++i;
  return i;
}

}  // namespace tooljoint::linalg
