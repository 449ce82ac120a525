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

bool hasCorner(const model::ScalarLaw& law, double begin, double end) {
  const auto first = std::upper_bound(law.corners.begin(), law.corners.end(), begin);
  return first != law.corners.end() && *first <= end;
}

LawMoments momentsOf(const model::ScalarLaw& law, double begin, double end) {
  constexpr double place = 0.7745966692414834, outer = 5.0 / 18, middle = 8.0 / 18;
  const double h = end - begin;
  LawMoments sum;
  double from = begin;
  const auto piece = [&](double to) {
    const double half = 0.5 * (to - from), centre = 0.5 * (to + from);
    const auto add = [&](double t, double weight) {
      const double part = weight * (to - from) / h * law.value(t);
      sum.mean += part;
      sum.first += (t - begin) / h * part;
    };
    add(centre - place * half, outer);
    add(centre, middle);
    add(centre + place * half, outer);
    from = to;
  };
  for (auto corner = std::upper_bound(law.corners.begin(), law.corners.end(), begin);
       corner != law.corners.end() && *corner < end; ++corner)
    piece(*corner);
  piece(end);
  return sum;
}

double missedPart(const model::ScalarLaw& law, double start, double end, double h) {
  const auto steps = static_cast<long>(std::floor((end - start) / h * (1 + 1e-12)));
  const long stride = std::max(1L, steps / lawSteps);
  const auto begin = [&](long step) { return start + static_cast<double>(step) * h; };
  double missed = 0.0, sum = 0.0;
  for (long i = 0; i < steps; i += i < lawSteps ? 1 : stride) {
    const double t = begin(i), next = begin(i + 1);
    if (hasCorner(law, t, next)) {
      sum += h * std::abs(momentsOf(law, t, next).mean);
      continue;
    }
    double fine = 0.0, before = law.value(t);
    const double whole = 0.5 * h * (before + law.value(next));
    for (int k = 1; k <= looksInStep; ++k) {
      const double value = law.value(t + h * k / looksInStep);
      fine += 0.5 * h / looksInStep * (before + value);
      before = value;
    }
    if (i > 0 || std::abs(whole) < std::abs(fine)) missed += std::abs(whole - fine);
    sum += std::abs(fine);
  }
  return sum > 0.0 ? missed / sum : 0.0;
}

}  // namespace tooljoint::transient
