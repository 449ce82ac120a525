// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Static shapes of the interior for unit motions of the kept dofs.
#pragma once

#include "reduction/part/Partition.hpp"

namespace tooljoint::reduction {

/// phi_C = -K_II^-1 K_IC (Nguyen et al. 2020, (33)), with the full, unsymmetric K: then the reduced
/// part answers loads on kept dofs exactly as the full part does, whatever the torque or the
/// circulatory forces in K.
struct ConstraintModes {
  Triplets entries;  ///< of Phi: row = position in the part, column = index into Partition::kept
  Vector residuals;  ///< per kept dof: |K_II phi + K_IC| / (|K_II| |phi| + |K_IC|)
};

/// Link by link. Throws ModelError naming the dof when the interior is a mechanism although the
/// kept dofs are held. \param K constantStiffness of the part
ConstraintModes constraintModes(const model::Substructure& part, const Partition& partition,
                                const Sparse& K);

}  // namespace tooljoint::reduction
