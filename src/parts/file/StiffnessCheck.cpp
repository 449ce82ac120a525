// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "common/Text.hpp"
#include "common/report/Log.hpp"
#include "parts/file/PartFile.hpp"

namespace tooljoint::parts {

namespace {

/// Smallest number of one-sided entries that causes a warning: fewer may be a force that depends on
/// one dof.
constexpr int fewest = 2;

/// Number of entries on either side of the diagonal.
struct Sides {
  int below = 0, above = 0;
};

Sides sidesOf(const Sparse& matrix) {
  Sides sides;
  for (int i = 0; i < matrix.rows(); ++i)
    for (Sparse::InnerIterator it(matrix, i); it; ++it)
      if (it.value() != 0.0 && it.col() != i) ++(it.col() < i ? sides.below : sides.above);
  return sides;
}

}  // namespace

void checkStiffness(const PartContent& content) {
  for (const auto& term : content.part.model.stiffness) {
    const Sides sides = sidesOf(term.matrix);
    if (std::min(sides.below, sides.above) > 0 || std::max(sides.below, sides.above) < fewest)
      continue;
    log::warn("Part \"" + content.part.name + "\" (" + content.file + "): the stiffness " +
              inQuotes(term.name) + " has entries " + (sides.below > 0 ? "below" : "above") +
              " its diagonal alone and is taken as it stands, not symmetric. If it is one triangle "
              "of a symmetric matrix, write both, or a symmetric Matrix Market file.");
  }
}

}  // namespace tooljoint::parts
