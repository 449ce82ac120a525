// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Tables of measured hook loads and surface torques.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace tooljoint::drillstring {

/// One line of the table; missing values are empty.
struct Measurement {
  double bit = 0.0;  ///< measured depth of the bit [m]
  std::string operation;
  std::optional<double> hookLoad;       ///< [N], block included
  std::optional<double> surfaceTorque;  ///< [N m]
};

/// A CSV file with a header: bit depth, operation, hook load, surface torque, in any order and with
/// units in brackets ("hook load [klbf]"). One of the last two may be missing; other columns are
/// ignored. `operations`: the known names. DeckError, one line per fault with file and line.
std::vector<Measurement> readMeasurements(const std::string& file,
                                          const std::vector<std::string>& operations);

}  // namespace tooljoint::drillstring
