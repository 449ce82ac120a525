// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A case with its parts reduced and coupled according to its list Reduction.
#pragma once

#include <memory>
#include <vector>

#include "cases/Case.hpp"
#include "estimate/AdaptiveReduction.hpp"

namespace tooljoint::cases {

/// A trial cut: its overrides, and the predicted work of a step over that of the full model.
struct TriedCut {
  Overrides overrides;
  double cost = 0.0;
};

struct ReducedCase {
  std::vector<TriedCut> tried;           ///< if the deck leaves the cut to the cost of a step
  TriedCut cut;                          ///< the chosen one
  coupling::ResolvedCoupling unreduced;  ///< the parts before the reduction, and their connections
  estimate::Outcome outcome;
  double sampling = 0.0;  ///< of the motion that chose the modes [s]; 0: no motion did

  const std::vector<reduction::ReducedSubstructure>& parts() const {
    return outcome.synthesis.parts;
  }
  const coupling::Coupling& coupled() const { return outcome.synthesis.coupled; }
  const model::SecondOrderModel& model() const { return outcome.synthesis.coupled.model; }
  /// Cut-off frequencies of the parts [rad/s], infinite if no mode is missing; empty if nothing was
  /// reduced.
  std::vector<double> cutOffs() const;
  /// Time between two samples for the error estimate of the motion [s]: that of the choice of the
  /// modes, otherwise that of the results.
  double watchInterval(const Case& one) const;
};

/// Reduces the parts of a case with the list Reduction. If the deck leaves the cut open, it is
/// chosen for the lowest predicted cost of a step of the reduced model. \param progress  shows a
/// progress bar while a motion tolerance integrates candidates. Throws the
///                  errors of estimate::synthesise. Collective.
ReducedCase reduce(const Case& one, const RestingCase& rest, bool progress = true);

/// The first fixed-interface modes of each part without modes in its basis, for the start of the
/// motion. Throws the errors of reduction::fixedInterfaceModes.
std::vector<transient::MissingMode> missingModes(const Case& one, const ReducedCase& reduced);

/// True if the list Reduction requests an error estimate of the motion, or chooses modes by it.
bool estimatesMotion(const Case& one);

/// Estimates the error of the motion of the reduced model. All arguments must outlive the
/// estimator.
std::unique_ptr<estimate::MotionEstimator> motionEstimator(const RestingCase& rest,
                                                           const ReducedCase& reduced);

}  // namespace tooljoint::cases
