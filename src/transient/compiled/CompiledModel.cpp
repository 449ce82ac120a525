// SPDX-License-Identifier: BSD-3-Clause
#include "transient/compiled/CompiledModel.hpp"

#include <cmath>

#include "common/Index.hpp"
#include "model/DofNames.hpp"
#include "transient/Integrator.hpp"
#include "transient/compiled/ModelPattern.hpp"

namespace tooljoint::transient {
namespace {

/// Ten vectors of this length (160 kB) fit into a second-level cache, and matrices are still read
/// in long runs.
constexpr int positionsPerRun = 2048;

}  // namespace

CompiledModel::CompiledModel(const model::SecondOrderModel& model)
    : CompiledModel(model, nullptr) {}

CompiledModel::CompiledModel(const RankShare& share) : CompiledModel(share.model(), &share) {}

CompiledModel::CompiledModel(const model::SecondOrderModel& model, const RankShare* share)
    : model_(model), share_(share) {
  model.validate();
  const int n = model.size();
  pattern_ = share != nullptr ? share->pattern() : modelPattern(model);
  wholeSize_ = share != nullptr ? share->wholeSize() : n;
  runs_ = linalg::blockRuns(pattern_, positionsPerRun);

  mass_.assign(pattern_.storage(), 0.0);
  pattern_.add(model.mass, 1.0, mass_);
  massProduct_ = linalg::BlockProduct(pattern_, {&mass_});
  diagonalAddress_.resize(at(n));
  for (int p = 0; p < n; ++p) diagonalAddress_[at(p)] = pattern_.address(p, p);

  timed_ = TimedTerms(model, pattern_, massProduct_);
  points_ = makePoints();
  states_ = ModelStates(points_, cut());
}

std::vector<PointBatch> CompiledModel::makePoints() const {
  std::vector<PointBatch> batches;
  for (std::size_t s = 0; s < model_.points.size(); ++s)
    batches.emplace_back(model_.points[s], pattern_,
                         share_ != nullptr ? &share_->points()[s] : nullptr);
  return batches;
}

bool CompiledModel::addMissed(const double* q, double t) {
  bool missed = false;
  for (auto& batch : points_) missed = batch.addMissed(q, t) || missed;
  return cut().any(missed);
}

bool CompiledModel::meetsOrLeavesWall(const double* q) {
  bool any = false;
  for (auto& batch : points_) any = batch.meetsOrLeavesWall(q) || any;
  return cut().any(any);
}

void CompiledModel::toPositions(const Vector& dofs, Vector& positions) const {
  positions = share_ != nullptr ? share_->pick(dofs) : inOrder(dofs);
}

/// Own dofs, sorted by position.
Vector CompiledModel::inOrder(const Vector& dofs) const {
  Vector positions(size());
  for (int p = 0; p < size(); ++p) positions[p] = dofs[pattern_.partition().dof[at(p)]];
  return positions;
}

void CompiledModel::toDofs(const Vector& positions, Vector& dofs) const {
  if (share_ != nullptr) return share_->gather(positions, dofs);
  dofs.resize(positions.size());
  for (int p = 0; p < size(); ++p) dofs[pattern_.partition().dof[at(p)]] = positions[p];
}

std::string CompiledModel::dofName(int position) const {
  return model::dofName(model_, pattern_.partition().dof[at(position)]);
}

std::string CompiledModel::worstName(const Vector& x) const {
  const int worst = worstPosition(x);
  return pattern_.cut().ofLargest(std::abs(x[worst]), dofName(worst));
}

std::string CompiledModel::pivotName(int position) const {
  const bool mine = position >= 0 && position < size();
  return pattern_.cut().ofLargest(mine ? 1.0 : 0.0, mine ? dofName(position) : "");
}

double CompiledModel::dot(const Vector& x, const Vector& partial) const {
  return pattern_.cut().sum(x.dot(partial));
}

double CompiledModel::squaredNorm(const Vector& x) const {
  const int interior = cut().interior(size());
  double sum = x.head(interior).squaredNorm();
  for (int i = interior; i < size(); ++i) sum += cut().owns(i) ? x[i] * x[i] : 0.0;
  return cut().sum(sum);
}

double CompiledModel::largest(const Vector& x) const {
  return pattern_.cut().largest(x.cwiseAbs().maxCoeff());
}

void CompiledModel::combine(double m, double c, double k, double* values) const {
  const std::size_t n = pattern_.storage();
  for (std::size_t i = 0; i < n; ++i) values[i] = m * mass_[i];
  if (c != 0.0) timed_.damping().combine(c, values, n);
  if (k != 0.0) timed_.stiffness().combine(k, values, n);
}

void CompiledModel::diagonal(double m, double c, double k, double* out) const {
  for (std::size_t p = 0; p < diagonalAddress_.size(); ++p) {
    const std::size_t a = diagonalAddress_[p];
    out[p] = m * mass_[a] + c * timed_.damping().entry(a) + k * timed_.stiffness().entry(a);
  }
  pattern_.cut().complete(out);
}

void CompiledModel::addPointForces(double t, const double* q, const double* v, double* y) {
  for (auto& batch : points_) {
    batch.evaluate(t, q, v);
    batch.addForce(y);
  }
}

}  // namespace tooljoint::transient
