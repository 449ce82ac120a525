// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/multilevel/TreeFactor.hpp"

#include <utility>

#include "common/Message.hpp"
#include "common/Parallel.hpp"
#include "common/report/StageTimes.hpp"
#include "reduction/multilevel/RankRows.hpp"
#include "reduction/part/Partition.hpp"

namespace tooljoint::reduction {

/// Contribution of a subtree to the equations of its boundary: to K + shift M, and its derivative.
struct TreeFactor::Update {
  Matrix stiffness, mass;
};

namespace {

/// A(dofs, [dofs boundary]) + factor B(..) with empty rows for the boundary. Contains the rows and,
/// mirrored, the columns of the dofs of a leaf; the entries within the boundary belong to the
/// ancestors.
Sparse bordered(const Sparse& jj, const Sparse& jb) {
  const auto inner = static_cast<int>(jj.rows()), rest = static_cast<int>(jb.cols());
  Triplets entries;
  entries.reserve(at(jj.nonZeros() + jb.nonZeros()));
  forEachEntry(jj, [&](int i, int k, double value) {
    if (k <= i) entries.emplace_back(i, k, value);
  });
  forEachEntry(jb, [&](int i, int k, double value) { entries.emplace_back(inner + k, i, value); });
  for (int k = 0; k < rest; ++k) entries.emplace_back(inner + k, inner + k, 0.0);
  return sparse(inner + rest, inner + rest, entries);
}

/// The equations [F_jj F_jb; F_jb' F_bb] of a separator j and its boundary b.
struct Front {
  Matrix jj, jb, bb;

  Front() = default;
  Front(Eigen::Index own, Eigen::Index rest)
      : jj(Matrix::Zero(own, own)), jb(Matrix::Zero(own, rest)), bb(Matrix::Zero(rest, rest)) {}

  void add(Eigen::Index i, Eigen::Index j, double value) {
    const Eigen::Index own = jj.rows();
    if (i < own)
      (j < own ? jj(i, j) : jb(i, j - own)) += value;
    else if (j >= own)
      bb(i - own, j - own) += value;
  }
  void add(const std::vector<int>& to, const Matrix& update) {
    for (int j = 0; j < sizeOf(to); ++j)
      for (int i = 0; i < sizeOf(to); ++i) add(to[at(i)], to[at(j)], update(i, j));
  }

