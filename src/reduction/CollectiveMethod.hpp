// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Reduction methods whose parts are too large for one rank.
#pragma once

#include "reduction/ReductionMethod.hpp"

namespace tooljoint::reduction {

/// All ranks share the work on each part: build() is collective, every rank gets the same basis,
/// and an error on one rank is thrown on all.
class CollectiveMethod : public ReductionMethod {};

}  // namespace tooljoint::reduction
