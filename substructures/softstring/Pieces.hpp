// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A string in its hole, divided at every discontinuity.
#pragma once

#include <string>
#include <vector>

#include "substructures/softstring/SoftString.hpp"

namespace tooljoint::softstring {

/// Points closer than this to an end of a piece are evaluated inside the piece [m].
constexpr double inside = 1e-7;

/// A piece of the hole without discontinuities.
struct Piece {
  double top, bottom;  ///< measured depths [m]
  int stretch;
};

/// Pieces of the string below the surface, from the bit up. ModelError when the string is too
/// short.
std::vector<Piece> pieces(const std::vector<Stretch>& string, const Hole& hole, double bit);

}  // namespace tooljoint::softstring
