// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Static equilibrium by one of two recipes (Nguyen et al. 2020, section 3.2).
#pragma once

#include <optional>
#include <vector>

#include "deck/ListSpec.hpp"
#include "model/NonlinearSolve.hpp"
#include "substructures/equilibrium/Settling.hpp"
#include "substructures/equilibrium/StaticProblem.hpp"
#include "substructures/equilibrium/StaticState.hpp"

namespace Teuchos {
class ParameterList;
}

namespace tooljoint::equilibrium {

enum class Recipe {
  Continuation,  ///< from D = 0: contacts from soft to stiff, friction in steps; limited steps,
                 ///< else line search
  Source,        ///< from K_pa^-1 F_s with full Newton steps: first without, then with K_gpo
};

/// Coefficient of the sliding friction in the static state.
enum class FrictionRule {
  SlidingSpeed,  ///< mu(|Omega| R_c) of the law of motion; mu_s when the string starts from rest
  Peak,          ///< mu_s (the source)
  None,
};

/// The string whose nodes are at the positions of the mesh; displacements are measured from it.
enum class Reference {
  Unloaded,
  Hanging,  ///< under its weight along the well, without friction
};

/// Treatment of an unstable static state.
enum class UnstableRule {
  Warn,
  Perturb,  ///< leave it along the unstable mode until a stable state is found
  Refuse,
};

/// The deck's `Static` list as a plain value.
struct StaticOptions {
  Recipe recipe = Recipe::Continuation;
  FrictionRule friction = FrictionRule::SlidingSpeed;
  Reference reference = Reference::Unloaded;
  bool exactJacobian = true;
  bool geometricStiffness = true;
  double tolerance = 1e-9;         ///< on the largest scaled residual
  int maxIterations = 200;         ///< per stage
  double lateralStepLimit = 0.05;  ///< [m], `Continuation`
  int frictionSteps = 4;           ///< `Continuation`
  UnstableRule unstable = UnstableRule::Warn;
};

/// Description of the deck list `Static`.
deck::ListSpec parameters();

/// Reads a validated `Static` list.
StaticOptions optionsFrom(const Teuchos::ParameterList& list);

/// A stage that does not converge is split into two, nested at most this often.
constexpr int mostHalvings = 5;

/// The static state. Throws ConvergenceError with the stage that failed and a remedy; ModelError
/// for inconsistent input.
StaticState solveStatic(const StaticInput& input, const StaticOptions& options,
                        const model::NonlinearSolver& solve, int halvings = mostHalvings);

/// The stable static state that the string reaches from the unstable state `from` along the mode:
/// see settle(); then friction and attraction as in solveStatic(). ConvergenceError if none is
/// found.
StaticState leaveUnstable(const StaticInput& input, const StaticOptions& options,
                          const model::NonlinearSolver& solve, const StaticState& from,
                          const UnstableMode& mode);

/// The static state that the string reaches from the displacement `start` by sliding: see
/// slideToRest(). None if it does not come to rest.
std::optional<StaticState> slideStatic(const StaticInput& input, const StaticOptions& options,
                                       const SlideRequest& asked, const Vector& start);

/// The complete state from its displacement (6 per node).
StaticState describe(const StaticInput& input, const StaticProblem& problem,
                     const Vector& displacement);

}  // namespace tooljoint::equilibrium
