// SPDX-License-Identifier: BSD-3-Clause
#include "estimate/ModeMatching.hpp"

#include <algorithm>
#include <complex>

#include "linalg/ComplexProduct.hpp"
#include "linalg/DenseDecompositions.hpp"

namespace tooljoint::estimate {

namespace {

using linalg::times;

/// Remainder of a unit vector, orthogonalised to the others, below which it is rounding: shapes of
/// a Jordan chain agree.
constexpr double dependent = 1e-6;

double length(const ComplexVector& x, const ComplexVector& Mx) {
  return std::sqrt(std::max(0.0, x.dot(Mx).real()));
}

/// M-orthonormal basis of the span.
ComplexMatrix orthonormal(const Sparse& M, const ComplexMatrix& shapes) {
  ComplexMatrix basis(shapes.rows(), 0), weighted(shapes.rows(), 0);
  for (Eigen::Index j = 0; j < shapes.cols(); ++j) {
    ComplexVector x = shapes.col(j);
    const double size = length(x, times(M, x));
    if (!(size > 0)) continue;
    x /= size;
    for (int pass = 0; pass < 2; ++pass) x -= basis * (weighted.adjoint() * x);
    const double left = length(x, times(M, x));
    if (left < dependent) continue;
    x /= left;
    basis.conservativeResize(Eigen::NoChange, basis.cols() + 1);
    weighted.conservativeResize(Eigen::NoChange, basis.cols());
    basis.rightCols(1) = x;
    weighted.rightCols(1) = times(M, x);
  }
  return basis;
}

/// cos^2 of the angle between (1, a / w) and (1, b / w), w the larger of |a| and |b|.
double likeness(Complex a, Complex b) {
  const double w = std::max(std::abs(a), std::abs(b));
  if (!(w > 0)) return 1.0;
  return std::norm(1.0 + std::conj(a) * b / (w * w)) /
         ((1.0 + std::norm(a / w)) * (1.0 + std::norm(b / w)));
}

struct Cluster {
  std::vector<Eigen::Index> members;
  ComplexMatrix weighted;  ///< M times an orthonormal basis
  std::vector<int> partners;
};

std::vector<Cluster> clusters(const Sparse& M, const ComplexVector& values,
                              const ComplexMatrix& shapes) {
  std::vector<Cluster> found;
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    const bool repeated =
        i > 0 && std::abs(values[i] - values[i - 1]) <=
                     repeatedWithin * std::max(std::abs(values[i]), std::abs(values[i - 1]));
    if (!repeated) found.emplace_back();
    found.back().members.push_back(i);
  }
  for (auto& cluster : found) {
    ComplexMatrix own(shapes.rows(), static_cast<Eigen::Index>(cluster.members.size()));
    for (std::size_t k = 0; k < cluster.members.size(); ++k)
      own.col(static_cast<Eigen::Index>(k)) = shapes.col(cluster.members[k]);
    cluster.weighted = times(M, orthonormal(M, own));
  }
  return found;
}

/// Smallest squared cosine of the principal angles between the span of the cluster and that of its
/// partners.
double leastCosine(const Sparse& M, const Cluster& cluster, const ComplexMatrix& others) {
  ComplexMatrix theirs(others.rows(), static_cast<Eigen::Index>(cluster.partners.size()));
  for (std::size_t k = 0; k < cluster.partners.size(); ++k)
    theirs.col(static_cast<Eigen::Index>(k)) = others.col(cluster.partners[k]);
  const ComplexMatrix cosines = cluster.weighted.adjoint() * orthonormal(M, theirs);
  if (cosines.size() == 0) return 0.0;
  const double least = linalg::singularValues(cosines).minCoeff();
  return std::min(1.0, least * least);
}

}  // namespace

Matrix modalAssurance(const Sparse& M, const ComplexMatrix& a, const ComplexMatrix& b) {
  const ComplexMatrix Mb = times(M, b), Ma = times(M, a);
  Matrix mac = (a.adjoint() * Mb).cwiseAbs2();
  for (Eigen::Index i = 0; i < a.cols(); ++i)
    mac.row(i) /= std::max(a.col(i).dot(Ma.col(i)).real(), 1e-300);
  for (Eigen::Index j = 0; j < b.cols(); ++j)
    mac.col(j) /= std::max(b.col(j).dot(Mb.col(j)).real(), 1e-300);
  return mac;
}

std::vector<ModeMatch> matchModes(const Sparse& M, const ComplexVector& values,
                                  const ComplexMatrix& shapes, const ComplexVector& otherValues,
                                  const ComplexMatrix& others) {
  auto found = clusters(M, values, shapes);
  struct Pair {
    double share;  ///< cos^2 between the candidate and the span of the cluster, times likeness
    std::size_t cluster;
    int candidate;
  };
  std::vector<Pair> pairs;
  const ComplexMatrix Mo = times(M, others);
  for (std::size_t g = 0; g < found.size(); ++g) {
    const ComplexMatrix projections = found[g].weighted.adjoint() * others;
    const Complex own = values[found[g].members.front()];
    for (Eigen::Index j = 0; j < others.cols(); ++j) {
      const double size = std::max(others.col(j).dot(Mo.col(j)).real(), 1e-300);
      pairs.push_back({projections.col(j).squaredNorm() / size * likeness(own, otherValues[j]), g,
                       static_cast<int>(j)});
    }
  }
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const Pair& a, const Pair& b) { return a.share > b.share; });
  std::vector<char> taken(static_cast<std::size_t>(others.cols()), 0);
  for (const Pair& pair : pairs) {
    auto& cluster = found[pair.cluster];
    if (taken[static_cast<std::size_t>(pair.candidate)] ||
        cluster.partners.size() == cluster.members.size())
      continue;
    taken[static_cast<std::size_t>(pair.candidate)] = 1;
    cluster.partners.push_back(pair.candidate);
  }
  std::vector<ModeMatch> matches(static_cast<std::size_t>(values.size()));
  for (auto& cluster : found) {
    std::sort(cluster.partners.begin(), cluster.partners.end());
    const double mac = cluster.partners.empty() ? 0.0 : leastCosine(M, cluster, others);
    for (std::size_t k = 0; k < cluster.partners.size(); ++k)
      matches[static_cast<std::size_t>(cluster.members[k])] = {cluster.partners[k], mac};
  }
  return matches;
}

}  // namespace tooljoint::estimate
