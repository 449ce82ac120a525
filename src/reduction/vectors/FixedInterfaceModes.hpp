// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Vibration modes of the interior with all kept dofs held.
#pragma once

#include <string>
#include <vector>

#include "reduction/part/Partition.hpp"
#include "reduction/selection/ModeChoice.hpp"

namespace tooljoint::reduction {

/// One mode of one link; zero everywhere else.
struct FixedInterfaceMode {
  double eigenvalue =
      0;         ///< omega^2 [rad^2/s^2]; negative when the part is buckled between its kept dofs
  int link = 0;  ///< index into Partition::links
  Vector shape;  ///< dofs of the link, M_II-normalised
  double residual = 0;  ///< relative, recomputed
  bool floating =
      false;  ///< a rigid-body motion: omega^2 is zero but for rounding, whatever its sign
  bool buckled() const { return eigenvalue < 0.0 && !floating; }
  /// omega^2 for tables.
  double shown() const { return floating ? 0.0 : eigenvalue; }
};

struct FixedInterfaceModes {
  std::vector<FixedInterfaceMode>
      modes;                 ///< all that were computed, by increasing eigenvalue, then link
  int kept = 0;              ///< the first `kept` of them answer the request
  bool complete = false;     ///< `modes` are all there are
  double orthogonality = 0;  ///< max |Phi' M Phi - I| over the links
  std::string method;        ///< "dense", ... as reported by the eigensolver
  std::vector<std::string> remarks;  ///< when fewer or more are kept than asked for
};

/// omega^2 M_II phi = sym(K)_II phi (Nguyen et al. 2020, (35), with the symmetric part of K: the
/// modes are real; the skew part acts on them through the projection). Throws ModelError or
/// ConvergenceError of the eigensolver, naming the part and `kind`. \param symmetricK symmetricPart
/// of the constantStiffness of the part
FixedInterfaceModes fixedInterfaceModes(const model::Substructure& part, const Partition& partition,
                                        const Sparse& symmetricK, const ModeRequest& request,
                                        const std::string& kind = "fixed-interface modes");

}  // namespace tooljoint::reduction
