// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Reduction of the dofs at which parts are joined. A variant is one file that registers itself in
/// InterfaceRegistry.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "common/Types.hpp"
#include "deck/Registry.hpp"
#include "linalg/trilinos/DirectSolver.hpp"

namespace Teuchos {
class ParameterList;
}

namespace tooljoint::reduction {

/// The coupled model restricted to the joined dofs that may be reduced; all others are fixed.
struct InterfaceProblem {
  Sparse stiffness;            ///< constant, full and unsymmetric
  Sparse mass;                 ///< symmetric
  std::vector<int> interface;  ///< per dof its interface, 0-based: the dofs that join the same
                               ///< parts
  int interfaces = 0;
  /// Per interface those that join some of its parts, and no others: for a corner the edges that
  /// meet there.
  std::vector<std::vector<int>> within;
  Sparse coupling;  ///< stiffness towards the other coordinates, dofs x others
  Matrix loads;     ///< constant load vectors, dofs x loads
  linalg::DofNamer name;
};

/// u = vectors xi + attached u_other.
struct InterfaceVectors {
  Matrix vectors;              ///< dofs x modes
  std::vector<int> interface;  ///< per mode: its interface, or 0 when it spans all of them
  Vector eigenvalues;  ///< omega^2 per mode [rad^2/s^2]; of load vectors their Rayleigh quotient
  Sparse attached;     ///< dofs x others: dofs as functions of the other coordinates
};

/// Options of all variants.
struct InterfaceOptions {
  int modes = -1;  ///< in total, or per interface; -1: by cut-off frequency
  double cutOffHz = 0;
  bool loadVectors = true;  ///< include the static response to every load
};

class InterfaceBasis {
 public:
  virtual ~InterfaceBasis() = default;
  /// Throws ModelError when the mass of the interface is singular, ConvergenceError of the
  /// eigensolver.
  virtual InterfaceVectors build(const InterfaceProblem& problem) const = 0;
  /// True if dofs with point laws remain unchanged.
  virtual bool keepsPointLaws() const { return true; }
};

using InterfaceRegistry = deck::Registry<InterfaceBasis, const Teuchos::ParameterList&>;

/// Characteristic constraint modes, K_GG psi = omega^2 M_GG psi with the joined dofs G of all parts
/// (M. P. Castanier, Y.-C. Tan, C. Pierre, AIAA Journal 39 (2001) 1182-1187).
std::unique_ptr<InterfaceBasis> systemInterfaceModes(const InterfaceOptions& options,
                                                     bool keepPointLaws = true);
/// The same for each interface by itself, with the others held, which keeps the model sparse (S.-K.
/// Hong, B. I. Epureanu, M. P. Castanier, Mech. Syst. Signal Process. 37 (2013) 403-421; D.
/// Krattiger et al., Mech. Syst. Signal Process. 114 (2019) 579-603). Interfaces within it
/// (InterfaceProblem::within) deform statically with it: a corner takes its edges along.
std::unique_ptr<InterfaceBasis> localInterfaceModes(const InterfaceOptions& options,
                                                    bool keepPointLaws = true);

}  // namespace tooljoint::reduction
