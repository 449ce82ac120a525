// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Pairing of the modes of two models by shape, repeated modes as subspaces.
#pragma once

#include <vector>

#include "common/Types.hpp"

namespace tooljoint::estimate {

/// The partner of a mode.
struct ModeMatch {
  int partner = -1;  ///< 0-based; -1: no mode is left
  double mac = 0;    ///< cos^2 of the (largest principal) angle between the two, M-weighted
};

/// Values closer than this, relatively, are one repeated value, whose shapes are any basis of their
/// subspace.
constexpr double repeatedWithin = 1e-3;

/// M-weighted modal assurance criterion (R. J. Allemang and D. L. Brown, Proc. IMAC 1 (1982)
/// 110-116), rows: columns of a, columns: of b.
Matrix modalAssurance(const Sparse& M, const Eigen::MatrixXcd& a, const Eigen::MatrixXcd& b);

/// Partners of the modes (values, shapes) among (otherValues, others), each used once. Consecutive
/// values within repeatedWithin, and zeros, form a cluster. Every candidate is compared with the
/// span of every cluster, the best pairs are taken first, and a cluster takes as many partners as
/// it has modes, in the order of the candidates. Pairs are ordered by their cos^2 times that of the
/// angle between (1, s / w) of both, w the larger |s|, so that values s distinguish modes of equal
/// shape, such as the two of an overdamped motion. For a cluster of several modes `mac` is the
/// smallest squared cosine of the principal angles (A. Bjorck and G. H. Golub, Math. Comp. 27
/// (1973) 579-594) between its span and that of its partners; for a single mode it is the MAC.
std::vector<ModeMatch> matchModes(const Sparse& M, const Eigen::VectorXcd& values,
                                  const Eigen::MatrixXcd& shapes,
                                  const Eigen::VectorXcd& otherValues,
                                  const Eigen::MatrixXcd& others);

}  // namespace tooljoint::estimate
