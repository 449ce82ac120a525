// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// `tooljoint torque-drag`: hook load, surface torque and margins of a deck's string as a function
/// of bit depth, by the soft-string model and by the string with bending stiffness.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "substructures/drillstring/analyses/StiffRows.hpp"
#include "substructures/drillstring/analyses/StiffString.hpp"
#include "substructures/drillstring/case/DrillstringCase.hpp"
#include "substructures/drillstring/scene/Scene.hpp"
#include "substructures/softstring/Pressure.hpp"
#include "substructures/softstring/SoftString.hpp"
#include "substructures/softstring/TorqueDragParameters.hpp"

namespace tooljoint::drillstring {

/// One operation at one bit depth.
struct TorqueDragRow {
  double bit = 0.0;  ///< [m]
  std::string operation;
  /// At the surface; NaN if the string locks up below it.
  double hookLoad = 0.0;                                ///< effective tension plus block weight [N]
  double surfaceTorque = 0.0;                           ///< -M(0) [N m]
  double twist = 0.0;                                   ///< of the surface relative to the bit
                                                        ///< [rad]
  double stretch = 0.0;                                 ///< by effective tension [m]
  double neutralDepth = 0.0;                            ///< no compression above it [m]
  double largestSideForce = 0.0, sideForceDepth = 0.0;  ///< [N/m], [m]
  Margin joint;  ///< largest side force on the length of a joint of pipe [N] and its middle
  Margin yield, sinusoidal, helical;
  double lockUpDepth = -1.0;  ///< [m]; negative: none
};

/// Loads and limits along the string, from the bit up.
struct TorqueDragProfile {
  TorqueDragRow row;
  softstring::Loads loads;
  std::vector<double> vonMises;             ///< [Pa]
  std::vector<double> sinusoidal, helical;  ///< critical compressions [N]; NaN where not requested
  std::optional<StiffLoads> stiff = std::nullopt;  ///< none: not computed at this depth
};

/// The deck's list `Torque and Drag`, or its defaults if the deck has none.
softstring::TorqueDragSettings torqueDragList(const Scene& scene);

/// The same with all depths. DeckError if a depth is below the deck's bit.
softstring::TorqueDragSettings torqueDragSettings(const Scene& scene);

/// DeckError, which begins with `where`, if the string does not reach the depth `bit` [m].
double withinReach(const Scene& scene, double bit, const std::string& where);

/// A deck's string in its hole for the soft-string model.
struct SoftModel {
  std::vector<softstring::Stretch> string;
  softstring::Hole hole;
};

/// A stretch touches the wall with the largest radius of its assembly entry (the tool joint of a
/// pipe). The scene must outlive the model. DeckError: the deck has no friction or no weight.
SoftModel softModel(const Scene& scene);

/// Rotary speed of the operations that turn [rad/s]: from the settings, otherwise that of the deck
/// after its start, otherwise a usual one.
double turningSpeed(const Scene& scene, const softstring::TorqueDragSettings& settings);

/// The operations of the settings, with weight and torque on bit from the deck's list `Loads`.
std::vector<softstring::Operation> softOperations(const Scene& scene,
                                                  const softstring::TorqueDragSettings& settings);

/// One soft-string computation with its margins. Yield by von Mises stress from effective tension,
/// bending by the curvature of the hole, torsion, and inside minus outside pressure, at both walls
/// of the pipe. \param allLimits  critical compressions all along the string; otherwise in
/// compression only
TorqueDragProfile torqueDragAt(const SoftModel& model,
                               const softstring::TorqueDragSettings& settings,
                               const softstring::Operation& operation, double bit, bool allLimits);

/// The largest sum of forces [N] whose depths lie within `length` [m], and its middle. `depth`
/// increases.
Margin largestOver(double length, const std::vector<double>& depth,
                   const std::vector<double>& force);

/// Every operation at every depth, with the stiff string if the deck requests it. Collective.
std::vector<TorqueDragProfile> torqueDrag(const Scene& scene, const cases::RowFolder& store);

/// Prints the tables of the deepest bit and writes torque_drag.csv (a row for each depth and
/// operation), torque_drag_profile.csv and torque_drag_stiff_profile.csv (along the string, at the
/// deepest bit), those of the calibration, torque_drag.h5 and summary.json.
/// \param fresh      discards stored depths
/// \param announced  the case has been announced. Collective.
void reportTorqueDrag(const DrillstringCase& one, const std::string& folder, bool fresh,
                      bool announced = false);

/// True if the deck requests torque and drag at the end of a run (`After Run`). DeckError if it
/// cannot be computed.
bool torqueDragAfterRun(const DrillstringCase& one);

}  // namespace tooljoint::drillstring
