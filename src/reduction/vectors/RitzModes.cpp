// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/vectors/RitzModes.hpp"

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>
#include <algorithm>

#include "common/Error.hpp"
#include "common/Index.hpp"
#include "linalg/trilinos/SemidefiniteModes.hpp"
#include "reduction/methods/BasisBuilder.hpp"
#include "reduction/vectors/ModalVectors.hpp"

namespace tooljoint::reduction {

namespace {

/// Vectors whose new part is smaller than this, in the mass norm, are combinations of the others.
constexpr double dependent = 1e-10;

/// M-orthonormal columns of the span of Z for a singular M. The vectors are responses K_II^-1 M
/// phi; for symmetric K only the zero vector among them has no mass.
Matrix orthonormalWithoutMass(const PartView& part, const Sparse& M, const Matrix& Z) {
  if (!part.symmetric())
    throw ModelError(part.who() +
                     "its interior has dofs without mass and its stiffness is not symmetric. Give "
                     "every interior dof a mass, retain the massless dofs, or choose the basis "
                     "\"Craig-Bampton\".");
  OrthonormalSet set(M, dependent, part.who());
  for (Eigen::Index j = 0; j < Z.cols(); ++j) set.add(Z.col(j));
  return set.basis();
}

/// M-orthonormal columns of the span of Z. M = P' L L' P; the columns of L' P Z are orthogonalised
/// by Householder reflections with pivoting.
Matrix orthonormal(const PartView& part, const Sparse& M, const Matrix& Z) {
  if (linalg::hasSingularMass(M)) return orthonormalWithoutMass(part, M, Z);
  const Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> factor{Eigen::SparseMatrix<double>(M)};
  Matrix scaled = factor.matrixU() * (factor.permutationP() * Z);
  Eigen::Index used = 0;
  for (Eigen::Index j = 0; j < scaled.cols(); ++j) {
    const double length = scaled.col(j).norm();
    if (length > 0) scaled.col(used++) = scaled.col(j) / length;
  }
  Eigen::ColPivHouseholderQR<Matrix> qr(scaled.leftCols(used));
  qr.setThreshold(dependent);
  const Eigen::Index rank = used > 0 ? qr.rank() : 0;
  Matrix Q = Matrix::Identity(scaled.rows(), rank);
  Q.applyOnTheLeft(qr.householderQ());
  return factor.permutationPinv() * Matrix(factor.matrixU().solve(Q));
}

/// Adds the Ritz modes of a group.
void addRitzModes(const PartView& part, const VectorGroup& group, const std::string& kind,
                  InteriorVectors& to) {
  const Sparse M = block(part.mass(), group.positions, group.positions),
               k = block(part.symmetricStiffness(), group.positions, group.positions);
  addRitzVectors(k, M, orthonormal(part, M, group.columns), sizeOf(to.groups) - 1, kind, to);
}

/// Columns of `all` (interior x columns) that are nonzero on the dofs of a group.
VectorGroup restricted(const Matrix& all, const std::vector<int>& interior,
                       const std::vector<int>& dofs) {
  VectorGroup group;
  std::vector<int> members, used;
  for (int i = 0; i < sizeOf(interior); ++i)
    if (std::binary_search(dofs.begin(), dofs.end(), interior[at(i)])) {
      group.positions.push_back(interior[at(i)]);
      members.push_back(i);
    }
  const Matrix own = all(members, Eigen::all);
  for (int j = 0; j < own.cols(); ++j)
    if (own.rows() > 0 && !own.col(j).isZero(0.0)) used.push_back(j);
  group.columns = own(Eigen::all, used);
  return group;
}

}  // namespace

void completeWithRitzModes(const PartView& part, const ConstraintModes& constraint,
                           const std::vector<VectorGroup>& groups, const std::string& kind,
                           Basis& basis) {
  InteriorVectors vectors;
  for (const auto& group : groups) {
    vectors.groups.push_back(group.positions);
    if (!group.positions.empty() && group.columns.cols() > 0)
      addRitzModes(part, group, kind, vectors);
  }
  vectors.keepAll();
  setVectors(part.partition(), constraint.vectors, vectors, basis);
  basis.orthogonality = std::max(basis.orthogonality, vectors.orthogonality);
  basis.orthonormal = true;
  basis.removable = false;
}

std::vector<VectorGroup> freeInterfaceVectors(const PartView& part, const InteriorVectors& modes,
                                              const InteriorStatics& statics, bool rigid,
                                              bool elastic) {
  const auto& interior = part.partition().interior;
  const Sparse skew = part.stiffness() - part.symmetricStiffness();
  const Matrix carriers = rigid ? statics.carriers() : Matrix(part.model().size(), 0);
  std::vector<VectorGroup> groups;
  for (int number = 0; number < sizeOf(modes.groups); ++number) {
    std::vector<int> chosen;
    for (int k = 0; k < modes.kept && elastic; ++k)
      if (modes.vectors[at(k)].group == number && !modes.vectors[at(k)].rigid) chosen.push_back(k);
    const Matrix shapes = modes.columns(chosen, part.model().size());
    Matrix forces(shapes.rows(), shapes.cols() + carriers.cols());
    // those of other groups: zero here, and removed below
    forces.rightCols(carriers.cols()) = part.mass() * carriers;
    for (int j = 0; j < sizeOf(chosen); ++j) {
      const Vector phi = shapes.col(j), inertia = part.mass() * phi;
      forces.col(j) =
          part.symmetric()
              ? inertia
              : Vector(modes.vectors[at(chosen[at(j)])].eigenvalue * inertia + skew * phi);
    }
    const auto& dofs = modes.groups[at(number)];
    for (int i = 0; i < forces.rows(); ++i)
      if (!std::binary_search(dofs.begin(), dofs.end(), i)) forces.row(i).setZero();
    const Matrix answers = statics.solve(forces(interior, Eigen::all));
    Matrix all(answers.rows(), answers.cols() + statics.mechanisms().cols());
    all << statics.mechanisms(), answers;
    groups.push_back(restricted(all, interior, dofs));
  }
  return groups;
}

}  // namespace tooljoint::reduction
