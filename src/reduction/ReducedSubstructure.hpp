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

/// Interface of a reduced part whose displacements are not among its coordinates: u_b = rows q +
/// offset.
struct DerivedInterface {
  std::vector<model::DofLabel> dofs;  ///< joined dofs, labels of the part
  Sparse rows;                        ///< dofs x coordinates
  Vector offset;                      ///< u_b at q = 0: the static state, or zero
  /// Number of trailing coordinates that are the forces g of the rest of the model on `dofs`, one
  /// for each; 0: none. They need dual assembly, which replaces them by its multipliers, g = C'
  /// lambda, after K and M were projected on all coordinates (D. J. Rixen 2004).
  int forces = 0;
  Vector staticForces;  ///< with `forces`: forces in the static state, from which the coordinates
                        ///< are measured; part of the loads
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
      basis;  ///< shared by all identical parts; its rows are in the report
  BasisReport report;
  std::optional<DerivedInterface>
      derivedInterface;  ///< only if the basis does not have the interface dofs as coordinates;
                         ///< `interface` is then 0

  int size() const { return model.size(); }
  /// report.rows with the names of the dofs of this part; the report has those of the first of the
  /// identical parts.
  std::vector<BasisRow> basisRows() const;
};

}  // namespace tooljoint::reduction
