// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Vectors of the interior of a part from any source: modes, Krylov vectors, files.
#pragma once

#include <string>
#include <vector>

#include "common/Index.hpp"
#include "reduction/selection/ModeChoice.hpp"

namespace tooljoint::reduction {

/// A vector with values on the dofs of one group, zero everywhere else.
struct ModalVector {
  double eigenvalue = 0;  ///< omega^2 [rad^2/s^2], or the Ritz value; negative for buckling
  int group = 0;          ///< index into InteriorVectors::groups
  Vector shape;           ///< dofs of the group, mass-normalised
  double residual = 0;    ///< relative, of the equation that defines it, recomputed
  std::string kind;
  std::string why = "as requested";
  std::string name = {};  ///< "vector k" when empty
  bool floating = false;  ///< moves without elastic energy: omega^2 is zero up to rounding
  bool rigid = false;     ///< floating, and no skew stiffness acts on it

  /// omega^2 for tables.
  double shown() const { return floating || rigid ? 0.0 : eigenvalue; }
};

/// Vectors of one source for a part.
struct InteriorVectors {
  std::vector<std::vector<int>> groups;  ///< dofs of the part, each increasing
  std::vector<ModalVector> vectors;      ///< all computed vectors, the kept ones first
  int kept = 0;                          ///< the first `kept` of them fulfil the request
  bool complete = false;                 ///< `vectors` contains all vectors that exist
  bool removable = false;                ///< fewer kept vectors fulfil a smaller request
  double orthogonality = 0;              ///< max |V' M V - 1| over the groups
  std::string method;                    ///< computation method, for tables
  std::vector<std::string> remarks;      ///< remarks for the user

  Vector eigenvalues() const;
  /// Number of rigid-body modes among `vectors`.
  int rigid() const;
  /// Vectors as columns, dofs of the part x `which`.
  Matrix columns(const std::vector<int>& which, int size) const;
  /// Keeps all vectors, by increasing eigenvalue.
  void keepAll();
  /// Adds remarks on fewer or more kept vectors than requested.
  /// \param available  number of existing vectors
  void remarkOnCount(const ModeRequest& request, int available, const std::string& what = "modes");
};

}  // namespace tooljoint::reduction
