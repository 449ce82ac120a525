// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Lowest modes of a part from its tree of substructures, with the estimated error of each.
#pragma once

#include <memory>

#include "reduction/multilevel/TreeFactor.hpp"
#include "reduction/selection/ModeChoice.hpp"

namespace tooljoint::reduction {

struct TreeModesOptions {
  double cutOffFactor = 0;  ///< substructures have their modes up to this multiple of the highest
                            ///< wanted frequency
  double accuracy = 0;      ///< estimated relative error up to which a frequency needs no
                            ///< correction
  int corrections = 0;      ///< largest number of corrections
};

struct TreeModes {
  Vector values;          ///< omega^2 [1/s^2], increasing; Rayleigh quotients, hence upper bounds
  Matrix vectors;         ///< dofs x modes, phi' M phi = 1
  Vector errors;          ///< estimated relative error of each frequency; 0 for a rigid-body mode
  int wanted = 0;         ///< number of leading modes for the request, before completing pairs
  bool complete = false;  ///< all modes of the part
  int coordinates = 0;    ///< of the coupled substructures
  double cutOff = 0;      ///< of the substructures [rad/s]; infinite if they have all modes
  int corrections = 0;    ///< number of corrections made
};

/// Eliminates the part for its modes. The shift is far below the modes, so that parts that float or
/// hang on a hinge need no special case, or lower for an indefinite K. Collective. ModelError if no
/// shift makes K + shift M definite: M is indefinite, or K and M are singular together.
std::shared_ptr<const TreeFactor> eliminate(std::shared_ptr<const SubstructureTree> tree,
                                            const Sparse& K, const Sparse& M);

/// Modes of K phi = omega^2 M phi. The residual r = (K - lambda M) x of a Ritz vector gives
/// z = (K + shift M)^-1 r by the factors of the tree, and the estimate
///
///     lambda - lambda_exact <= r'z / (x'Mx (1 - lambda / lambda_c)),
///
/// if the error lies in modes above lambda_c: the cut-off of the substructures or, for corrected
/// modes, the highest eigenvalue of the block. A correction is a Rayleigh-Ritz step on all x and z.
/// Collective; every rank gets the same.
TreeModes treeModes(const Sparse& K, const Sparse& M, const TreeFactor& factor,
                    const ModeRequest& request, const TreeModesOptions& options);

}  // namespace tooljoint::reduction
