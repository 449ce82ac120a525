// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/selection/ModeChoice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace tooljoint::reduction {

double signedOmega(double eigenvalue) {
  return std::copysign(std::sqrt(std::abs(eigenvalue)), eigenvalue);
}

namespace {

/// Relative distance in frequency between modes k and k+1; infinite past the ends of the list.
double gap(const Vector& eigenvalues, Eigen::Index k) {
  if (k < 0 || k + 1 >= eigenvalues.size()) return std::numeric_limits<double>::infinity();
  const double low = signedOmega(eigenvalues[k]);
  const double high = signedOmega(eigenvalues[k + 1]);
  const double scale = std::max(std::abs(low), std::abs(high));
  return scale > 0.0 ? (high - low) / scale : 0.0;
}

/// True when modes k and k+1 must stay together.
bool together(const Vector& eigenvalues, Eigen::Index k, double pairTolerance) {
  const double here = gap(eigenvalues, k);
  if (here <= clusterTolerance) return true;
  return here <= pairTolerance && here < gap(eigenvalues, k - 1) && here < gap(eigenvalues, k + 1);
}

}  // namespace

int roundUp(const Vector& eigenvalues, int count, double pairTolerance) {
  const int available = static_cast<int>(eigenvalues.size());
  if (count <= 0) return 0;
  if (count >= available) return available;
  while (count < available && together(eigenvalues, count - 1, pairTolerance)) ++count;
  return count;
}

std::vector<char> wholePairs(const Vector& eigenvalues, std::vector<char> keep,
                             double pairTolerance) {
  const auto size = static_cast<Eigen::Index>(keep.size());
  const auto follow = [&](Eigen::Index from, Eigen::Index to) {
    if (keep[static_cast<std::size_t>(from)] &&
        together(eigenvalues, std::min(from, to), pairTolerance))
      keep[static_cast<std::size_t>(to)] = 1;
  };
  for (Eigen::Index k = 0; k + 1 < size; ++k) follow(k, k + 1);
  for (Eigen::Index k = size - 1; k > 0; --k) follow(k, k - 1);
  return keep;
}

std::vector<int> shareTotal(const std::vector<Vector>& spectra, const std::vector<bool>& complete,
                            int total, double pairTolerance) {
  std::vector<std::tuple<double, std::size_t, Eigen::Index>> all;
  for (std::size_t p = 0; p < spectra.size(); ++p)
    for (Eigen::Index k = 0; k < spectra[p].size(); ++k) all.emplace_back(spectra[p][k], p, k);
  std::sort(all.begin(), all.end());
  const std::size_t taken = std::min(all.size(), static_cast<std::size_t>(std::max(total, 0)));
  std::vector<int> counts(spectra.size(), 0);
  for (std::size_t i = 0; i < taken; ++i) ++counts[std::get<1>(all[i])];
  for (std::size_t p = 0; p < spectra.size(); ++p) {
    const int known = static_cast<int>(spectra[p].size());
    counts[p] = roundUp(spectra[p], counts[p], pairTolerance);
    // The next modes after the last known one decide on the cut: two more must be known.
    if (!complete[p] && counts[p] + 2 > known) counts[p] = -1;
  }
  return counts;
}

}  // namespace tooljoint::reduction
