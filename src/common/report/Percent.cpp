// SPDX-License-Identifier: BSD-3-Clause
#include "common/report/Percent.hpp"

#include <fmt/format.h>
#include <string>

namespace tooljoint {

std::string percent(double part) {
  // rounded to two digits, then in plain notation: 150 rather than 1.5e+02
  return fmt::format("{:g} %", std::stod(fmt::format("{:.2g}", 100 * part)));
}

}  // namespace tooljoint
