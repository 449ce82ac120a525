// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A case with its parts reduced and coupled, as its list Reduction says.
#pragma once

#include <memory>
#include <vector>

#include "cases/Case.hpp"
#include "estimate/AdaptiveReduction.hpp"

namespace tooljoint::cases {

/// A cut that was tried: what it overrides, and the predicted work of a step over that of the full
/// model.
struct TriedCut {
  Overrides overrides;
  double cost = 0.0;
};

struct ReducedCase {
  std::vector<TriedCut> tried;           ///< where the deck leaves the cut to the cost of a step
  TriedCut cut;                          ///< the one of them that is taken
  coupling::ResolvedCoupling unreduced;  ///< the parts before the reduction, and what joins them
  estimate::Outcome outcome;
  double sampling = 0.0;  ///< of the motion that chose the modes [s]; 0: none did

  const std::vector<reduction::ReducedSubstructure>& parts() const {
    return outcome.synthesis.parts;
  }
  const coupling::Coupling& coupled() const { return outcome.synthesis.coupled; }
  const model::SecondOrderModel& model() const { return outcome.synthesis.coupled.model; }
  /// Frequencies [rad/s] at which the modes of the parts end, infinite where none is missing;
  /// empty where nothing was reduced.
  std::vector<double> cutOffs() const;
  /// Time between two samples at which the error of the motion is estimated [s]: that at which the
  /// modes were chosen, else that of the results.
  double watchInterval(const Case& one) const;
};

/// Reduces the parts of a case that has the list Reduction; where the deck leaves open how they are
/// cut, so that a step of the reduced model is predicted to cost least. A motion tolerance moves
/// candidates; \param progress shows a progress bar then. Throws what estimate::synthesise throws.
/// Collective.
ReducedCase reduce(const Case& one, const RestingCase& rest, bool progress = true);

/// The first fixed-interface modes of each part that has none in its basis, for the start of the
/// motion. Throws the errors of reduction::fixedInterfaceModes.
std::vector<transient::MissingMode> missingModes(const Case& one, const ReducedCase& reduced);

/// True when the list Reduction estimates the error of the motion, or has modes by it.
bool estimatesMotion(const Case& one);

/// Watches the motion of the reduced model. All arguments must outlive the estimator.
std::unique_ptr<estimate::MotionEstimator> motionEstimator(const RestingCase& rest,
                                                           const ReducedCase& reduced);

}  // namespace tooljoint::cases
