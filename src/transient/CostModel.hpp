// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Cost of one time step, counted on the compiled model before the run: is the reduced model
/// faster?
#pragma once

#include "model/SecondOrderModel.hpp"
#include "transient/TransientParameters.hpp"

namespace tooljoint::transient {

/// Work of one step, in units of one multiplication.
struct CostModel {
  int size = 0;  ///< dofs
  double solves =
      0;  ///< with the factor of the effective matrix (implicit) or of the mass matrix (explicit)
  double products = 0;  ///< M, C and K times vectors
  double points = 0;  ///< gather, laws and scatter of points near contact; clearances of the others
  double vectors = 0;  ///< sums of vectors
  double total() const { return solves + products + points + vectors; }
};

/// Cost of a step on this model in its initial state: of generalized-alpha with its usual number of
/// iterations for an implicit integrator, of RK4 for an explicit one. Other integrators combine the
/// same operations in other numbers, which hardly changes the ratio of two models. Throws
/// ModelError if the model is inconsistent.
CostModel costModel(const model::SecondOrderModel& model, const TransientOptions& options);

/// A reduced model counts as faster if its predicted cost per step is below this fraction of the
/// cost of the full model. The margin covers iterations and factorisations that a reduced model may
/// need in addition; the prediction does not include them.
constexpr double worthReducing = 0.85;

}  // namespace tooljoint::transient
