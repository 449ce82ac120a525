// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What one step of a transient costs, counted on the compiled model before anything moves: is the
/// reduced model faster?
#pragma once

#include "model/SecondOrderModel.hpp"
#include "transient/TransientParameters.hpp"

namespace tooljoint::transient {

/// Work of one step, in multiplications or what takes as long.
struct CostModel {
  int size = 0;  ///< dofs
  double solves =
      0;  ///< with the factor of the effective matrix (implicit) or of the mass matrix (explicit)
  double products = 0;  ///< M, C and K times vectors
  double points =
      0;  ///< gathering, laws and scattering at the points near contact, clearances of the others
  double vectors = 0;  ///< sums of vectors
  double total() const { return solves + products + points + vectors; }
};

/// Cost of a step on this model in its initial state: of generalized-alpha with its usual number of
/// iterations for an implicit integrator, of RK4 for an explicit one. Other integrators take the
/// same pieces in other numbers, on which the ratio of two models hardly depends. Throws ModelError
/// when the model is inconsistent.
CostModel costModel(const model::SecondOrderModel& model, const TransientOptions& options);

/// A reduced model is called faster when a step of it is predicted to cost less than this part of
/// one of the full model: the prediction knows nothing of the iterations and factorisations a
/// reduced model may need beside.
constexpr double worthReducing = 0.85;

}  // namespace tooljoint::transient
