// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Static shapes of the interior for unit motions of the boundary dofs.
#pragma once

#include <vector>

#include "common/Types.hpp"
#include "reduction/part/Partition.hpp"

namespace tooljoint::reduction {

class PartView;

/// phi_C = -K_II^-1 K_IC (Nguyen et al. 2020, (33)), with the full, unsymmetric K: the response of
/// the reduced part to loads on boundary dofs is then exact, with any torque or circulatory forces
/// in K.
struct ConstraintModes {
  Sparse vectors;    ///< dofs of the part x boundary dofs: [1; phi_C], structural zeros absent
  Vector residuals;  ///< per boundary dof: |K_II phi + K_IC| / (|K_II| |phi| + |K_IC|)
};

/// Assembles constraint modes, for any subset of interior dofs at a time.
class ConstraintModeBuilder {
 public:
  explicit ConstraintModeBuilder(const Partition& partition);
  /// Adds `phi`, a solution of K_II phi = -K_IC for the interior dofs at the positions `inner` and
  /// the boundary dofs with the indices `touched`. Blocks with the same `inner` must follow each
  /// other in the order of their boundary dofs.
  void add(const Sparse& KII, const Matrix& KIC, Matrix phi, const std::vector<int>& inner,
           const std::vector<int>& touched);
  ConstraintModes result() const;

 private:
  struct InteriorBlock {
    std::vector<int> inner, touched;
    Matrix shapes;
  };
  const Partition& partition_;
  std::vector<InteriorBlock> blocks_;
  Vector residuals_;
};

/// Computed block by block; available as PartView::constraintModes. Throws ModelError with the dof
/// when the interior is a mechanism although the boundary dofs are held.
ConstraintModes constraintModes(const PartView& part);

}  // namespace tooljoint::reduction
