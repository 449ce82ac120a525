// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Block pattern of a SecondOrderModel: its partition of dofs into blocks, and the couplings of
/// blocks by matrices and tangents of points.
#pragma once

#include "linalg/blocks/BlockSparse.hpp"
#include "model/SecondOrderModel.hpp"

namespace tooljoint::transient {

linalg::BlockPattern modelPattern(const model::SecondOrderModel& model);
/// The same with given blocks.
linalg::BlockPattern modelPattern(const model::SecondOrderModel& model,
                                  const linalg::BlockPartition& partition);

}  // namespace tooljoint::transient
