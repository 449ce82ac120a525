// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Where a harmonic excitation meets the modes of a case, between the points of a sweep too.
#pragma once

#include <complex>
#include <optional>
#include <vector>

#include "response/Response.hpp"
#include "response/RotatingCase.hpp"

namespace tooljoint::response {

/// A place of the sweep, a rotary speed [rad/s] or a frequency [Hz], where the frequency of the
/// excitation is that of a damped mode, s = -delta + i omega.
struct Resonance {
  double where = 0.0;
  double width = 0.0;  ///< delta, in the unit of the sweep: half the width of the resonance
  bool damped = true;  ///< otherwise `width` is a millionth of `where`, and there is no bound
};

struct Resonances {
  std::vector<Resonance> found;  ///< increasing
  std::optional<Growing> growing;
};

/// Of a sweep by frequency from the modes at its rotary speed. Of a sweep by speed from the modes
/// at some of its speeds, each followed to where Im s(Omega) = order Omega + offset.
/// ConvergenceError of the eigensolver. Every rank computes the same.
Resonances resonances(const RotatingCase& rotating, const ResponseSettings& settings);

}  // namespace tooljoint::response
