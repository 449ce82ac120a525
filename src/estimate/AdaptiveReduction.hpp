// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Reduction with error estimates, and mode selection by a
/// tolerance.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "coupling/Synthesis.hpp"
#include "estimate/FrequencyEstimate.hpp"
#include "estimate/MotionEstimate.hpp"

namespace Teuchos {
class ParameterList;
}

namespace tooljoint::estimate {

/// Error estimates requested by the list "Reduction".
struct EstimateOptions {
  bool frequencies = false;
  bool motion = false;
  FrequencyWindow window;
};
/// Throws DeckError if the choices contradict each other.
EstimateOptions readEstimateOptions(const Teuchos::ParameterList& reduction);

/// One round of the mode selection by a tolerance.
struct Round {
  int modes = 0;               ///< of all parts
  double frequencyError = -1;  ///< largest estimate over the window; negative if not estimated
  double motionError = -1;     ///< estimate of the vibration error, likewise
  double reached = 1;          ///< fraction of the window of the motion that was computed
  int whole = 0;               ///< parts that are not reduced
};

struct Outcome {
  coupling::Synthesis synthesis;
  std::vector<FrequencyEstimate> frequencies;  ///< empty unless requested
  std::vector<Round> rounds;                   ///< of a tolerance; empty otherwise
  double wall = 0;                             ///< of the estimates [s]
};

/// Moves the coupled model through the window of the scene, or until the error exceeds the limit
/// (watchMotion), and returns the estimated error of that motion.
using MotionProbe = std::function<MotionEstimate(const coupling::Synthesis&, const MotionLimit&)>;

/// Reduces, couples and estimates. With ModeRule::Kind::Tolerance every part starts with few modes.
/// The coupled frequencies are then estimated (and, with a motion tolerance, the motion is computed
/// and estimated by `probe`), and the parts with the largest contributions get more modes until the
/// estimate times the safety factor is below the tolerance; these are the parts without which the
/// others make up half of it (W. Doerfler, SIAM J. Numer. Anal. 33 (1996) 1106-1124). Only parts
/// whose number of modes changes are reduced again. Motions run to the end of the window until one
/// has an estimate below 1/2, which gives the size of the motion; later ones stop as soon as their
/// error is twice the error allowed for this size. With a motion tolerance a part that would get
/// three quarters of its modes, or whose matrices would have ten times the entries of its own
/// stiffness, is not reduced (reduction::wholePart): it is then exact and faster to integrate. A
/// model without reduced parts is not estimated: it is the full model. The same on every rank;
/// collective. ConvergenceError if the tolerance is not met with all modes.
Outcome synthesise(const std::vector<model::Substructure>& parts,
                   const reduction::ReductionMethod& basis,
                   const reduction::ReductionOptions& options, const EstimateOptions& estimates,
                   const MotionProbe& probe = {}, const coupling::CouplingOptions& coupling = {});
/// The same from the deck list "Reduction".
Outcome synthesise(const std::vector<model::Substructure>& parts,
                   const Teuchos::ParameterList& reduction, const MotionProbe& probe = {},
                   const coupling::CouplingOptions& coupling = {});

/// Largest error of the estimates, 0 for none. If modes are missing below a frequency it counts as
/// 1 at least.
double largestError(const std::vector<FrequencyEstimate>& estimates);

/// A table of the rounds.
std::string roundTable(const std::vector<Round>& rounds);

}  // namespace tooljoint::estimate
