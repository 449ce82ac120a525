// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/methods/BasisBuilder.hpp"

#include <algorithm>

#include "reduction/part/RowFiller.hpp"
#include "reduction/vectors/ModalVectors.hpp"

namespace tooljoint::reduction {

Basis fixedInterfaceBasis(const PartView& part, const InteriorVectors& vectors) {
  Basis basis;
  addConstraintRows(part, part.partition(), part.constraintModes().residuals, basis);
  setVectors(part.partition(), part.constraintModes().vectors, vectors, basis);
  report(vectors, basis);
  basis.orthonormal = true;
  basis.removable = vectors.removable;
  basis.orthogonality = vectors.orthogonality;
  return basis;
}

Basis subspaceBasis(const PartView& part, const Matrix& X, int count, const std::string& kind) {
  constexpr double dependent = 1e-10;
  const Sparse& M = part.interiorMass();
  OrthonormalSet set(M, dependent, part.who(kind + " vectors"));
  for (Eigen::Index j = 0; j < X.cols(); ++j) set.add(X.col(j));
  InteriorVectors vectors;
  vectors.groups = {part.partition().interior};
  addRitzVectors(part.symmetricInteriorStiffness(), M, set.basis(), 0, kind, vectors);
  vectors.kept = std::min(count, sizeOf(vectors.vectors));
  Basis basis = fixedInterfaceBasis(part, vectors);
  const int wanted = std::min(count, sizeOf(part.partition().interior));
  if (basis.modes() < wanted)
    basis.remarks.push_back("requested " + std::to_string(wanted) + " modes, but the " +
                            std::to_string(X.cols()) + " vectors given span " +
                            std::to_string(basis.modes()));
  return basis;
}

void setVectors(const Partition& partition, const Sparse& psi, const InteriorVectors& vectors,
                Basis& basis) {
  basis.partition = partition;
  const int boundary = sizeOf(partition.boundary);
  RowFiller columns(partition.size, boundary + vectors.kept);
  forEachEntry(psi, [&](int i, int, double) { columns.expect(i, 1); });
  for (int k = 0; k < vectors.kept; ++k) {
    const ModalVector& vector = vectors.vectors[at(k)];
    columns.expect(vectors.groups[at(vector.group)], vector.shape);
  }
  columns.start();
  forEachEntry(psi, [&](int i, int j, double value) { columns.put(i, j, value); });
  basis.eigenvalues.resize(vectors.kept);
  basis.modeKind.clear();
  for (int k = 0; k < vectors.kept; ++k) {
    const ModalVector& vector = vectors.vectors[at(k)];
    basis.eigenvalues[k] = vector.eigenvalue;
    basis.modeKind.push_back(vector.kind);
    columns.put(vectors.groups[at(vector.group)], {boundary + k}, vector.shape);
  }
  basis.vectors = columns.result();
}

void addConstraintRows(const PartView& part, const Partition& partition, const Vector& residuals,
                       Basis& basis, const std::string& why) {
  for (int j = 0; j < sizeOf(partition.boundary); ++j) {
    const int position = partition.boundary[at(j)];
    basis.rows.push_back({"constraint", part.dofName(position), 0, residuals[j], true,
                          j < sizeOf(partition.interface)            ? "interface dof"
                          : contains(part.part().retained, position) ? "retained dof"
                                                                     : why});
  }
}

void report(const InteriorVectors& vectors, Basis& basis) {
  for (int k = 0; k < sizeOf(vectors.vectors); ++k) {
    const ModalVector& vector = vectors.vectors[at(k)];
    basis.rows.push_back({vector.kind,
                          vector.name.empty() ? "vector " + std::to_string(k + 1) : vector.name,
                          vector.shown(), vector.residual, k < vectors.kept,
                          k < vectors.kept ? vector.why : "above the cut"});
  }
  basis.candidates = vectors.eigenvalues();
  basis.complete = vectors.complete;
  basis.method = vectors.method;
  basis.remarks.insert(basis.remarks.end(), vectors.remarks.begin(), vectors.remarks.end());
}

}  // namespace tooljoint::reduction
