// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Campbell diagram: damped eigenvalues as functions of the rotary speed, and their crossings with
/// excitations that depend on the speed.
#pragma once

#include <Teuchos_ParameterList.hpp>
#include <complex>
#include <optional>
#include <string>
#include <vector>

#include "cases/run/ResumedRows.hpp"
#include "deck/ListSpec.hpp"
#include "response/RotatingStates.hpp"

namespace tooljoint::response {

/// A window of frequencies [Hz].
struct FrequencyWindow {
  double lowest = 0.0, highest = 0.0;
  double width() const { return highest - lowest; }
  double middle() const { return 0.5 * (lowest + highest); }
};

/// An excitation whose frequency depends on the rotary speed, order Omega + offset.
struct ExcitationLine {
  std::string name;
  double order = 0.0;
  double offset = 0.0;  ///< [rad/s]
  double at(double speed) const { return order * speed + offset; }
};

/// The deck list `Campbell`.
struct CampbellSettings {
  std::vector<double> speeds;  ///< [rad/s], increasing
  int modes = 0;               ///< smallest number of followed modes; not for a window, which shows
                               ///< all its modes
  std::optional<FrequencyWindow> window;
  std::optional<double> target;      ///< the modes nearest to this frequency are followed [Hz]
  std::optional<double> shapeSpeed;  ///< whose nearest speed of the diagram has its shapes written
                                     ///< [rad/s]; none: the last speed
  std::vector<ExcitationLine> lines;
  bool friction = false;
  bool stateOfEachSpeed = false;  ///< false: one static state for all
  int spotChecks = 0;             ///< speeds at which the full model is solved too
  std::string axis;               ///< of the rotation: "x", "y" or "z"
};
deck::ListSpec campbellParameters();
/// From the validated list. DeckError: speeds or frequencies do not increase, a window and a
/// target.
CampbellSettings readCampbell(const Teuchos::ParameterList& list);

/// A mode at a speed.
struct CampbellRow {
  double speed = 0.0;  ///< [rad/s]
  int mode = 0;        ///< number of the track, from 1
  std::complex<double> s;
  double mac = 1.0;    ///< with the mode at the speed before (ModeTracker)
  double whirl = 0.0;  ///< +1: all nodes whirl forward in circles, -1: backward; 0: along lines,
                       ///< not normal to the axis, or a repeated value
  double error = 0.0;  ///< estimate of |s - s_full| / |s| of a reduced model
  double frequency() const;  ///< Im s / 2 pi [Hz]
  double damping() const;    ///< -Re s / |s|

  template <class Archive>
  void serialize(Archive& archive) {
    archive(speed, mode, s, mac, whirl, error);
  }
};

/// A critical speed: Im s is the frequency of an excitation.
struct Crossing {
  std::size_t line = 0;  ///< of CampbellSettings::lines
  CampbellRow at;        ///< the mode; whirl, mac and error of the nearest speed of the diagram
  bool refined = true;   ///< false: by linear interpolation between two speeds

  template <class Archive>
  void serialize(Archive& archive) {
    archive(line, at, refined);
  }
};

/// A speed at which a mode begins or ceases to grow: Re s = 0.
struct StabilityLimit {
  CampbellRow at;       ///< the mode; whirl, mac and error of the nearest speed of the diagram
  bool begins = true;   ///< growth begins with increasing speed
  bool refined = true;  ///< false: by linear interpolation between two speeds

  template <class Archive>
  void serialize(Archive& archive) {
    archive(at, begins, refined);
  }
};

/// A speed of the diagram at which the state diverges without vibration: a computed mode has s > 0.
struct Divergence {
  double speed = 0.0;   ///< [rad/s]
  double growth = 0.0;  ///< the largest s [1/s]

  template <class Archive>
  void serialize(Archive& archive) {
    archive(speed, growth);
  }
};

/// The motion of a mode: Re(shape exp(s t)).
struct ModeShape {
  CampbellRow at;
  int line = -1;           ///< excitation of its crossing; -1: a mode of the diagram
  Eigen::VectorXcd shape;  ///< rows of the recovery; its largest displacement normal to the axis
                           ///< (or any, if there is none) has magnitude 1 and phase 0

  template <class Archive>
  void serialize(Archive& archive) {
    archive(at, line, shape);
  }
};

/// A mode of the full model and that of the reduced one.
struct SpotCheck {
  double speed = 0.0;  ///< [rad/s]
  int mode = 0;        ///< track of the reduced mode; 0: none
  std::complex<double> full, reduced;
  double error = 0.0;  ///< |s - s_full| / |s_full|
  double estimate = 0.0;
  double mac = 0.0;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(speed, mode, full, reduced, error, estimate, mac);
  }
};

/// The state at rest at a speed.
struct StateRow {
  double speed = 0.0;  ///< [rad/s]
  std::vector<cases::RestFigure> figures;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(speed, figures);
  }
};

struct CampbellDiagram {
  std::vector<CampbellRow> rows;        ///< speed by speed, by |s|
  std::vector<Crossing> crossings;      ///< by line, then speed
  std::vector<StabilityLimit> limits;   ///< by speed
  std::vector<Divergence> divergences;  ///< speed by speed
  std::vector<SpotCheck> checks;
  std::vector<ModeShape> shapes;  ///< of one speed, then of the crossings
  std::vector<StateRow> states;   ///< speed by speed; none of one state

  template <class Archive>
  void serialize(Archive& archive) {
    archive(rows, crossings, limits, divergences, checks, shapes, states);
  }
};

/// Follows the modes through the speeds of the settings (ModeTracker). A crossing is refined with
/// the equations at its own speed. ConvergenceError, ModelError of the eigensolver. Every rank
/// computes the same. The progress is stored in the folder and continued from there for the same
/// deck and program. InterruptedError after a signal. Collective.
CampbellDiagram campbell(const RotatingStates& states, const CampbellSettings& settings,
                         const cases::RowFolder& store);

/// `tooljoint campbell`: state at rest, diagram, campbell.csv, crossings.csv, spot_checks.csv,
/// states.csv, campbell.h5 with the shapes, and summary.json in `folder` ("": see
/// cases::analysisFolder). DeckError without the list Campbell. Collective.
/// \param fresh  discards results of an earlier command
void runCampbell(const cases::Case& one, const std::string& folder, bool fresh);

}  // namespace tooljoint::response
