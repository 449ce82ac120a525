// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Joins parts into one model by equal labels of their interface dofs and by constraints, whatever
/// the source of the parts. Any graph of parts (chain, branch, loop) can be coupled.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "coupling/input/Connections.hpp"
#include "model/Substructure.hpp"
#include "reduction/ReducedSubstructure.hpp"

namespace tooljoint::coupling {

/// A force that joins parts (dual assembly), in two coordinates of the coupled model.
struct Multiplier {
  int first = 0;
  int second = 0;
  std::string part;     ///< the part it acts on
  model::DofLabel dof;  ///< the dof of that part it acts on, in the common frame
  double scale = 1;
  /// Force [N, N m] of the rest of the model on that dof, for coordinates z.
  double force(const Vector& z) const { return scale * (z[first] + z[second]); }
};

/// A coupled model and the relation of its coordinates to those of the parts: q_p = maps[p] z +
/// offsets[p].
struct Coupling {
  model::SecondOrderModel model;
  std::vector<std::vector<int>> positions;  ///< positions[p][i]: dof of the coupled model that is
                                            ///< coordinate i of part p; -1 if it is not a single
                                            ///< dof
  std::vector<Sparse> maps;           ///< coordinates of part p (in its own frames) x coupled dofs
  std::vector<Vector> offsets;        ///< zero unless a constraint has a value
  std::vector<Sparse> recoveryTurns;  ///< recovery rows of part p in the common frame =
                                      ///< recoveryTurns[p] * its own; empty: the same
  std::vector<Multiplier> multipliers;  ///< dual assembly
  std::vector<std::string> remarks;     ///< redundant constraints, for example
  std::vector<int> interface;  ///< coupled dofs that join parts: joined physical ones, or the modes
                               ///< that replace them, increasing
  int joinedDofs =
      0;  ///< number of `interface` dofs, or of those that an interface reduction replaced
  int dependent = 0;        ///< coordinates that depend on others
  int interfaceModes = -1;  ///< modes of the interfaces; -1: no interface reduction
  std::shared_ptr<const Coupling> wholeInterfaces;  ///< before the interface reduction; null
                                                    ///< without one
  Sparse interfaceMap;  ///< coordinates of wholeInterfaces = interfaceMap * coordinates of this
                        ///< model

  /// Coordinates of part p for the columns z of the coupled model (motions, so without the offset).
  Matrix local(int p, const Matrix& z) const { return maps[static_cast<std::size_t>(p)] * z; }
  /// True if every coordinate of every part is one coupled dof: `positions` is then complete.
  bool boolean() const;
};

/// M, C_i, K_i and loads of all parts in z: A' = sum_p L_p' A_p L_p. Terms of one name and one law
/// become one term, laws are merged by name, and every part keeps its own point sets. The recovery
/// row of a shared node is that of the first part that has the component. Dofs are numbered by a
/// Cuthill-McKee walk over nodes and modes, so the bandwidth of a chain is small.
///
/// Primal: L = null space of the constraints by sparse elimination, interface dofs first; with
/// equal labels only, L_p is Boolean. Dual (C. Farhat and F.-X. Roux 1991; D. J. Rixen 2004): with
/// constraints B q = g, the stationary point of the Lagrangian with multipliers, which are forces
/// on the dof that each constraint is solved for. Each multiplier is split in two (as in
/// Code_Aster, R3.03.01), so that every row has a diagonal entry:
///
///     [M . .; . . .; . . .] z'' + [C . .; . . .; . . .] z'
///         + [K -B' -B'; -B -S S; -B S -S] z = [F; -g; -g],   z = (q, lambda_1, lambda_2)
///
/// This means B q = g and lambda_1 = lambda_2, each half of the force; S is its stiffness at that
/// dof. Multipliers have the node number of that dof, so that block solvers keep them together. The
/// start contains consistent multipliers. Parts with reduction::DerivedInterface have interface
/// displacements that are not coordinates, u_b = B_p q_p; if their coordinates contain interface
/// forces (dual Craig-Bampton), these become the multipliers.
///
/// Throws ModelError, naming parts and dofs: labels that join nothing, occur twice in a part or
/// belong to an inner dof of another part; different component names; reference or initial states
/// that differ at a shared dof by more than 1e-9 of the largest; inconsistent recovery rows of a
/// node; a connection with an unknown part, node or component, or with an inner dof of a reduced
/// part; contradictory constraints; a translation tied to a rotation; a frame that is not a
/// rotation.
Coupling coupleWithPositions(const std::vector<reduction::ReducedSubstructure>& parts,
                             const CouplingOptions& options = {});
Coupling coupleWithPositions(const std::vector<model::Substructure>& parts,
                             const CouplingOptions& options = {});

model::SecondOrderModel couple(const std::vector<reduction::ReducedSubstructure>& parts,
                               const CouplingOptions& options = {});
/// Couples unreduced parts: restores the full model.
model::SecondOrderModel couple(const std::vector<model::Substructure>& parts,
                               const CouplingOptions& options = {});

/// max |i - j| over the entries of mass, damping and stiffness.
int halfBandwidth(const model::SecondOrderModel& model);

}  // namespace tooljoint::coupling
