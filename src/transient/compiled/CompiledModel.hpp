// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A SecondOrderModel in the form used by the time loop: dofs gathered into dense blocks, terms
/// with the same law merged (TimedTerms), points in batches (PointBatch) with their states
/// (ModelStates). Built once; nothing allocates afterwards.
///
/// Vectors are raw arrays in *positions* (dofs renumbered block by block); toPositions() and
/// toDofs() convert.
///
/// The model may be one rank's share of a motion divided among ranks (RankShare). Products, point
/// forces and loads are then partial at the cut; states are the same on all ranks that hold them;
/// sums, maxima and norms are those of the whole model (linalg::RankCut).
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "common/Types.hpp"
#include "linalg/blocks/BlockSparse.hpp"
#include "model/SecondOrderModel.hpp"
#include "transient/compiled/TimedTerms.hpp"
#include "transient/points/ModelStates.hpp"
#include "transient/points/PointBatch.hpp"
#include "transient/ranks/RankShare.hpp"

namespace tooljoint::transient {

class CompiledModel {
 public:
  /// Throws ModelError if the model is inconsistent.
  explicit CompiledModel(const model::SecondOrderModel& model);
  /// The model of one rank; the share must outlive it. Collective.
  explicit CompiledModel(const RankShare& share);
  CompiledModel(const CompiledModel&) = delete;
  CompiledModel& operator=(const CompiledModel&) = delete;

  int size() const { return pattern_.size(); }
  const model::SecondOrderModel& source() const { return model_; }
  const linalg::BlockPattern& pattern() const { return pattern_; }

  /// Conversion from and to dofs of the model of all ranks; toDofs() is collective.
  void toPositions(const Vector& dofs, Vector& positions) const;
  void toDofs(const Vector& positions, Vector& dofs) const;
  /// "theta_z of node 17".
  std::string dofName(int position) const;
  /// Name of the dof where x is largest or not a number; x must agree on all ranks that share it.
  /// Collective.
  std::string worstName(const Vector& x) const;
  /// Name for the result of BlockFactor::factor(). Collective.
  std::string pivotName(int position) const;

  const linalg::RankCut& cut() const { return pattern_.cut(); }
  /// Positions of the model of all ranks.
  int wholeSize() const { return wholeSize_; }
  /// x'y of an x that agrees on all ranks and a partial y; max |x_i|. Collective.
  double dot(const Vector& x, const Vector& partial) const;
  double largest(const Vector& x) const;
  /// sum x_i^2. Collective.
  double squaredNorm(const Vector& x) const;
  /// Number of a position in the model of all ranks.
  int numberInWhole(int position) const {
    return share_ != nullptr ? share_->numbers()[static_cast<std::size_t>(position)] : position;
  }

  /// C(t), K(t) and F(t), used by the products below.
  const TimedTerms& timed() const { return timed_; }
  TimedTerms& timed() { return timed_; }
  /// TimedTerms::setTime().
  void setTime(double t) { timed_.setTime(t); }

  /// y += M x, y += C(t) x, y += K(t) x.
  void addMass(const double* x, double* y) const { addMass(x, y, all()); }
  void addDamping(const double* x, double* y) const { addDamping(x, y, all()); }
  void addStiffness(const double* x, double* y) const { addStiffness(x, y, all()); }
  /// x' M x. Collective.
  double massForm(const double* x) const { return cut().sum(ownMassForm(x)); }
  /// Contribution of this rank to x' M x.
  double ownMassForm(const double* x) const { return massProduct_.form(mass_.data(), x); }
  /// The same for the rows of some blocks, with a factor of M.
  void addMass(const double* x, double* y, linalg::BlockRange rows, double factor = 1.0) const {
    massProduct_.addTo(mass_.data(), x, y, factor, rows);
  }
  void addDamping(const double* x, double* y, linalg::BlockRange rows) const {
    timed_.damping().addTo(x, y, rows);
  }
  void addStiffness(const double* x, double* y, linalg::BlockRange rows) const {
    timed_.stiffness().addTo(x, y, rows);
  }
  /// All blocks, in runs whose vectors fit into a near cache: work run by run reads long vectors
  /// only once.
  const std::vector<linalg::BlockRange>& runs() const { return runs_; }

  /// values = m M + c C(t) + k K(t) on the pattern (storage() doubles).
  void combine(double m, double c, double k, double* values) const;
  /// Diagonal of the same sum. Collective.
  void diagonal(double m, double c, double k, double* out) const;

  /// Separate batches for evaluating points apart from the motion.
  std::vector<PointBatch> makePoints() const;
  std::vector<PointBatch>& points() { return points_; }
  const std::vector<PointBatch>& points() const { return points_; }
  /// PointBatch::addMissed() of all batches; true if any rank has such points. Collective.
  bool addMissed(const double* q, double t = std::numeric_limits<double>::quiet_NaN());
  /// PointBatch::meetsOrLeavesWall() of any batch on any rank. Collective.
  bool meetsOrLeavesWall(const double* q);

  /// States of the laws of all points.
  const ModelStates& states() const { return states_; }
  ModelStates& states() { return states_; }

  /// Adds the sum of R' f over all batches to y, evaluated at the active points of state (q, v).
  void addPointForces(double t, const double* q, const double* v, double* y);

 private:
  CompiledModel(const model::SecondOrderModel& model, const RankShare* share);
  Vector inOrder(const Vector& dofs) const;
  linalg::BlockRange all() const { return {0, pattern_.blocks()}; }

  const model::SecondOrderModel& model_;
  const RankShare* share_ = nullptr;  ///< null: the whole model
  int wholeSize_ = 0;
  linalg::BlockPattern pattern_;
  std::vector<linalg::BlockRange> runs_;
  linalg::BlockValues mass_;
  linalg::BlockProduct massProduct_;
  std::vector<std::size_t> diagonalAddress_;
  TimedTerms timed_;
  std::vector<PointBatch> points_;
  ModelStates states_;
};

}  // namespace tooljoint::transient
