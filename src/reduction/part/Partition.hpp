// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Partition of the dofs of one part for reduction: interface, retained, interior; and the coupling
/// of interior dofs.
#pragma once

#include <vector>

#include "common/Index.hpp"
#include "model/Substructure.hpp"

namespace tooljoint::reduction {

/// Positions of the dofs of a part. The boundary (C) is the interface followed by the retained
/// dofs. Interior dofs (I) are divided into blocks that are coupled neither by mass nor by
/// stiffness. Every block is a separate small problem; if it does not touch a boundary dof, the
/// basis is structurally zero there.
struct Partition {
  int size = 0;
  std::vector<int> interface;  ///< increasing
  std::vector<int> retained;   ///< increasing, disjoint from interface
  std::vector<int> boundary;   ///< interface, then retained: the first reduced coordinates
  std::vector<int> interior;   ///< increasing
  std::vector<std::vector<int>>
      blocks;  ///< indices into `interior`, each increasing, ordered by their first index
  std::vector<std::vector<int>>
      touched;  ///< per block: indices into `boundary` of the dofs coupled with it, increasing
};

/// Throws ModelError, naming the part and the dof, when the model is inconsistent, its mass is not
/// symmetric, or interface and retained positions are out of range, not increasing or named twice.
void checkPart(const model::Substructure& part);

/// Sorts the dofs of `part`. Errors of checkPart.
Partition partition(const model::Substructure& part);

/// Sorts the dofs of a part with this boundary, without checks.
/// \param K  constantStiffness
Partition partition(const model::SecondOrderModel& model, const Sparse& K,
                    const std::vector<int>& interface, const std::vector<int>& retained);

/// Sum of the stiffness terms with the law "1": the stiffness for the basis, full and unsymmetric.
Sparse constantStiffness(const model::SecondOrderModel& model);

/// (A + A') / 2.
Sparse symmetricPart(const Sparse& A);

/// True when |a_ij - a_ji| <= tolerance sqrt(|a_ii a_jj|) for all entries (rows without diagonal:
/// relative to the largest entry).
bool nearlySymmetric(const Sparse& A, double tolerance);

/// Largest |a_ij|; 0 without entries.
double largestEntry(const Sparse& A);

/// A(rows, columns) as a new sparse matrix; both lists without repetition.
Sparse block(const Sparse& A, const std::vector<int>& rows, const std::vector<int>& columns);

/// A_II; A itself if there is no boundary.
model::SharedSparse interiorOf(const Partition& partition, const model::SharedSparse& A);

}  // namespace tooljoint::reduction
