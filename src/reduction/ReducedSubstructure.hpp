// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A part after reduction.
#pragma once

#include <string>
#include <vector>

#include "model/SecondOrderModel.hpp"
#include "reduction/Basis.hpp"

namespace tooljoint::reduction {

/// A reduced part: a small SecondOrderModel in q = (interface, retained, modes), with D = offset + Phi q.
struct ReducedSubstructure {
  std::string name;
  model::SecondOrderModel model;  ///< labels: Physical for interface and retained dofs, Modal (entity = part) for modes
  int interface = 0;              ///< the first `interface` coordinates may be joined with other parts
  int retained = 0;               ///< the next `retained` ones are physical dofs of this part alone
  int modes = 0;                  ///< the last `modes` ones are modal
  Vector offset;                  ///< D at q = 0, dofs of the part: the static state, or zero
  BasisResult basis;              ///< its rows stand in the report
  BasisReport report;

  int size() const { return model.size(); }
};

}  // namespace tooljoint::reduction
