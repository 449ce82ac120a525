// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Phi' A Phi for the matrices of a part, with rounding removed from entries that are zero in
/// theory.
#pragma once

#include <vector>

#include "reduction/ReductionMethod.hpp"

namespace tooljoint::reduction {

/// Reduced matrices of a part. Laws index the laws of the part.
struct ProjectedMatrices {
  model::SharedSparse mass;
  model::SharedList<model::MatrixTerm> damping;  ///< one per damping term of the part
  model::SharedList<model::MatrixTerm>
      stiffness;  ///< the sum of the constant terms, then one term for each law of time
  Sparse
      constantStiffness;  ///< the reduced stiffness that is constant in time, also when it is zero
  double massDefect =
      0;  ///< max |m_DD - I| before rounding was removed; 0 unless the basis is orthonormal
  double stiffnessDefect = 0;  ///< off-diagonal of sym(k_DD) relative to sqrt(k_ii k_jj), likewise
  bool structureEnforced = false;
};

/// The stiffness terms of a part for projection: the sum of the constant terms (only the sum has
/// the structure of the basis: k_DC = 0, sym(k_DD) diagonal), then the others unchanged.
std::vector<model::MatrixTerm> stiffnessTerms(const model::SecondOrderModel& model);

/// Phi' A Phi; exact zeros are absent.
Sparse project(const Sparse& A, const Sparse& Phi);

/// All matrices of `part`. If m_DD = I and sym(k_DD) is diagonal to 1e-10 for an orthonormal basis,
/// these and the block k_DC (and k_CD for symmetric K) are set to their theoretical values;
/// otherwise they are left as projected, and the defects are reported. Entries of the constant
/// stiffness below 1e-14 of |phi_i|' |K| |phi_j| are rounding and are omitted. Mass and damping are
/// projected on basis.inertial if the basis has it. A damping matrix that is a combination a M + b
/// K of the part (Rayleigh damping) becomes a m + b k.
ProjectedMatrices projectMatrices(const PartView& part, const Basis& basis);

}  // namespace tooljoint::reduction