  /// F_jj = L L'; replaces F_jb by L^-1 F_jb and F_bb by the Schur complement. False if F_jj is not
  /// positive definite.
  bool condense(linalg::DenseCholesky& factor) {
    if (!factor.factor(std::move(jj))) return false;
    factor.solveLower(jb);
    linalg::subtractSquare(jb, bb);
    return true;
  }
};

/// K + shift M with the pattern of both.
Sparse shifted(const Sparse& K, const Sparse& M, double shift) { return K + shift * M; }

Matrix rowsOf(const Matrix& X, const std::vector<int>& rows) { return X(rows, Eigen::all); }

}  // namespace

TreeFactor::TreeFactor(std::shared_ptr<const SubstructureTree> tree, const Sparse& K,
                       const Sparse& M, double shift, double step)
    : tree_(std::move(tree)), K_(K), shift_(shift), pieces_(tree_->pieces.size()) {
  const Stage stage("elimination of substructures");
  const int count = sizeOf(pieces_);
  std::vector<Update> updates(pieces_.size());
  bool good = true;
  parallel::agree([&] {
    for (int i = 0; i < count && good; ++i)
      if (tree_->pieces[at(i)].owner == parallel::rank()) good = eliminate(i, K, M, step, updates);
  });
  definite_ = parallel::maximum(good ? 0.0 : 1.0) == 0.0;
  if (!definite_) return;
  for (int i = 0; i < count; ++i) {  // subtrees to the pieces above them
    const auto& piece = tree_->pieces[at(i)];
    if (piece.owner == SubstructureTree::everyRank || piece.parent < 0 ||
        tree_->pieces[at(piece.parent)].owner != SubstructureTree::everyRank)
      continue;
    parallel::broadcast(updates[at(i)].stiffness, piece.owner);
    parallel::broadcast(updates[at(i)].mass, piece.owner);
  }
  parallel::agree([&] {
    for (int i = 0; i < count && good; ++i)
      if (tree_->pieces[at(i)].owner == SubstructureTree::everyRank)
        good = eliminate(i, K, M, step, updates);
  });
  definite_ = parallel::maximum(good ? 0.0 : 1.0) == 0.0;
}

bool TreeFactor::eliminate(int number, const Sparse& K, const Sparse& M, double step,
                           std::vector<Update>& updates) {
  const auto& piece = tree_->pieces[at(number)];
  EliminatedPiece& done = pieces_[at(number)];
  done.mass = block(M, piece.dofs, piece.dofs);
  done.massCoupling = block(M, piece.dofs, piece.boundary);
  return piece.leaf ? eliminateLeaf(number, K, step, updates[at(number)])
                    : eliminateSeparator(number, K, M, step, updates);
}

/// S(tau) and S(tau + step) need factors with the rows of the boundary, which are freed here.
/// Solutions need only K_jj, whose factors are less than half as large.
bool TreeFactor::eliminateLeaf(int number, const Sparse& K, double step, Update& update) {
  const auto& piece = tree_->pieces[at(number)];
  EliminatedPiece& done = pieces_[at(number)];
  const Sparse jj = block(K, piece.dofs, piece.dofs), jb = block(K, piece.dofs, piece.boundary);
  const int inner = sizeOf(piece.dofs);
  done.coupling = shifted(jb, done.massCoupling, shift_);
  const Sparse stiffness = shifted(jj, done.mass, shift_);
  if (!piece.boundary.empty()) {
    linalg::PartialFactor condensing;
    const Sparse further = bordered(shifted(jj, done.mass, shift_ + step),
                                    shifted(jb, done.massCoupling, shift_ + step));
    if (!condensing.factor(further, inner, update.mass) ||
        !condensing.factor(bordered(stiffness, done.coupling), inner, update.stiffness))
      return false;
    update.mass = (update.mass - update.stiffness) / step;
  }
  Matrix none;
  return done.sparse.factor(stiffness, inner, none);
}

bool TreeFactor::eliminateSeparator(int number, const Sparse& K, const Sparse& M, double step,
                                    std::vector<Update>& updates) {
  const auto& piece = tree_->pieces[at(number)];
  EliminatedPiece& done = pieces_[at(number)];
  const Eigen::Index own = sizeOf(piece.dofs), rest = sizeOf(piece.boundary);
  std::vector<int> position(at(tree_->dofs()), -1);
  for (Eigen::Index i = 0; i < own; ++i) position[at(piece.dofs[at(i)])] = static_cast<int>(i);
  for (Eigen::Index i = 0; i < rest; ++i)
    position[at(piece.boundary[at(i)])] = static_cast<int>(own + i);

  Front stiffness(own, rest), mass(own, rest);  // of K + shift M, and its derivative
  const auto assemble = [&](const Sparse& A, double factor, Front& front) {
    for (Eigen::Index i = 0; i < own; ++i)
      forEachInRow(A, piece.dofs[at(i)], [&](int column, double value) {
        const int j = position[at(column)];
        if (j >= 0) front.add(i, j, factor * value);
      });
  };
  assemble(K, 1.0, stiffness);
  assemble(M, shift_, stiffness);
  assemble(M, 1.0, mass);
  for (int child : piece.children) {
    Update& update = updates[at(child)];
    std::vector<int> to;
    for (int dof : tree_->pieces[at(child)].boundary) to.push_back(position[at(dof)]);
    stiffness.add(to, update.stiffness);
    mass.add(to, update.mass);
    update = {};
  }
  done.condensedMass = mass.jj;
  Update& update = updates[at(number)];
  if (rest > 0) {
    mass.jj = stiffness.jj + step * mass.jj;
    mass.jb = stiffness.jb + step * mass.jb;
    mass.bb = stiffness.bb + step * mass.bb;
    linalg::DenseCholesky other;
    if (!mass.condense(other)) return false;
    update.mass = std::move(mass.bb);
  }
  mass = {};
  if (!stiffness.condense(done.dense)) return false;
  done.static_ = std::move(stiffness.jb);
  update.stiffness = std::move(stiffness.bb);
  if (rest > 0) update.mass = (update.mass - update.stiffness) / step;
  done.dense.solveUpper(done.static_);
  return true;
}

Matrix TreeFactor::denseStiffness(int number) const {
  if (!tree_->pieces[at(number)].leaf) return piece(number).dense.product();
  const auto& dofs = tree_->pieces[at(number)].dofs;
  return Matrix(shifted(block(K_, dofs, dofs), piece(number).mass, shift_));
}

Matrix TreeFactor::solvePiece(int number, const Matrix& B) const {
  const EliminatedPiece& done = piece(number);
  return tree_->pieces[at(number)].leaf ? done.sparse.solve(B) : done.dense.solve(B);
}

Matrix TreeFactor::staticShape(int number, const Matrix& boundary) const {
  const EliminatedPiece& done = piece(number);
  if (tree_->pieces[at(number)].leaf) return done.sparse.solve(-Matrix(done.coupling * boundary));
  Matrix shape = Matrix::Zero(done.static_.rows(), boundary.cols());
  linalg::addProduct(-1.0, done.static_, boundary, shape);
  return shape;
}

/// b_b -= K_bj K_jj^-1 b_j
void TreeFactor::forward(int number, Matrix& X) const {
  const auto& piece = tree_->pieces[at(number)];
  if (piece.boundary.empty() || piece.dofs.empty()) return;
  const EliminatedPiece& done = pieces_[at(number)];
  const Matrix own = rowsOf(X, piece.dofs);
  const Matrix change = piece.leaf ? Matrix(done.coupling.transpose() * done.sparse.solve(own))
                                   : linalg::transposedTimes(done.static_, own);
  for (int i = 0; i < sizeOf(piece.boundary); ++i) X.row(piece.boundary[at(i)]) -= change.row(i);
}

/// x_j = K_jj^-1 (b_j - K_jb x_b)
void TreeFactor::backward(int number, Matrix& X) const {
  const auto& piece = tree_->pieces[at(number)];
  if (piece.dofs.empty()) return;
  const EliminatedPiece& done = pieces_[at(number)];
  const Matrix outer = rowsOf(X, piece.boundary);
  Matrix own = rowsOf(X, piece.dofs);
  if (piece.leaf) {
    if (outer.rows() > 0) own -= done.coupling * outer;
    own = done.sparse.solve(own);
  } else {
    own = done.dense.solve(own);
    linalg::addProduct(-1.0, done.static_, outer, own);
  }
  X(piece.dofs, Eigen::all) = own;
}

Matrix TreeFactor::solve(const Matrix& B) const {
  const Stage stage("solution by substructures");
  const int count = sizeOf(pieces_);
  std::vector<int> above;  // dofs of the pieces of all ranks
  for (const auto& piece : tree_->pieces)
    if (piece.owner == SubstructureTree::everyRank)
      above.insert(above.end(), piece.dofs.begin(), piece.dofs.end());
  Matrix X = B;
  parallel::agree([&] {
    for (int i = 0; i < count; ++i)
      if (tree_->pieces[at(i)].owner == parallel::rank()) forward(i, X);
  });
  if (parallel::size() > 1 && !above.empty())
    X(above, Eigen::all) = rowsOf(B, above) + sumOverRanks(rowsOf(X, above) - rowsOf(B, above));
  parallel::agree([&] {
    for (int i = 0; i < count; ++i)
      if (tree_->pieces[at(i)].owner == SubstructureTree::everyRank) forward(i, X);
    for (int i = count - 1; i >= 0; --i)
      if (tree_->mine(i)) backward(i, X);
  });
  gather(X);
  return X;
}

void TreeFactor::gather(Matrix& X) const {
  if (parallel::size() == 1) return;
  for (int rank = 0; rank < parallel::size(); ++rank) {
    std::vector<int> rows;
    for (const auto& piece : tree_->pieces)
      if (piece.owner == rank) rows.insert(rows.end(), piece.dofs.begin(), piece.dofs.end());
    if (rows.empty()) continue;
    Matrix own;
    if (rank == parallel::rank()) own = rowsOf(X, rows);
    parallel::broadcast(own, rank);
    X(rows, Eigen::all) = own;
  }
}

}  // namespace tooljoint::reduction
