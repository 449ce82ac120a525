// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/vectors/InitialState.hpp"

#include <Eigen/QR>

namespace tooljoint::reduction {

Vector fitState(const Basis& basis, const Vector& x) {
  const auto& kept = basis.partition.kept;
  const auto& interior = basis.partition.interior;
  Vector q = Vector::Zero(basis.vectors.cols());
  if (x.isZero(0.0)) return q;
  for (std::size_t j = 0; j < kept.size(); ++j) q[static_cast<Eigen::Index>(j)] = x[kept[j]];
  const int modes = basis.modes();
  if (modes == 0 || interior.empty()) return q;
  const Vector rest = x - basis.vectors * q;  // x_I - phi_C x_C on the interior
  Vector target(static_cast<Eigen::Index>(interior.size()));
  for (std::size_t i = 0; i < interior.size(); ++i)
    target[static_cast<Eigen::Index>(i)] = rest[interior[i]];
  if (target.isZero(0.0)) return q;
  std::vector<int> columns;
  for (int k = 0; k < modes; ++k) columns.push_back(static_cast<int>(kept.size()) + k);
  const Matrix phi = block(basis.vectors, interior, columns);
  q.tail(modes) = phi.colPivHouseholderQr().solve(target);
  return q;
}

StartState startState(const model::Substructure& part, const Basis& basis, bool keepStatic) {
  const auto& m = part.model;
  StartState start;
  start.velocity = fitState(basis, m.initialVelocity);
  start.offset =
      keepStatic && part.reference.size() > 0 ? part.reference : Vector(Vector::Zero(m.size()));
  const Vector& reference = start.offset;
  if (m.initialDisplacement == reference)
    start.displacement = Vector::Zero(basis.vectors.cols());
  else
    start.displacement = fitState(basis, m.initialDisplacement - reference);
  if (basis.forces() == 0) return start;
  start.forces = Vector::Zero(basis.forces());
  if (reference.isZero(0.0)) return start;
  const Vector force = m.stiffnessAt(0.0) * reference - m.loadAt(0.0) -
                       m.pointForce(0.0, reference, Vector::Zero(m.size()));
  for (int j = 0; j < basis.forces(); ++j)
    start.forces[j] = force[basis.boundary[static_cast<std::size_t>(j)]];
  return start;
}

}  // namespace tooljoint::reduction
