// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Number of modes: per part, over all parts, by a cut-off frequency, all, by the coupling to the
/// boundary of the part (InterfaceCriteria), or by a tolerance (src/estimate). No rule separates a
/// close pair (the u and v mode of a shaft); the number is rounded up.
#pragma once

#include <memory>
#include <vector>

#include "common/Types.hpp"

namespace tooljoint::linalg {
struct EigenOptions;
}

namespace tooljoint::reduction {

/// Two neighbouring modes closer than this (relative, in frequency) may be a pair.
constexpr double defaultPairTolerance = 0.01;
/// Neighbours closer than this (relative, in frequency) have the same frequency; a cluster is never
/// separated.
constexpr double clusterTolerance = 1e-6;

/// The user's choice for a list of parts.
struct ModeRule {
  enum class Kind { PerPart, Total, CutOff, All, InterfaceMass, InterfaceMoment, Tolerance };
  Kind kind = Kind::All;
  static constexpr int whole = -1;  ///< in `counts`: the part is not reduced (wholePart)
  std::vector<int> counts;          ///< PerPart: one entry for every part, or a single one for all
  int total = 0;                    ///< Total: the lowest `total` over all parts
  double cutOffHz = 0;              ///< CutOff: all modes at or below
  double fraction = 0;  ///< InterfaceMass, InterfaceMoment: the required sum of shares, in (0, 1]
  double frequencyTolerance =
      0;  ///< Tolerance: largest relative error of the coupled frequencies; 0: no condition
  double motionTolerance =
      0;  ///< Tolerance: largest vibration error of the transient; 0: no condition
  double pairTolerance = defaultPairTolerance;
};

/// Requested modes of one part.
struct ModeRequest {
  enum class Kind { Count, Below, All, Whole };
  Kind kind = Kind::All;
  int count = 0;
  double omegaMax = 0;  ///< Below [rad/s]
  double pairTolerance = defaultPairTolerance;
  std::shared_ptr<const linalg::EigenOptions> eigen;  ///< null: the defaults of the eigensolver
  bool operator==(const ModeRequest& other) const {
    return kind == other.kind && count == other.count && omegaMax == other.omegaMax &&
           pairTolerance == other.pairTolerance;
  }
};

/// sign(omega^2) sqrt(|omega^2|): negative for a buckled part, with the same order as omega^2.
double signedOmega(double eigenvalue);

/// Number of kept modes if `count` of the increasing `eigenvalues` (omega^2) are wanted: `count`,
/// rounded up if the cut would separate a cluster (neighbours equal to clusterTolerance) or a pair
/// (two modes closer than pairTolerance and closer to each other than to their other neighbours).
/// At most eigenvalues.size().
int roundUp(const Vector& eigenvalues, int count, double pairTolerance);

/// `keep` (1 for a kept mode) extended by the partners of its clusters and close pairs.
std::vector<char> wholePairs(const Vector& eigenvalues, std::vector<char> keep,
                             double pairTolerance);

/// Modes per part for the lowest `total` over all parts: spectra[p] holds the lowest eigenvalues of
/// part p in increasing order; complete[p] is true if these are all. Equal ones go to the first
/// part. Rounds up within each part. An entry is -1 if spectra[p] is too short to decide.
std::vector<int> shareTotal(const std::vector<Vector>& spectra, const std::vector<bool>& complete,
                            int total, double pairTolerance);

}  // namespace tooljoint::reduction
