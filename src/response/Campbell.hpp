// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Campbell diagram: damped eigenvalues against the rotary speed, and where excitations of the
/// speed meet them.
#pragma once

#include <Teuchos_ParameterList.hpp>
#include <complex>
#include <string>
#include <vector>

#include "deck/ListSpec.hpp"
#include "response/RotatingCase.hpp"

namespace tooljoint::response {

/// The deck list `Campbell`.
struct CampbellSettings {
  std::vector<double> speeds;  ///< [rad/s], increasing
  int modes = 0;               ///< followed at least
  std::vector<double> orders;  ///< of the excitation: frequency over rotary speed
  bool friction = false;
  int spotChecks = 0;  ///< speeds at which the full model is solved too
  std::string axis;    ///< of the rotation: "x", "y" or "z"
};
deck::ListSpec campbellParameters();
/// From the validated list. DeckError: the speeds do not increase.
CampbellSettings readCampbell(const Teuchos::ParameterList& list);

/// A mode at a speed.
struct CampbellRow {
  double speed = 0.0;  ///< [rad/s]
  int mode = 0;        ///< number of the track, from 1
  std::complex<double> s;
  double mac = 1.0;    ///< with the mode at the speed before (ModeTracker)
  double whirl = 0.0;  ///< +1: all nodes go round with the rotation in circles, -1: against it, 0:
                       ///< in lines, not across the axis, or a repeated value
  double error = 0.0;  ///< estimate of |s - s_full| / |s| of a reduced model
  double frequency() const;  ///< Im s / 2 pi [Hz]
  double damping() const;    ///< -Re s / |s|
};

/// A critical speed: Im s = order Omega.
struct Crossing {
  double order = 0.0;
  CampbellRow at;  ///< the mode there; whirl, mac and error of the nearest speed of the diagram
  bool refined = true;  ///< false: by linear interpolation between two speeds
};

/// A mode of the full model beside that of the reduced one.
struct SpotCheck {
  double speed = 0.0;  ///< [rad/s]
  int mode = 0;        ///< track of the reduced mode; 0: none
  std::complex<double> full, reduced;
  double error = 0.0;  ///< |s - s_full| / |s_full|
  double estimate = 0.0;
  double mac = 0.0;
};

struct CampbellDiagram {
  std::vector<CampbellRow> rows;    ///< speed by speed, by |s|
  std::vector<Crossing> crossings;  ///< by order, then speed
  std::vector<SpotCheck> checks;
};

/// Follows the modes through the speeds of the settings (ModeTracker). A crossing is refined with
/// the equations at its own speed. ConvergenceError, ModelError of the eigensolver. Every rank
/// computes the same.
CampbellDiagram campbell(const RotatingCase& rotating, const CampbellSettings& settings);

/// `tooljoint campbell`: state at rest, diagram, campbell.csv, crossings.csv, spot_checks.csv,
/// campbell.h5 and summary.json in `folder` ("": see cases::analysisFolder). DeckError without the
/// list Campbell. Collective.
void runCampbell(const cases::Case& one, const std::string& folder);

}  // namespace tooljoint::response
