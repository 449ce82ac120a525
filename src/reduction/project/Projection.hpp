// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Phi' A Phi for the matrices of a part, with rounding removed where theory says zero.
#pragma once

#include <vector>

#include "reduction/ReductionMethod.hpp"

namespace tooljoint::reduction {

/// Reduced matrices of a part. Laws index the laws of the part.
struct ProjectedMatrices {
  model::SharedSparse mass;
  model::SharedList<model::MatrixTerm> damping;  ///< one per damping term of the part
  model::SharedList<model::MatrixTerm>
      stiffness;  ///< the constant terms summed, then one per term that varies in time
  Sparse
      constantStiffness;  ///< the reduced stiffness that is constant in time, also when it is zero
  double massDefect =
      0;  ///< max |m_DD - I| before rounding was removed; 0 unless the basis is orthonormal
  double stiffnessDefect = 0;  ///< off-diagonal of sym(k_DD) relative to sqrt(k_ii k_jj), likewise
  bool structureEnforced = false;
};

/// The stiffness terms of a part as they are projected: all constant ones as one sum (only the sum
/// has the structure of the basis: k_DC = 0, sym(k_DD) diagonal), then the others as they are.
std::vector<model::MatrixTerm> stiffnessTerms(const model::SecondOrderModel& model);

/// Phi' A Phi; exact zeros are absent.
Sparse project(const Sparse& A, const Sparse& Phi);

/// All matrices of `part`. For an orthonormal basis whose m_DD is I and whose sym(k_DD) is diagonal
/// to 1e-10, these and the block k_DC (and k_CD where K is symmetric) are set to what they are in
/// theory; otherwise they are left as projected and the defects show it. Entries of the constant
/// stiffness below 1e-14 of |phi_i|' |K| |phi_j| are rounding and left out. Mass and damping are
/// projected on basis.inertial where the basis has it. A damping matrix that is a combination a M +
/// b K of the part (Rayleigh damping) becomes a m + b k.
ProjectedMatrices projectMatrices(const PartView& part, const Basis& basis);

}  // namespace tooljoint::reduction
