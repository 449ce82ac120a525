// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Vibration modes of a part with nothing held, its rigid-body modes found and counted.
#pragma once

#include <string>
#include <vector>

#include "reduction/part/Partition.hpp"
#include "reduction/selection/ModeChoice.hpp"

namespace tooljoint::reduction {

struct Basis;

/// One mode of one free link; zero everywhere else.
struct FreeInterfaceMode {
  double eigenvalue =
      0;         ///< omega^2 [rad^2/s^2]; negative when the part buckles although nothing holds it
  int link = 0;  ///< index into FreeInterfaceModes::links
  Vector shape;  ///< dofs of the link, M-normalised
  double residual = 0;    ///< relative, recomputed
  bool rigid = false;     ///< moves without elastic energy, and no skew stiffness acts on it
  bool floating = false;  ///< moves without elastic energy: omega^2 is zero but for rounding
};

struct FreeInterfaceModes {
  std::vector<std::vector<int>> links;  ///< positions of the dofs that mass and stiffness join when
                                        ///< nothing is held, increasing
  std::vector<FreeInterfaceMode>
      modes;  ///< all that were computed, by increasing eigenvalue, then link
  int kept =
      0;  ///< the first `kept` of them answer the request; every rigid-body mode is among them
  int rigid = 0;             ///< rigid-body modes of the part
  bool complete = false;     ///< `modes` are all there are
  double orthogonality = 0;  ///< max |Phi' M Phi - I| over the links
  std::string method;
  std::vector<std::string> remarks;

  /// Kept modes of one link, dofs of the link x modes, and their numbers.
  Matrix shapes(int link, std::vector<int>& numbers) const;
  /// The first `count` modes as columns, dofs of the part x count.
  Matrix columns(int count, int size) const;
};

/// omega^2 M phi = sym(K) phi with no dof held: the modes are real; skew parts of K and the damping
/// act on them through the projection. A mode is rigid when |phi' K phi| <= 1e-12 |phi|' |K| |phi|
/// and K phi and K' phi are rounding (1e-7 of |K| |phi|); all rigid-body modes are kept whatever
/// the request says. Throws ModelError (mass not positive definite) or ConvergenceError of the
/// eigensolver, naming the part. \param K constantStiffness of the part
FreeInterfaceModes freeInterfaceModes(const model::Substructure& part, const Sparse& K,
                                      const ModeRequest& request);

/// Rows, candidates, method and remarks of `basis` for these modes; `why` is said of those that are
/// kept.
void report(const FreeInterfaceModes& modes, Basis& basis);

}  // namespace tooljoint::reduction
