// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/project/ReducedModels.hpp"

#include <cmath>
#include <cstring>
#include <utility>

#include "linalg/blocks/BlockKernels.hpp"
#include "reduction/project/FullBasis.hpp"
#include "reduction/project/Projection.hpp"
#include "reduction/vectors/InitialState.hpp"

namespace tooljoint::reduction {

namespace {

/// Equal bit by bit.
bool same(const model::SharedSparse& a, const model::SharedSparse& b) {
  if (a.sharesWith(b)) return true;
  return a.rows() == b.rows() && a.cols() == b.cols() && a.nonZeros() == b.nonZeros() &&
         std::equal(a.outerIndexPtr(), a.outerIndexPtr() + a.rows() + 1, b.outerIndexPtr()) &&
         std::equal(a.innerIndexPtr(), a.innerIndexPtr() + a.nonZeros(), b.innerIndexPtr()) &&
         (a.nonZeros() == 0 ||
          std::memcmp(a.valuePtr(), b.valuePtr(),
                      sizeof(double) * static_cast<std::size_t>(a.nonZeros())) == 0);
}

std::string nameOfReaction(const model::SecondOrderModel& model, const model::MatrixTerm& term) {
  const bool constant = model.laws[at(term.law)].isOne();
  return constant ? "reference state" : "reference state: " + term.name;
}

}  // namespace

double energyOf(const model::SecondOrderModel& model, const Vector& x, const Vector& v) {
  double strain = 0.0, kinetic = 0.0;
  if (!x.isZero(0.0)) strain = x.dot(Vector(model.stiffnessAt(0.0) * x));
  if (!v.isZero(0.0)) kinetic = v.dot(Vector(model.mass * v));
  return 0.5 * (kinetic + std::abs(strain));
}

LinearMap::LinearMap(Sparse A) {
  if (static_cast<double>(A.nonZeros()) > 0.1 * static_cast<double>(A.size()))
    dense_ = A;
  else
    sparse_.swap(A);
}

TOOLJOINT_CLONES Vector LinearMap::operator()(const Vector& x) const {
  if (dense_.size() == 0) return sparse_ * x;
  Vector y = Vector::Zero(dense_.rows());
  linalg::kernel::multiplyAdd(static_cast<int>(dense_.rows()), static_cast<int>(dense_.cols()),
                              dense_.data(), x.data(), y.data());
  return y;
}

LinearMap LinearMap::times(const Sparse& B) const {
  LinearMap product;
  if (dense_.size() > 0)
    product.dense_ = dense_ * B;
  else
    product.sparse_ = sparse_ * B;
  return product;
}

ReducedModels::ReducedModels(const model::Substructure& like,
                             std::shared_ptr<const ReducedCore> core,
                             const ReductionOptions& options)
    : like_(like),
      core_(std::move(core)),
      keepStatic_(options.initialState == InitialState::KeepStatic) {}

const LinearMap& ReducedModels::transposedBasis() {
  if (!project_) project_.emplace(core_->basis.vectors.transpose());
  return *project_;
}

Vector ReducedModels::projected(const Vector& load) {
  const Sparse& Phi = core_->basis.vectors;
  return isLargeAndFull(Phi) ? Vector(Phi.transpose() * load) : transposedBasis()(load);
}

const std::vector<ReducedModels::Reaction>& ReducedModels::reactions() {
  if (reactions_.empty())
    for (const auto& term : stiffnessTerms(like_.model))
      reactions_.push_back(
          {nameOfReaction(like_.model, term), transposedBasis().times(-term.matrix), term.law});
  return reactions_;
}

void ReducedModels::addLoads(const model::Substructure& part, const Vector& offset,
                             model::SecondOrderModel& reduced) {
  const bool atRest = offset.isZero(0.0);
  for (const auto& load : part.model.loads)
    reduced.loads.push_back({load.name, projected(load.vector), load.law});
  if (atRest) return;
  // K (D_s + Phi q) = ... : -K_i D_s is added to the loads, with the law of K_i.
  const auto add = [&](const std::string& name, Vector force, int law) {
    if (!force.isZero(0.0)) reduced.loads.push_back({name, std::move(force), law});
  };
  if (isLargeAndFull(core_->basis.vectors)) {
    for (const auto& term : stiffnessTerms(like_.model))
      add(nameOfReaction(like_.model, term), projected(-(term.matrix * offset)), term.law);
    return;
  }
  for (const auto& reaction : reactions()) add(reaction.name, reaction.force(offset), reaction.law);
}

void ReducedModels::addPoints(const model::Substructure& part, const Vector& offset,
                              model::SecondOrderModel& reduced) {
  const Sparse& Phi = core_->basis.vectors;
  for (const auto& set : part.model.points) {
    model::PointSet points = set;
    points.rows = set.rows * Phi;
    points.offset = set.offset + set.rows * offset;
    reduced.points.push_back(points);
  }
  reduced.recoveryNodes = part.model.recoveryNodes;
  if (part.model.recoveryNodes.empty()) return;
  if (recovery_.size() == 0) recovery_ = like_.model.recovery * Phi;
  if (same(part.model.recovery, like_.model.recovery))
    reduced.recovery = recovery_;
  else
    reduced.recovery = part.model.recovery * Phi;
  reduced.recoveryOffset = part.model.recoveryOffset;
  reduced.recoveryOffset.noalias() += part.model.recovery * offset;
}

/// For a basis whose last coordinates are the forces on the interface dofs.
DerivedInterface ReducedModels::forcesAsCoordinates(const model::Substructure& part,
                                                    const Vector& offset) const {
  const Basis& basis = core_->basis;
  DerivedInterface interface;
  interface.rows = block(basis.vectors, basis.forceDofs, range(basis.vectors.cols()));
  interface.offset = offset(basis.forceDofs);
  for (int i : basis.forceDofs) interface.dofs.push_back(part.model.dofs[at(i)]);
  interface.forces = basis.forces();
  return interface;
}

void ReducedModels::make(const model::Substructure& part, int index, ReducedSubstructure& out) {
  const ReducedCore& core = *core_;
  out.name = part.name;
  out.basis = std::shared_ptr<const Basis>(core_, &core.basis);
  out.report = core.report;
  const Partition& p = core.basis.partition;
  const Sparse& Phi = core.basis.vectors;
  out.interface = sizeOf(p.interface);
  out.retained = sizeOf(p.retained);
  out.modes = core.basis.modes();

  model::SecondOrderModel& m = out.model;
  m.componentNames = part.model.componentNames;
  m.nodeName = part.model.nodeName;
  m.laws = part.model.laws;
  m.dofs.reserve(p.boundary.size() + static_cast<std::size_t>(out.modes));
  for (int position : p.boundary) m.dofs.push_back(part.model.dofs[at(position)]);
  for (int k = 0; k < out.modes + core.basis.forces(); ++k)
    m.dofs.push_back(model::DofLabel::modal(index, k));
  m.mass = core.matrices.mass;
  m.damping = core.matrices.damping;
  m.stiffness = core.matrices.stiffness;

  StartState start = startState(part, core.basis, keepStatic_);
  out.offset = std::move(start.offset);
  addLoads(part, out.offset, m);
  addPoints(part, out.offset, m);
  m.initialDisplacement = std::move(start.displacement);
  m.initialVelocity = std::move(start.velocity);
  if (core.basis.forces() > 0) {
    out.derivedInterface = forcesAsCoordinates(part, out.offset);
    out.derivedInterface->staticForces = start.forces;
    if (!start.forces.isZero(0.0))
      m.loads.push_back({"reference state: forces between parts",
                         Vector(out.derivedInterface->rows.transpose() * start.forces),
                         m.lawIndex(model::ScalarLaw::one())});
  }

  out.report.part = part.name;
  if (core.report.part != part.name) out.report.sharedWith = core.report.part;
  const Vector moved = part.model.initialDisplacement - out.offset;
  out.report.startEnergy = energyOf(part.model, moved, part.model.initialVelocity);
  if (out.report.startEnergy > 0.0)
    out.report.startMisfit = energyOf(part.model, moved - Phi * m.initialDisplacement,
                                      part.model.initialVelocity - Phi * m.initialVelocity);
  if (&part == &like_) m.validate();
}

}  // namespace tooljoint::reduction
