// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Numbers in messages.
#pragma once

#include <cstdio>
#include <string>

namespace tooljoint::linalg {

/// Two digits, "3.2e-11".
inline std::string scientific(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1e", value);
  return text;
}

}  // namespace tooljoint::linalg
