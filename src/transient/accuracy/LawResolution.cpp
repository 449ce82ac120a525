// SPDX-License-Identifier: BSD-3-Clause
#include "transient/accuracy/LawResolution.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/Index.hpp"

namespace tooljoint::transient {
namespace {

/// Steps of a run in which laws are evaluated: the first steps, as many spread over the rest, and
/// steps with a corner.
constexpr long lawSteps = 10000;

/// Evaluations of a law within a step, besides corners. Features shorter than the distance of two
/// evaluations may be missed.
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

double missedPart(const model::ScalarLaw& law, double start, double end, double h,
                  bool followsCorners) {
  const auto steps = static_cast<long>(std::floor((end - start) / h * (1 + 1e-12)));
  const long stride = std::max(1L, steps / lawSteps);
  const auto begin = [&](long step) { return start + static_cast<double>(step) * h; };
  std::vector<long> looked;
  for (long i = 0; i < steps; i += i < lawSteps ? 1 : stride) looked.push_back(i);
  for (const double corner : law.corners)
    if (corner >= start && corner < begin(steps))
      looked.push_back(static_cast<long>(std::floor((corner - start) / h)));
  makeUnique(looked);
  double missed = 0.0, sum = 0.0;
  std::vector<double> times;
  for (const long i : looked) {
    const double t = begin(i), next = begin(i + 1);
    if (followsCorners && hasCorner(law, t, next)) {
      sum += h * std::abs(momentsOf(law, t, next).mean);
      continue;
    }
    times.clear();
    for (int k = 0; k <= looksInStep; ++k) times.push_back(t + h * k / looksInStep);
    const auto corner = std::upper_bound(law.corners.begin(), law.corners.end(), t);
    times.insert(times.end(), corner, std::lower_bound(corner, law.corners.end(), next));
    std::sort(times.begin(), times.end());
    double fine = 0.0, before = law.value(t);
    const double whole = 0.5 * h * (before + law.value(next));
    for (std::size_t k = 1; k < times.size(); ++k) {
      const double value = law.value(times[k]);
      fine += 0.5 * (times[k] - times[k - 1]) * (before + value);
      before = value;
    }
    if (i > 0 || std::abs(whole) < std::abs(fine)) missed += std::abs(whole - fine);
    sum += std::abs(fine);
  }
  return sum > 0.0 ? missed / sum : 0.0;
}

}  // namespace tooljoint::transient
