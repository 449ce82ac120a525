// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Loops over the coordinates of points, of a width the compiler knows where it is the usual one:
/// two translations and a rotation.
#pragma once

#include <type_traits>

namespace tooljoint::transient {

/// body(width); for three coordinates the width is a constant.
template <class Body>
void withWidth(int width, const Body& body) {
  if (width == 3)
    body(std::integral_constant<int, 3>());
  else
    body(width);
}

}  // namespace tooljoint::transient
