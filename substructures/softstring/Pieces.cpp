// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/softstring/Pieces.hpp"

#include <algorithm>
#include <iterator>
#include <string>

#include "common/Error.hpp"
#include "common/Text.hpp"

namespace tooljoint::softstring {

std::vector<Piece> pieces(const std::vector<Stretch>& string, const Hole& hole, double bit) {
  std::vector<double> jumps = hole.breaks;
  std::sort(jumps.begin(), jumps.end());
  std::vector<Piece> found;
  double bottom = bit;
  for (std::size_t i = string.size(); i-- > 0 && bottom > 0.0;) {
    double top = bottom - string[i].length;
    if (top < inside) top = 0.0;
    for (double low = bottom; low > top;) {
      auto next = std::lower_bound(jumps.begin(), jumps.end(), low - inside);
      const double high = next == jumps.begin() ? top : std::max(top, *std::prev(next));
      found.push_back({high, low, static_cast<int>(i)});
      low = high;
    }
    bottom = top;
  }
  if (bottom > inside)
    throw ModelError("The string ends " + formatNumber(bottom) +
                     " m below the surface when its bit is at " + formatNumber(bit) +
                     " m. Give it more pipe, or a smaller depth of the bit.");
  return found;
}

}  // namespace tooljoint::softstring
