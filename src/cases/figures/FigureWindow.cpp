// SPDX-License-Identifier: BSD-3-Clause
#include "cases/figures/FigureWindow.hpp"

#include <string>

#include "common/Error.hpp"
#include "common/Text.hpp"

namespace tooljoint::cases {

FigureWindow figureWindow(const io::FigureSettings& settings,
                          const Teuchos::ParameterList& transient) {
  const double start = transient.get<double>("Start Time"), end = transient.get<double>("End Time");
  const FigureWindow window{settings.begin.value_or(0.5 * (start + end)),
                            settings.end.value_or(end)};
  const auto outside = [&](const char* name, double value) {
    throw DeckError(std::string("Output/Figures/") + name + " is " + formatNumber(value) +
                    " s, outside of the motion from " + formatNumber(start) + " to " +
                    formatNumber(end) + " s. Change it, or Transient.");
  };
  constexpr double rounding = 1e-9;  // of the motion
  const double slack = rounding * (end - start);
  if (window.begin < start - slack || window.begin > end) outside("Begin", window.begin);
  if (window.end > end + slack || window.end < start) outside("End", window.end);
  const double interval = transient.get<double>("Sampling Interval");
  if (settings.end && window.end - window.begin < interval)
    throw DeckError("Output/Figures/End is " + formatNumber(window.end) +
                    " s, less than one Transient/Sampling Interval (" + formatNumber(interval) +
                    " s) after the begin of the figures (" + formatNumber(window.begin) +
                    " s). Raise it, or lower Output/Figures/Begin.");
  return window;
}

}  // namespace tooljoint::cases
