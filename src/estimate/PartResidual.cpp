// SPDX-License-Identifier: BSD-3-Clause
#include "estimate/PartResidual.hpp"

#include <algorithm>

#include "common/Error.hpp"
#include "common/report/Log.hpp"

namespace tooljoint::estimate {

namespace {

bool ownMass(const reduction::ReducedSubstructure& part) {
  return part.basis->inertial.size() == 0 && part.basis->forces() == 0;
}

}  // namespace

bool isRitz(const coupling::Synthesis& synthesis) {
  return std::all_of(synthesis.parts.begin(), synthesis.parts.end(), ownMass);
}

bool estimable(const coupling::Synthesis& synthesis, const std::function<void()>& estimate) {
  if (!isRitz(synthesis)) return false;
  try {
    estimate();
    return true;
  } catch (const ModelError& error) {
    log::warn(error.what());
    return false;
  }
}

void requireRitz(const coupling::Synthesis& synthesis) {
  for (const auto& part : synthesis.parts)
    if (!ownMass(part))
      throw ModelError(
          "The errors of the basis \"" + part.report.basis + "\" (part \"" + part.name +
          "\") cannot be estimated: its mass or interface is approximate. Choose \"Rubin\", which "
          "has the same modes, or remove \"Error Estimate\" and tolerances.");
}

PartResidual::PartResidual(const model::Substructure& part,
                           const reduction::ReducedSubstructure& reduced, const Sparse& map,
                           const Vector& mapOffset)
    : part_(part),
      reduced_(reduced),
      constant_(reduction::constantStiffness(part.model)),
      basis_(reduced.basis->vectors * map),
      transposed_(basis_.transpose()),
      offset_(reduced.offset),
      flexibility_(part, *reduced.basis, reduction::symmetricPart(constant_)) {
  if (mapOffset.size() > 0) offset_ += reduced.basis->vectors * mapOffset;
}

PartMotion PartResidual::motion(const Vector& q, const Vector& qDot, const Vector& qDDot) const {
  return {offset_ + basis_ * q, basis_ * qDot, basis_ * qDDot};
}

Vector PartResidual::stiffnessTimes(double t, const Vector& x) const {
  Vector y = Vector::Zero(x.size());
  for (const auto& term : part_.model.stiffness) y += law(term.law, t) * (term.matrix * x);
  return y;
}

Vector PartResidual::dampingTimes(double t, const Vector& x) const {
  Vector y = Vector::Zero(x.size());
  for (const auto& term : part_.model.damping) y += law(term.law, t) * (term.matrix * x);
  return y;
}

Vector PartResidual::truncated(double t, const PartMotion& mean, const Vector& pointForce) const {
  Vector r = part_.model.mass * mean.acceleration + dampingTimes(t, mean.velocity) +
             stiffnessTimes(t, mean.displacement);
  for (const auto& load : part_.model.loads) r -= law(load.law, t) * load.vector;
  r -= pointForce;
  const auto& interior = flexibility_.interior();
  Vector inner(static_cast<Eigen::Index>(interior.size()));
  for (std::size_t i = 0; i < interior.size(); ++i)
    inner[static_cast<Eigen::Index>(i)] = r[interior[i]];
  const Vector answer = flexibility_.apply(inner);
  Vector w = Vector::Zero(r.size());
  for (std::size_t i = 0; i < interior.size(); ++i)
    w[interior[i]] = -answer[static_cast<Eigen::Index>(i)];
  return w;
}

void PartResidual::scatter(const Vector& force, Vector& coupled) const {
  coupled += transposed_ * force;
}

}  // namespace tooljoint::estimate
