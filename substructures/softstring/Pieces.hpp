// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A string in its hole, cut where anything jumps.
#pragma once

#include <string>
#include <vector>

#include "substructures/softstring/SoftString.hpp"

namespace tooljoint::softstring {

/// Points nearer to an end of a piece than this are taken from inside it [m].
constexpr double inside = 1e-7;

/// A piece of the way up in which nothing jumps.
struct Piece {
  double top, bottom;  ///< measured depths [m]
  int stretch;
};

/// The string below the surface in pieces, from the bit up. ModelError when it is too short.
std::vector<Piece> pieces(const std::vector<Stretch>& string, const Hole& hole, double bit);

}  // namespace tooljoint::softstring
