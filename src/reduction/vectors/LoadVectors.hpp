// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Load-dependent residual vectors: the static response to loads outside the modes of a
/// fixed-interface basis (J. M. Dickens, J. M. Nakagawa, M. J. Wittbrodt, A critique of mode
/// acceleration and modal truncation augmentation methods for modal response analysis, Computers &
/// Structures 62 (1997) 985-998).
#pragma once

#include <cstdint>
#include <vector>

#include "deck/ListSpec.hpp"
#include "reduction/ReductionMethod.hpp"

namespace tooljoint::reduction {

struct LoadVectorOptions {
  bool startState = false;  ///< displacement and velocity at t = 0
  bool keepStatic = true;   ///< the displacement is measured from the reference state of the part
  bool loads = false;       ///< of every load term of a part
  bool points = false;      ///< of a unit force on every row of its point laws
  std::vector<std::int64_t> nodes;  ///< only points of these nodes; empty: all
  double independence = 1e-6;       ///< smallest independent fraction of a response (mass norm)
  bool any() const { return loads || points || startState; }
};

/// Adds to `basis` the new part of K_II^-1 f_I for every load f (with the full, unsymmetric K;
/// inertia balances blocks that touch no boundary dof). The static response of the reduced part to
/// these loads is then exact. With `startState` also the new part of the interior displacement and
/// velocity at t = 0, x_I - phi_C x_C, so that the motion starts as in the full part. DeckError
/// when modes of the basis move boundary dofs, ModelError when the interior is a mechanism.
void addLoadVectors(const PartView& part, const LoadVectorOptions& options, Basis& basis);

/// Throws DeckError when a node of the options has no point law in any of the parts.
void requirePointNodes(const std::vector<model::Substructure>& parts,
                       const LoadVectorOptions& options);

/// Classes of identical parts (the first of each, as findIdenticalParts) that also have the same
/// loads, points and start states. DeckError when a node of the options has no point.
std::vector<int> sameLoads(const std::vector<model::Substructure>& parts,
                           const std::vector<int>& classes, const LoadVectorOptions& options);

/// Adds "Load Vectors", "Start State Vectors" and related parameters to the description of a list,
/// and reads them.
void declareLoadVectors(deck::ListSpec& list);
LoadVectorOptions readLoadVectors(const Teuchos::ParameterList& list);

}  // namespace tooljoint::reduction
