// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A run of rows of a vector or matrix.
#pragma once

namespace tooljoint {

/// Rows begin ... end - 1.
struct RowRange {
  int begin = 0, end = 0;
};

}  // namespace tooljoint
