// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Report on a basis: every mode with its frequency and residual, the reason for keeping or
/// dropping it, and the results of checks.
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
                          ///< for a buckled part
  double residual = 0;    ///< relative residual of the equation that defines the vector, recomputed
  bool kept = true;
  std::string why;  ///< reason for keeping or dropping it

  /// sqrt(|omega^2|) / (2 pi) [Hz]; it is a frequency only if `eigenvalue` is positive.
  double frequency() const;
};

using BasisRows = std::shared_ptr<const std::vector<BasisRow>>;

/// The rows of a report without rows.
inline const BasisRows& noRows() {
  static const BasisRows none = std::make_shared<const std::vector<BasisRow>>();
  return none;
}

/// Checks of one basis. Values that are normally non-negative are negative if they were not
/// computed.
struct BasisReport {
  std::string part;
  std::string basis;
  std::string method;         ///< method of the eigensolver
  std::string sharedWith;     ///< name of the identical part whose reduction was reused, or ""
  int interface = 0;          ///< dofs
  int retained = 0;           ///< dofs
  int interior = 0;           ///< dofs
  int modes = 0;              ///< kept modal coordinates
  int negativeModes = 0;      ///< kept modes with omega^2 < 0
  BasisRows rows = noRows();  ///< shared by all identical parts

  double orthogonality = 0;  ///< max |Phi_D' M Phi_D - I|
  double massDefect = 0;     ///< max |m_DD - I| as projected
  double stiffnessDefect =
      0;  ///< largest off-diagonal of sym(k_DD), relative to sqrt(k_ii k_jj), as projected
  bool structureEnforced = false;  ///< the two defects were below 1e-10, and rounding was removed
  bool checked = false;            ///< the checks below were made
  int rank = -1;                   ///< numerical rank of the basis
  double conditioning = -1;        ///< condition number of the column-scaled basis
  double staticDefect =
      -1;  ///< largest relative difference reduced - full for unit loads on boundary dofs
  int zeroEnergyFull = -1;     ///< zero-energy modes of the part
  int zeroEnergyReduced = -1;  ///< zero-energy modes of the reduced part
  double largestOmega =
      -1;  ///< largest eigenfrequency of the reduced part alone [rad/s]; 0 for no dofs
  double explicitStep = -1;  ///< 2.78 / largestOmega [s]: limit of RK4; that of a coupled model is
                             ///< at least the smallest one of its parts
  /// Kinetic and strain energy of the start, e(x, v) = (v'M v + |x'K x|) / 2 with x = D(0) -
  /// offset, and the energy of the part that the basis does not represent, e(x - Phi q(0), v - Phi
  /// q'(0)) [J].
  double startEnergy = 0, startMisfit = 0;
  std::vector<std::string> remarks;  ///< remarks for the user

  /// Frequency of the highest kept mode [Hz], 0 without modes.
  double cutOffHz() const;
  /// Frequency of the lowest computed mode that was dropped [Hz], 0 if there is none.
  double firstDroppedHz() const;
  int reducedSize() const { return interface + retained + modes; }
  /// Every row: kind, name, frequency, residual, and reason for keeping or dropping. Unless `all`,
  /// constraint modes take one line and only the first two dropped modes are listed.
  std::string table(bool all = false) const;
};

/// One line per part and a line of totals.
std::string summaryTable(const std::vector<const BasisReport*>& reports);

}  // namespace tooljoint::reduction
