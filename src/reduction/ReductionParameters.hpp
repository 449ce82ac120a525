// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The deck list "Reduction".
#pragma once

#include "deck/ListSpec.hpp"

namespace tooljoint::reduction {

/// Description of the list "Reduction", with a sublist for every registered basis with parameters.
deck::ListSpec parameters();

}  // namespace tooljoint::reduction
