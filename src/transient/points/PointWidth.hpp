// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Loops over the coordinates of points. For the usual width (two translations and a rotation) the
/// compiler knows the width.
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
