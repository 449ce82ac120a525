// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Phi = [1 0; psi V] from constraint modes psi and vectors V of the interior.
#pragma once

#include <string>

#include "reduction/ReductionMethod.hpp"
#include "reduction/vectors/InteriorVectors.hpp"

namespace tooljoint::reduction {

/// The basis of the constraint modes of `part` and the kept ones of `vectors`, with a report row
/// for each of them.
Basis fixedInterfaceBasis(const PartView& part, const InteriorVectors& vectors);

/// The basis of the constraint modes of `part` and the `count` lowest Ritz vectors in the span of
/// the columns of X (interior x columns), which need be neither orthonormal nor independent; `kind`
/// is their name in tables.
Basis subspaceBasis(const PartView& part, const Matrix& X, int count, const std::string& kind);

/// Sets partition, Phi, eigenvalues and kinds of `basis`; the rest is unchanged.
/// \param psi  dofs of the part x boundary dofs
void setVectors(const Partition& partition, const Sparse& psi, const InteriorVectors& vectors,
                Basis& basis);

/// Adds a report row for every constraint mode. `why` is for dofs that are neither on the interface
/// nor retained by the part.
void addConstraintRows(const PartView& part, const Partition& partition, const Vector& residuals,
                       Basis& basis, const std::string& why = "retained dof");

/// Adds a row for every vector, kept or not; sets candidates, `complete`, method and remarks of
/// `basis`.
void report(const InteriorVectors& vectors, Basis& basis);

}  // namespace tooljoint::reduction
