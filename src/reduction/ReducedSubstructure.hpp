// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A part after reduction.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "model/SecondOrderModel.hpp"
#include "reduction/ReductionMethod.hpp"

namespace tooljoint::reduction {

/// Interface of a reduced part whose displacement is not among its coordinates: u_b = rows q +
/// offset.
struct DerivedInterface {
  std::vector<model::DofLabel> dofs;  ///< what is joined, labels of the part
  Sparse rows;                        ///< dofs x coordinates
  Vector offset;                      ///< u_b at q = 0: the static state, or zero
  /// The last so many coordinates are the forces g that the rest of the model exerts on `dofs`, one
  /// for each; 0: there are none. They need dual assembly, which puts its multipliers in their
  /// place, g = C' lambda, after K and M were projected on all coordinates (D. J. Rixen 2004).
  int forces = 0;
  Vector staticForces;  ///< with `forces`: those of the static state, about which the coordinates
                        ///< count; the loads of the part have them
};

/// A reduced part: a small SecondOrderModel in q = (interface, retained, modes), with D = offset +
/// Phi q.
struct ReducedSubstructure {
  std::string name;
  model::SecondOrderModel
      model;  ///< labels: Physical for interface and retained dofs, Modal (entity = part) for modes
  int interface = 0;  ///< the first `interface` coordinates may be joined with other parts
  int retained = 0;   ///< the next `retained` ones are physical dofs of this part alone
  int modes = 0;      ///< the last `modes` ones are modal
  Vector offset;      ///< D at q = 0, dofs of the part: the static state, or zero
  std::shared_ptr<const Basis>
      basis;  ///< one for all identical parts; its rows stand in the report
  BasisReport report;
  std::optional<DerivedInterface>
      derivedInterface;  ///< only where the basis does not have the interface dofs as coordinates;
                         ///< then `interface` is 0

  int size() const { return model.size(); }
  /// report.rows with the names of the dofs of this part: those of the report are of the first of
  /// identical parts.
  std::vector<BasisRow> basisRows() const;
};

}  // namespace tooljoint::reduction
