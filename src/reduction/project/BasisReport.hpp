// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What is known about a basis: every mode with its frequency and residual, kept or dropped and
/// why, and the checks made on it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "common/Types.hpp"

namespace tooljoint::reduction {

/// One candidate vector of a basis.
struct BasisRow {
  std::string kind;       ///< "constraint", "fixed-interface", ...
  std::string name;       ///< "theta_z of node 17" or "mode 3"
  double eigenvalue = 0;  ///< omega^2 [rad^2/s^2] (constraint modes: Rayleigh quotient); negative
                          ///< for a part that is buckled
  double residual = 0;    ///< relative residual of the equation that defines the vector, recomputed
  bool kept = true;
  std::string why;  ///< why it is kept or dropped

  /// sqrt(|omega^2|) / (2 pi) [Hz]; look at the sign of `eigenvalue` before calling it a frequency.
  double frequency() const;
};

using BasisRows = std::shared_ptr<const std::vector<BasisRow>>;

/// The rows of a report that has none.
inline const BasisRows& noRows() {
  static const BasisRows none = std::make_shared<const std::vector<BasisRow>>();
  return none;
}

/// Checks of one basis. Numbers that were not computed are negative where they are otherwise
/// non-negative.
struct BasisReport {
  std::string part;
  std::string basis;
  std::string method;         ///< how the eigenproblem was solved
  std::string sharedWith;     ///< name of the identical part whose reduction was taken over, or ""
  int interface = 0;          ///< dofs
  int retained = 0;           ///< dofs
  int interior = 0;           ///< dofs
  int modes = 0;              ///< kept modal coordinates
  int negativeModes = 0;      ///< kept modes with omega^2 < 0
  BasisRows rows = noRows();  ///< one for all identical parts

  double orthogonality = 0;  ///< max |Phi_D' M Phi_D - I|
  double massDefect = 0;     ///< max |m_DD - I| as projected
  double stiffnessDefect =
      0;  ///< largest off-diagonal of sym(k_DD), relative to sqrt(k_ii k_jj), as projected
  bool structureEnforced = false;  ///< the two defects were below 1e-10 and rounding was removed
  bool checked = false;            ///< the checks below were made
  int rank = -1;                   ///< numerical rank of the basis
  double conditioning = -1;        ///< condition number of the column-scaled basis
  double staticDefect =
      -1;  ///< largest relative difference reduced - full for unit loads on boundary dofs
  int zeroEnergyFull = -1;     ///< zero-energy modes of the part
  int zeroEnergyReduced = -1;  ///< zero-energy modes of the reduced part
  double largestOmega =
      -1;  ///< largest eigenfrequency of the reduced part alone [rad/s]; 0 for no dofs
  double explicitStep = -1;  ///< 2.78 / largestOmega [s]: what RK4 allows; a model coupled of parts
                             ///< allows at least the least of theirs
  /// Kinetic and strain energy of the start, e(x, v) = (v'M v + |x'K x|) / 2 with x = D(0) -
  /// offset, and that of what the basis does not represent of it, e(x - Phi q(0), v - Phi q'(0))
  /// [J].
  double startEnergy = 0, startMisfit = 0;
  std::vector<std::string> remarks;  ///< sentences a user should read

  /// Frequency of the highest kept mode [Hz], 0 without modes.
  double cutOffHz() const;
  /// Frequency of the lowest mode that was computed and dropped [Hz], 0 when none was.
  double firstDroppedHz() const;
  int reducedSize() const { return interface + retained + modes; }
  /// Every row: kind, name, frequency, residual, kept or dropped and why. Unless `all`, constraint
  /// modes are one line and only the first two dropped modes are listed.
  std::string table(bool all = false) const;
};

/// One line per part and a line of totals.
std::string summaryTable(const std::vector<const BasisReport*>& reports);

}  // namespace tooljoint::reduction
