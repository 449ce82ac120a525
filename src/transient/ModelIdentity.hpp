// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Is this the model, and are these the steps, that a checkpoint came from?
#pragma once

#include <string>
#include <vector>

#include "model/SecondOrderModel.hpp"
#include "transient/TransientParameters.hpp"

namespace tooljoint::transient {

/// Of everything a motion depends on: dofs, matrices, loads, laws of time (at 33 times of the
/// window), point laws (their forces at the start and beyond their clearance in each direction),
/// initial state, and the options but for progress and, where the integrator can go on from
/// anywhere, the checkpoint interval.
struct ModelIdentity {
  std::string digest;  ///< SHA-256, 64 hexadecimal digits
  /// The same in numbers: of each matrix, vector and law sum |a_i| and a weighted sum. A static
  /// state that another number of ranks has found changes them in the last digits.
  std::vector<double> figures;
};

ModelIdentity identityOf(const model::SecondOrderModel& model, const TransientOptions& options);

/// Whether two lists of figures are of one model but for rounding.
bool agree(const std::vector<double>& figures, const std::vector<double>& others);

}  // namespace tooljoint::transient
