// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The index cast between the signed indices of Eigen and MPI and the containers of the standard
/// library.
#pragma once

#include <cstddef>

namespace tooljoint {

/// `i` >= 0 as an index of a standard container: v[at(i)].
constexpr std::size_t at(std::ptrdiff_t i) { return static_cast<std::size_t>(i); }

}  // namespace tooljoint
