// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Friction coefficients and block weight from measured hook loads and torques, with the
/// soft-string model and weighted least squares:
///
///     min_p sum ((computed(p) - measured)/uncertainty)^2,   0 <= mu <= 1,  block weight >= 0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/OutputFolder.hpp"
#include "io/summary/Summary.hpp"
#include "substructures/drillstring/analyses/Measurements.hpp"
#include "substructures/drillstring/analyses/TorqueDrag.hpp"

namespace tooljoint::drillstring {

/// One fitted quantity.
struct Fitted {
  std::string name;          ///< "friction", "friction in casing", "block weight"
  std::string parameter;     ///< its path in the deck
  double deck = 0.0;         ///< value of the deck
  double value = 0.0;        ///< [1] or [N]
  double uncertainty = 0.0;  ///< half the width of the 95 % confidence interval; NaN at a bound
  bool atBound = false;
};

struct Calibration {
  std::vector<Fitted> fitted;
  std::vector<Measurement> measured, computed;      ///< line by line; gaps as measured
  double hookLoadMisfit = 0.0, torqueMisfit = 0.0;  ///< root mean square [N], [N m]
  double scatter = 0.0;  ///< misfit in uncertainties of the measurements: about 1 is expected
};

/// Levenberg-Marquardt from the values of the deck. Confidence intervals of the linearised problem
/// by Student's t with the scatter of the residuals; quantities at a bound are held there.
/// Coefficients of stretches without influence on the measurements keep their values. DeckError:
/// fewer measured values than unknowns, or values that do not separate the unknowns.
/// ConvergenceError.
Calibration calibrate(const Scene& scene, const softstring::TorqueDragSettings& settings,
                      const std::vector<Measurement>& measured);

/// Hook load and surface torque of every operation at every depth, with one friction coefficient in
/// the whole hole: the curves of a broomstick plot.
struct BroomRow {
  double bit = 0.0, friction = 0.0;
  std::string operation;
  double hookLoad = 0.0, surfaceTorque = 0.0;  ///< NaN if the string locks up
};
std::vector<BroomRow> broomstick(const Scene& scene,
                                 const softstring::TorqueDragSettings& settings);

/// Results that the deck requests.
struct CalibrationResults {
  std::optional<Calibration> fit;
  std::vector<BroomRow> broomstick;
};

/// The table of the settings, empty without one. DeckError if it is missing or malformed, or holds
/// depths below the string.
std::vector<Measurement> measurementsOf(const Scene& scene,
                                        const softstring::TorqueDragSettings& settings);

/// Reads the measurements, fits and prints. Collective.
CalibrationResults calibrationOf(const Scene& scene,
                                 const softstring::TorqueDragSettings& settings);

/// torque_drag_calibration.csv, torque_drag_measured.csv and torque_drag_broomstick.csv.
void stage(const CalibrationResults& found, io::OutputFolder& folder);
/// Keys torque_drag.calibration.
void summarise(const CalibrationResults& found, io::Summary& summary);

}  // namespace tooljoint::drillstring
