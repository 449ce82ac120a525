// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Whether a checkpoint belongs to this model and these steps.
#pragma once

#include <string>
#include <vector>

#include "model/SecondOrderModel.hpp"
#include "transient/TransientParameters.hpp"

namespace tooljoint::transient {

/// Identity of everything a motion depends on: dofs, matrices, loads, laws of time (at 33 times of
/// the window), point laws (forces at the start and beyond the clearance in each direction),
/// initial state, and the options. Progress is excluded, and the checkpoint interval if the
/// integrator can continue from any state.
struct ModelIdentity {
  std::string digest;  ///< SHA-256, 64 hexadecimal digits
  /// The same as numbers: sum |a_i| and a weighted sum for each matrix, vector and law. A static
  /// state computed by another number of ranks changes them in the last digits.
  std::vector<double> figures;
};

ModelIdentity identityOf(const model::SecondOrderModel& model, const TransientOptions& options);

/// Whether two lists of figures agree up to rounding.
bool agree(const std::vector<double>& figures, const std::vector<double>& others);

}  // namespace tooljoint::transient
