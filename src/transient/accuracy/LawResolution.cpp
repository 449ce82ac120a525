// SPDX-License-Identifier: BSD-3-Clause
#include "transient/accuracy/LawResolution.hpp"

#include <algorithm>
#include <cmath>

namespace tooljoint::transient {
namespace {

/// Steps of a run at which laws are looked at: the first ones, and as many spread over the rest.
constexpr long lawSteps = 10000;

/// Looks at a law within a step: what is shorter than the distance of two of them may be missed.
constexpr int looksInStep = 8;

}  // namespace

LawParts missedParts(const model::ScalarLaw& law, double start, double end, double h) {
  const auto steps = static_cast<long>(std::floor((end - start) / h * (1 + 1e-12)));
  const long stride = std::max(1L, steps / lawSteps);
  double sum = 0.0;
  LawParts parts;
  for (long i = 0; i < steps; i += i < lawSteps ? 1 : stride) {
    const double t = start + static_cast<double>(i) * h;
    const double whole = 0.5 * (law.value(t) + law.value(t + h));
    double fine = whole;
    for (int k = 1; k < looksInStep; ++k) fine += law.value(t + h * k / looksInStep);
    fine /= looksInStep;
    parts.missed += std::abs(whole - fine);
    if (std::abs(whole) < std::abs(fine)) parts.lost += std::abs(whole - fine);
    sum += std::abs(fine);
  }
  return sum > 0.0 ? LawParts{parts.missed / sum, parts.lost / sum} : LawParts{};
}

}  // namespace tooljoint::transient
