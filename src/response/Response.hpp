// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Harmonic responses about the state at rest: unbalance, harmonic loads, transfer functions.
#pragma once

#include <Teuchos_ParameterList.hpp>
#include <complex>
#include <optional>
#include <string>
#include <vector>

#include "cases/nodes/NodeDofs.hpp"
#include "cases/run/ResumedRows.hpp"
#include "deck/ListSpec.hpp"
#include "response/AlongString.hpp"
#include "response/LinearRange.hpp"
#include "response/RotatingCase.hpp"

namespace tooljoint::response {

enum class Excitation {
  Unbalance,  ///< loads m e Omega^2 that turn with the string
  Harmonic,   ///< all loads of the list at once
  Transfer,   ///< a unit load at each dof of the list in turn
};

/// A harmonic load or an unbalance as given in the deck.
struct ResponseLoad {
  std::string name;
  cases::NodeDof dof;
  double value = 0.0;  ///< [N], [N m]; of an unbalance m e [kg m]
  double phase = 0.0;  ///< [rad]
};

/// A dof whose response is wanted.
struct ResponseOutput {
  std::string name;
  cases::NodeDof dof;
};

/// The deck list `Response`.
struct ResponseSettings {
  Excitation excitation = Excitation::Unbalance;
  std::vector<double> speeds;       ///< of a sweep by speed [rad/s]
  double order = 1.0;               ///< excitation frequency over rotary speed in such a sweep
  double motorSpeed = 0.0;          ///< speed of the part below a motor relative to the string
                                    ///< [rad/s]
  double motorOrder = 1.0;          ///< excitation frequency over the motor's speed
  std::vector<double> frequencies;  ///< of a sweep by frequency [Hz]
  double rotarySpeed = 0.0;         ///< in such a sweep [rad/s]
  std::vector<ResponseLoad> loads;
  std::vector<ResponseLoad> unbalances;
  std::vector<ResponseOutput> outputs;
  bool friction = false;
  int spotChecks = 0;
  std::string axis;

  bool bySpeed() const { return frequencies.empty(); }
  std::size_t points() const { return bySpeed() ? speeds.size() : frequencies.size(); }
  /// Excitation frequency without rotation, of a sweep by speed [rad/s].
  double offset() const { return motorOrder * motorSpeed; }
  /// Excitation frequency at a place of the sweep, a rotary speed [rad/s] or a frequency [Hz];
  /// [rad/s].
  double omega(double where) const;
};
deck::ListSpec responseParameters();
/// From the validated list. DeckError: no or two sweeps, no output, no load, an unbalance in a
/// sweep by frequency.
ResponseSettings readResponse(const Teuchos::ParameterList& list);

/// Solution of (K - omega^2 M + i omega C) x = f.
struct ResponsePoint {
  double speed = 0.0;      ///< [rad/s]
  double frequency = 0.0;  ///< [Hz]
  Eigen::MatrixXcd x;  ///< outputs x load cases; the motion is Re(x exp(i omega t)) [m, rad], of a
                       ///< transfer function per [N] or [N m]
  Matrix estimate;     ///< of |x - x_full|; empty without an estimate
  StringResponse along;  ///< empty for transfer functions
  Departure departure;   ///< of the linear range; none for transfer functions

  template <class Archive>
  void serialize(Archive& archive) {
    archive(speed, frequency, x, estimate, along, departure);
  }
};

/// A point that is also solved with the full model.
struct ResponseCheck {
  ResponsePoint reduced, full;
};

/// A largest amplitude of one output under one load case.
struct ResponsePeak {
  int load = 0, output = 0;  ///< 0-based
  ResponsePoint at;
};

/// A growing mode: the state is unstable, so that the response about it is never reached.
struct Growing {
  double speed = 0.0;  ///< [rad/s]
  std::complex<double> s;
};

struct HarmonicResponse {
  std::vector<std::string> loads;  ///< names of the load cases
  std::vector<ResponsePoint> points;
  std::vector<ResponsePeak> peaks;       ///< all local maxima, also between the points
  std::vector<ResponseCheck> checks;     ///< spread points, and the highest peak of every output
  std::vector<AlongString::Node> nodes;  ///< of the margins along the string
  std::vector<cases::BendingPlace> elements;  ///< of the moments
  std::optional<Growing> growing;             ///< the fastest of the computed modes
  std::vector<double> undamped;  ///< resonances of modes without damping, see Resonance::where
};

/// DeckError: an unknown or held node or component, no effective load. ModelError: the dynamic
/// stiffness is singular. Points and peaks are distributed to the ranks; those stored in the folder
/// for the same deck and program are not computed again. Collective.
HarmonicResponse respond(const RotatingCase& rotating, const ResponseSettings& settings,
                         const cases::RowFolder& store);

/// `tooljoint response`: state at rest, responses, response.csv, peaks.csv, spot_checks.csv, for a
/// string also bending.csv, margins.csv and spot_checks_string.csv, response.h5 and summary.json in
/// `folder` ("": see cases::analysisFolder). DeckError without the list Response. Collective.
/// \param fresh  discards results of an earlier command
void runResponse(const cases::Case& one, const std::string& folder, bool fresh);

}  // namespace tooljoint::response
