// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Times of day in the formats of loggers.
#pragma once

#include <optional>
#include <string>

namespace tooljoint::deck {

/// Seconds of a day [s].
constexpr double dayLength = 86400.0;

struct ClockTime {
  double seconds = 0.0;  ///< since midnight; with a date since 1970-01-01 [s]
  bool dated = false;
};

/// "7:05:30", "07:05:30.25", or a time after a date and a blank or "T": "2024-03-01 07:05:30",
/// "2024/03/01T07:05:30Z" (ISO 8601; offsets from UTC are ignored). None for other texts.
std::optional<ClockTime> clockTime(const std::string& cell);

}  // namespace tooljoint::deck
