// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Data of a part for reduction methods: its partition, its stiffness, the blocks of its interior
/// and their factors, its constraint modes.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "common/Error.hpp"
#include "linalg/trilinos/DirectSolver.hpp"
#include "reduction/part/ConstraintModes.hpp"
#include "reduction/part/Partition.hpp"

namespace tooljoint::reduction {

/// An interior block and its matrices.
struct InteriorBlock {
  std::vector<int> indices;    ///< into Partition::interior
  std::vector<int> positions;  ///< dofs of the part
  std::vector<int> touched;    ///< indices into Partition::boundary
  Sparse stiffness;            ///< full, unsymmetric
  Sparse symmetricStiffness;
  Sparse mass;
  linalg::DofNamer name;
  int size() const { return sizeOf(indices); }
  /// True if it touches no boundary dof.
  bool floats() const { return touched.empty(); }
};

/// A part whose derived quantities are computed once, on first use; copies share them. The part
/// must outlive all views. Each quantity may throw the errors of checkPart on first use.
class PartView {
 public:
  PartView(const model::Substructure& part);

  /// The same part with another boundary; with `symmetric` the symmetric part of its stiffness is
  /// used.
  PartView withBoundary(std::vector<int> interface, std::vector<int> retained,
                        bool symmetric = false) const;
  /// The same part without boundary: no dof is held.
  const PartView& unsupported() const;

  const model::Substructure& part() const { return *part_; }
  const model::SecondOrderModel& model() const { return part_->model; }
  const Sparse& mass() const { return part_->model.mass; }
  std::string dofName(Eigen::Index position) const;
  /// `Part "name", what: `, the beginning of messages; without `what`, `Part "name": `.
  std::string who(const std::string& what = {}) const;
  /// Throws the error with who() in front: a ConvergenceError as such, every other failure as
  /// ModelError. An interruption is not changed.
  [[noreturn]] void fail(const std::string& what, const Error& error) const;

  const Partition& partition() const;
  /// K: constantStiffness, dofs x dofs.
  const Sparse& stiffness() const;
  const Sparse& symmetricStiffness() const;
  /// K is symmetric to rounding (1e-13).
  bool symmetric() const;

  /// K_II, sym(K)_II, M_II: interior x interior.
  const Sparse& interiorStiffness() const;
  const Sparse& symmetricInteriorStiffness() const;
  const Sparse& interiorMass() const;

  int blocks() const { return sizeOf(partition().blocks); }
  const InteriorBlock& interiorBlock(int number) const;
  /// Dofs of the part of every interior block.
  std::vector<std::vector<int>> blockPositions() const;

  /// K_II^-1 f for the columns f of `loads` (interior x columns), block by block. Inertia balances
  /// loads on floating blocks, [K  M N; N' M  0] (x, mu) = (f, 0) with the zero-energy modes N.
  /// ModelError with the dof if the interior is a mechanism although the boundary is held.
  Matrix solveInterior(const Matrix& loads) const;
  /// The same with sym(K)_II; a symmetric K_II is factored once for both.
  Matrix solveSymmetricInterior(const Matrix& loads) const;
  /// The same for one block, rows of the block x columns.
  Matrix solveBlock(int number, const Matrix& loads) const;
  /// The factors of sym(K)_II of a large (linalg::suitsMumps), held block, for use by others. Null
  /// for other blocks.
  const linalg::DirectSolver* sharedFactors(int number) const;
  /// Frees the memory of these factors; a later use computes them again.
  void releaseFactors() const;

  const ConstraintModes& constraintModes() const;

 private:
  struct Stiffness;
  struct State;
  struct Factor;
  PartView(const model::Substructure& part, std::shared_ptr<State> state);
  const Factor& factor(int number, bool symmetric) const;
  Matrix solve(const Matrix& loads, bool symmetric) const;

  const model::Substructure* part_;
  std::shared_ptr<State> state_;
};

}  // namespace tooljoint::reduction
