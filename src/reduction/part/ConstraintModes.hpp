// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Static shapes of the interior for unit motions of the boundary dofs.
#pragma once

#include <vector>

#include "common/Types.hpp"
#include "reduction/part/Partition.hpp"

namespace tooljoint::reduction {

class PartView;

/// phi_C = -K_II^-1 K_IC (Nguyen et al. 2020, (33)), with the full, unsymmetric K: then the reduced
/// part answers loads on boundary dofs exactly as the full part does, whatever the torque or the
/// circulatory forces in K.
struct ConstraintModes {
  Sparse vectors;    ///< dofs of the part x boundary dofs: [1; phi_C], structural zeros absent
  Vector residuals;  ///< per boundary dof: |K_II phi + K_IC| / (|K_II| |phi| + |K_IC|)
};

/// Collects constraint modes, any interior dofs at a time.
class ConstraintModeBuilder {
 public:
  explicit ConstraintModeBuilder(const Partition& partition);
  /// Takes `phi`, a solution of K_II phi = -K_IC for the interior dofs at the positions `inner` and
  /// the boundary dofs with the indices `touched`. Blocks with the same `inner` follow each other
  /// in the order of their boundary dofs.
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

/// Block by block; PartView::constraintModes has them. Throws ModelError naming the dof when the
/// interior is a mechanism although the boundary dofs are held.
ConstraintModes constraintModes(const PartView& part);

}  // namespace tooljoint::reduction
