// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/vectors/RitzModes.hpp"

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <numeric>

#include "common/Error.hpp"
#include "common/Index.hpp"

namespace tooljoint::reduction {

namespace {

/// Vectors whose part that is new is less than this, in the mass norm, are combinations of the
/// others.
constexpr double dependent = 1e-10;

struct Ritz {
  Matrix shapes;
  Vector values;
  double orthogonality = 0;
};

Matrix rows(const Matrix& A, const std::vector<int>& which) {
  Matrix out(static_cast<Eigen::Index>(which.size()), A.cols());
  for (std::size_t i = 0; i < which.size(); ++i)
    out.row(static_cast<Eigen::Index>(i)) = A.row(which[i]);
  return out;
}

/// M = P' L L' P; the columns of L' P Z are orthogonalised by Householder reflections with
/// pivoting, then K is made diagonal.
Ritz ritzModes(const model::Substructure& part, const Sparse& K, const VectorGroup& group) {
  const Sparse M = block(part.model.mass, group.positions, group.positions),
               k = block(K, group.positions, group.positions);
  const Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> factor{Eigen::SparseMatrix<double>(M)};
  if (factor.info() != Eigen::Success)
    throw ModelError("Part \"" + part.name +
                     "\": the mass of its interior is not positive definite. Give every interior "
                     "dof mass, or retain the massless ones.");
  Matrix scaled = factor.matrixU() * (factor.permutationP() * group.columns);
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
  const Matrix W = factor.permutationPinv() * Matrix(factor.matrixU().solve(Q));
  Matrix projected = W.transpose() * (k * W);
  projected = (0.5 * (projected + projected.transpose())).eval();
  Ritz ritz;
  if (rank == 0) return {Matrix(scaled.rows(), 0), Vector(), 0};
  const Eigen::SelfAdjointEigenSolver<Matrix> pairs(projected);
  if (pairs.info() != Eigen::Success)
    throw ConvergenceError("Part \"" + part.name +
                           "\": the Ritz modes of its interior were not found (QR iteration).");
  ritz.shapes = W * pairs.eigenvectors();
  ritz.values = pairs.eigenvalues();
  ritz.orthogonality = (ritz.shapes.transpose() * (M * ritz.shapes) - Matrix::Identity(rank, rank))
                           .cwiseAbs()
                           .maxCoeff();
  return ritz;
}

/// Columns of `all` (interior x columns) that are not zero on the dofs of a link.
VectorGroup restricted(const Matrix& all, const std::vector<int>& interior,
                       const std::vector<char>& inLink) {
  VectorGroup group;
  std::vector<int> members;
  for (std::size_t i = 0; i < interior.size(); ++i)
    if (inLink[at(interior[i])]) {
      group.positions.push_back(interior[i]);
      members.push_back(static_cast<int>(i));
    }
  const Matrix own = rows(all, members);
  group.columns.resize(own.rows(), 0);
  for (Eigen::Index j = 0; j < own.cols(); ++j) {
    if (own.rows() == 0 || own.col(j).isZero(0.0)) continue;
    group.columns.conservativeResize(own.rows(), group.columns.cols() + 1);
    group.columns.rightCols(1) = own.col(j);
  }
  return group;
}

}  // namespace

void addConstraintRows(const model::Substructure& part, const ConstraintModes& constraint,
                       Basis& basis) {
  for (std::size_t j = 0; j < basis.partition.kept.size(); ++j) {
    BasisRow row;
    row.kind = "constraint";
    row.name =
        model::describe(part.model.dofs[at(basis.partition.kept[j])], part.model.componentNames);
    row.residual = constraint.residuals[static_cast<Eigen::Index>(j)];
    row.why = j < basis.partition.interface.size() ? "interface dof" : "retained dof";
    basis.rows.push_back(row);
  }
}

void completeWithRitzModes(const model::Substructure& part, const Sparse& symmetricK,
                           const ConstraintModes& constraint,
                           const std::vector<VectorGroup>& groups, const std::string& kind,
                           Basis& basis) {
  std::vector<Ritz> found;
  struct Place {
    double value;
    std::size_t group;
    Eigen::Index column;
  };
  std::vector<Place> order;
  for (const auto& group : groups) {
    if (group.positions.empty() || group.columns.cols() == 0) {
      found.emplace_back();
      continue;
    }
    found.push_back(ritzModes(part, symmetricK, group));
    for (Eigen::Index k = 0; k < found.back().values.size(); ++k)
      order.push_back({found.back().values[k], found.size() - 1, k});
    basis.orthogonality = std::max(basis.orthogonality, found.back().orthogonality);
  }
  std::stable_sort(order.begin(), order.end(),
                   [](const Place& a, const Place& b) { return a.value < b.value; });
  const auto kept = static_cast<int>(basis.partition.kept.size());
  Triplets entries = constraint.entries;
  basis.eigenvalues.resize(static_cast<Eigen::Index>(order.size()));
  basis.modeKind.assign(order.size(), kind);
  for (std::size_t k = 0; k < order.size(); ++k) {
    const Place& place = order[k];
    basis.eigenvalues[static_cast<Eigen::Index>(k)] = place.value;
    const auto& positions = groups[place.group].positions;
    auto shape = found[place.group].shapes.col(place.column);
    Eigen::Index largest = 0;
    shape.cwiseAbs().maxCoeff(&largest);
    const double sign = shape[largest] < 0 ? -1 : 1;
    for (std::size_t i = 0; i < positions.size(); ++i) {
      const double value = sign * shape[static_cast<Eigen::Index>(i)];
      if (value != 0.0) entries.emplace_back(positions[i], kept + static_cast<int>(k), value);
    }
  }
  basis.vectors = Sparse(basis.partition.size, kept + static_cast<Eigen::Index>(order.size()));
  basis.vectors.setFromTriplets(entries.begin(), entries.end());
  basis.orthonormal = true;
  basis.removable = false;
}

std::vector<VectorGroup> freeInterfaceVectors(const model::Substructure& part, const Sparse& K,
                                              const Partition& p, const FreeInterfaceModes& modes,
                                              const InteriorStatics& statics, bool rigid,
                                              bool elastic) {
  const bool symmetric = nearlySymmetric(K, 1e-13);
  const Sparse skew = K - symmetricPart(K);
  std::vector<VectorGroup> groups;
  const Matrix shapes = modes.columns(modes.kept, p.size);
  for (int link = 0; link < static_cast<int>(modes.links.size()); ++link) {
    std::vector<int> numbers;
    for (int k = 0; k < modes.kept; ++k) {
      const auto& mode = modes.modes[at(k)];
      if (mode.link == link && !mode.rigid && elastic) numbers.push_back(k);
    }
    const auto& carriers = statics.carriers();
    const auto relief =
        rigid ? carriers.cols() : 0;  // of other links: zero here, and left out below
    Matrix forces(p.size, static_cast<Eigen::Index>(numbers.size()) + relief);
    forces.rightCols(relief) = part.model.mass * carriers.leftCols(relief);
    for (std::size_t j = 0; j < numbers.size(); ++j) {
      const auto& mode = modes.modes[at(numbers[j])];
      const auto phi = shapes.col(numbers[j]);
      const Vector inertia = part.model.mass * phi;
      forces.col(static_cast<Eigen::Index>(j)) =
          symmetric ? inertia : Vector(mode.eigenvalue * inertia + skew * phi);
    }
    std::vector<char> inLink(at(p.size), 0);
    for (int i : modes.links[at(link)]) inLink[at(i)] = 1;
    for (int i = 0; i < p.size; ++i)
      if (!inLink[at(i)]) forces.row(i).setZero();
    const Matrix answers = statics.solve(rows(forces, p.interior));
    Matrix all(answers.rows(), answers.cols() + statics.mechanisms().cols());
    all << statics.mechanisms(), answers;
    groups.push_back(restricted(all, p.interior, inLink));
  }
  return groups;
}

}  // namespace tooljoint::reduction
