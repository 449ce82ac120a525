// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The part of a motion over which results are evaluated.
#pragma once

#include <Teuchos_ParameterList.hpp>

#include "io/OutputParameters.hpp"

namespace tooljoint::cases {

struct FigureWindow {
  double begin = 0.0;  ///< [s]
  double end = 0.0;    ///< [s]

  /// Samples at either end belong to the window, whatever the rounding of their times.
  bool contains(double t) const {
    constexpr double rounding = 1e-9;  // of the window
    const double slack = rounding * (end - begin);
    return t >= begin - slack && t <= end + slack;
  }
};

/// The window of the deck, otherwise the second half of the motion. DeckError when it does not lie
/// in the motion, or holds no sample.
FigureWindow figureWindow(const io::FigureSettings& settings,
                          const Teuchos::ParameterList& transient);

}  // namespace tooljoint::cases
