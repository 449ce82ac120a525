// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Resonances of a harmonic excitation with the modes of a case, also between the points of a
/// sweep.
#pragma once

#include <complex>
#include <optional>
#include <vector>

#include "response/Response.hpp"
#include "response/RotatingCase.hpp"

namespace tooljoint::response {

/// A position in the sweep, a rotary speed [rad/s] or a frequency [Hz], at which the excitation
/// frequency equals that of a damped mode, s = -delta + i omega.
struct Resonance {
  double where = 0.0;
  double width = 0.0;  ///< delta, in the unit of the sweep: half the width of the resonance
  bool damped = true;  ///< false: `width` is a millionth of `where`, and the peak is unbounded
};

struct Resonances {
  std::vector<Resonance> found;  ///< increasing
  std::optional<Growing> growing;
};

/// For a sweep by frequency from the modes at its rotary speed. For a sweep by speed from the modes
/// at some of its speeds, each followed to the speed with Im s(Omega) = order Omega + offset.
/// ConvergenceError of the eigensolver. Every rank computes the same.
Resonances resonances(const RotatingCase& rotating, const ResponseSettings& settings);

}  // namespace tooljoint::response
