// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/vectors/InitialState.hpp"

#include "linalg/DenseDecompositions.hpp"
#include "reduction/vectors/ModalVectors.hpp"

namespace tooljoint::reduction {

Vector fitState(const Basis& basis, const Vector& x) {
  const auto& boundary = basis.partition.boundary;
  Vector q = Vector::Zero(basis.vectors.cols());
  if (x.isZero(0.0)) return q;
  q.head(sizeOf(boundary)) = x(boundary);
  const int modes = basis.modes();
  if (modes == 0 || basis.partition.interior.empty()) return q;
  const Vector rest = x - basis.vectors * q;  // x_I - phi_C x_C on the interior
  const Vector target = rest(basis.partition.interior);
  if (target.isZero(0.0)) return q;
  q.segment(sizeOf(boundary), modes) = linalg::leastSquares(Matrix(modalColumns(basis)), target);
  return q;
}

Vector fitState(const Basis& basis, const Sparse& mass, const Vector& x) {
  Vector q = fitState(basis, x);
  const int first = sizeOf(basis.partition.boundary), modes = basis.modes();
  const Vector rest = x - basis.vectors * q;
  if (modes == 0 || rest.isZero(0.0)) return q;
  const Sparse phi = basis.vectors.middleCols(first, modes), weighted = mass * phi;
  q.segment(first, modes) +=
      linalg::leastSquares(Matrix(phi.transpose() * weighted), Vector(weighted.transpose() * rest));
  return q;
}

StartState startState(const model::Substructure& part, const Basis& basis, bool keepStatic) {
  const auto& m = part.model;
  StartState start;
  start.velocity = fitState(basis, m.mass, m.initialVelocity);
  start.offset =
      keepStatic && part.reference.size() > 0 ? part.reference : Vector(Vector::Zero(m.size()));
  const Vector& reference = start.offset;
  if (m.initialDisplacement == reference)
    start.displacement = Vector::Zero(basis.vectors.cols());
  else if (keepStatic)
    start.displacement = fitState(basis, m.mass, m.initialDisplacement - reference);
  else
    start.displacement = fitState(basis, m.initialDisplacement);
  if (basis.forces() == 0) return start;
  start.forces = Vector::Zero(basis.forces());
  if (reference.isZero(0.0)) return start;
  const Vector force = m.stiffnessAt(0.0) * reference - m.loadAt(0.0) -
                       m.pointForce(0.0, reference, Vector::Zero(m.size()));
  start.forces = force(basis.forceDofs);
  return start;
}

}  // namespace tooljoint::reduction
