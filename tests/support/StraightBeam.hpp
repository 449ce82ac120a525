// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Dense matrices of a straight, uniform beam along z, for comparison with closed forms.
#pragma once

#include <algorithm>
#include <functional>
#include <vector>

#include "substructures/beam/BeamMatrices.hpp"

namespace tooljoint::testing_ {

/// n equal elements; node i carries dofs 6 i ... 6 i + 5.
struct StraightBeam {
  int elements;
  double length;

  double elementLength() const { return length / elements; }
  int tip() const { return 6 * elements; }

  /// Assembles one matrix per element, `of(e)`.
  Matrix assemble(const std::function<beam::Matrix12(int)>& of) const {
    Matrix out = Matrix::Zero(6 * (elements + 1), 6 * (elements + 1));
    for (int e = 0; e < elements; ++e) out.block<12, 12>(6 * e, 6 * e) += of(e);
    return out;
  }
  Matrix assemble(const beam::Matrix12& every) const {
    return assemble([&every](int) { return every; });
  }

  /// All dofs whose component (0 to 5) is in `components`, without those in `held`.
  std::vector<int> free(const std::vector<int>& components, const std::vector<int>& held) const {
    std::vector<int> out;
    for (int i = 0; i < 6 * (elements + 1); ++i)
      if (std::count(components.begin(), components.end(), i % 6) > 0 &&
          std::count(held.begin(), held.end(), i) == 0)
        out.push_back(i);
    return out;
  }
};

}  // namespace tooljoint::testing_
