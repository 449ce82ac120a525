// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The blocks of a SecondOrderModel: which dofs stand together, and which blocks its matrices and
/// the tangents of its points couple.
#pragma once

#include "linalg/blocks/BlockSparse.hpp"
#include "model/SecondOrderModel.hpp"

namespace tooljoint::transient {

linalg::BlockPattern modelPattern(const model::SecondOrderModel& model);
/// The same with given blocks.
linalg::BlockPattern modelPattern(const model::SecondOrderModel& model,
                                  const linalg::BlockPartition& partition);

}  // namespace tooljoint::transient
