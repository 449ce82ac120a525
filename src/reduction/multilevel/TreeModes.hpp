// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Lowest modes of a part by its tree of substructures, with the estimated error of each.
#pragma once

#include <memory>

#include "reduction/multilevel/TreeFactor.hpp"
#include "reduction/selection/ModeChoice.hpp"

namespace tooljoint::reduction {

struct TreeModesOptions {
  double cutOffFactor = 0;  ///< substructures have their modes up to this multiple of the highest
                            ///< frequency that is wanted
  double accuracy = 0;      ///< estimated relative error of a frequency that needs no correction
  int corrections = 0;      ///< corrections at most
};

struct TreeModes {
  Vector values;          ///< omega^2 [1/s^2], increasing; Rayleigh quotients, hence too high
  Matrix vectors;         ///< dofs x modes, phi' M phi = 1
  Vector errors;          ///< estimated relative error of each frequency; 0 of a rigid body
  int wanted = 0;         ///< the first so many answer the request but for whole pairs
  bool complete = false;  ///< all modes there are
  int coordinates = 0;    ///< of the coupled substructures
  double cutOff = 0;      ///< of the substructures [rad/s]; infinite when they have all modes
  int corrections = 0;    ///< that were made
};

/// Eliminates the part for its modes: with a shift far below them, so that parts that float or
/// hang on a hinge are no exception, or further down for an indefinite K. Collective. ModelError
/// when no shift makes K + shift M definite: M is indefinite, or K and M are singular together.
std::shared_ptr<const TreeFactor> eliminate(std::shared_ptr<const SubstructureTree> tree,
                                            const Sparse& K, const Sparse& M);

/// Modes of K phi = omega^2 M phi. The residual r = (K - lambda M) x of a Ritz vector gives
/// z = (K + shift M)^-1 r by the factors of the tree, and the estimate
///
///     lambda - lambda_exact <= r'z / (x'Mx (1 - lambda / lambda_c)),
///
/// if the error lies in modes above lambda_c: the cut-off of the substructures, and of modes that
/// were corrected the highest of the block. A correction is a Rayleigh-Ritz step on all x and z.
/// Collective; every rank gets the same.
TreeModes treeModes(const Sparse& K, const Sparse& M, const TreeFactor& factor,
                    const ModeRequest& request, const TreeModesOptions& options);

}  // namespace tooljoint::reduction
