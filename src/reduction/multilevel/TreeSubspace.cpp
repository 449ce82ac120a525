// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/multilevel/TreeSubspace.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "common/Interrupt.hpp"
#include "common/Message.hpp"
#include "common/Parallel.hpp"
#include "common/report/EvaluationCounters.hpp"
#include "common/report/StageTimes.hpp"
#include "reduction/multilevel/RankRows.hpp"

namespace tooljoint::reduction {

namespace {

/// Relative accuracy of the modes of the pieces, and of the Ritz vectors of their span.
constexpr double ofPieces = 1e-5, ofSpan = 1e-11;

linalg::InversePencil pencilOf(const TreeFactor& factor, int number) {
  const EliminatedPiece& piece = factor.piece(number);
  linalg::InversePencil pencil;
  pencil.size = static_cast<int>(piece.mass.rows());
  pencil.solve = [&factor, number](const Matrix& B) { return factor.solvePiece(number, B); };
  pencil.stiffness = [&factor, number] { return factor.denseStiffness(number); };
  if (factor.tree().pieces[at(number)].leaf)
    pencil.mass = [&piece](const Matrix& X) { return Matrix(piece.mass * X); };
  else
    pencil.mass = [&piece](const Matrix& X) {
      return linalg::transposedTimes(piece.condensedMass, X);
    };
  return pencil;
}

}  // namespace

TreeSubspace::TreeSubspace(const TreeFactor& factor)
    : factor_(factor), modes_(factor.tree().pieces.size()) {}

void TreeSubspace::takeLowest(int count) {
  linalg::RitzRequest request;
  request.count = count;
  take(request);
}

void TreeSubspace::takeBelow(double bound) {
  linalg::RitzRequest request;
  request.below = bound;
  take(request);
}

void TreeSubspace::take(const linalg::RitzRequest& given) {
  linalg::RitzRequest request = given;
  request.tolerance = ofPieces;
  parallel::agree([&] {
    const Stage stage("modes of substructures");
    for (int i = 0; i < sizeOf(modes_); ++i) {
      if (!factor_.tree().mine(i)) continue;
      stopIfInterrupted();
      auto& modes = modes_[at(i)];
      const auto known = modes.values.size();
      if (known > 0 && (modes.complete || modes.values[known - 1] >= request.below)) {
        int kept = 0;
        while (kept < known && kept < request.count && modes.values[kept] < request.below) ++kept;
        modes.complete = modes.complete && kept == known;
        modes.values.conservativeResize(kept);
        modes.vectors = Matrix(modes.vectors.leftCols(kept));
        continue;
      }
      modes = linalg::lowestRitzVectors(pencilOf(factor_, i), request);
      count("modes computed", modes.values.size());
    }
  });
  number();
  mass_ = projectedMass();
}

void TreeSubspace::number() {
  const int pieces = sizeOf(modes_);
  count_.assign(at(pieces), 0);
  first_.assign(at(pieces), 0);
  size_ = 0;
  bool all = true;
  for (int i = 0; i < pieces; ++i) {
    const int owner = std::max(0, factor_.tree().pieces[at(i)].owner);
    int numbers[2] = {static_cast<int>(modes_[at(i)].values.size()),
                      modes_[at(i)].complete ? 1 : 0};
    for (int& number : numbers) parallel::broadcast(number, owner);
    count_[at(i)] = numbers[0];
    first_[at(i)] = size_;
    size_ += numbers[0];
    all = all && numbers[1] == 1;
  }
  complete_ = all;
}

/// Columns of the ancestors of a piece, starting at the root.
std::vector<int> TreeSubspace::columnsAbove(int piece) const {
  std::vector<int> columns;
  for (int i : factor_.tree().pieces[at(piece)].path)
    if (i != piece)
      for (int k = 0; k < count_[at(i)]; ++k) columns.push_back(first_[at(i)] + k);
  return columns;
}

/// Rows of the boundary of a piece in the columns of its ancestors; those of an ancestor are the
/// first columns of all pieces below it.
Matrix TreeSubspace::onBoundary(int piece, const std::vector<Matrix>& shapes,
                                Eigen::Index columns) const {
  const auto& tree = factor_.tree();
  const auto& boundary = tree.pieces[at(piece)].boundary;
  Matrix X = Matrix::Zero(sizeOf(boundary), columns);
  for (int i = 0; i < sizeOf(boundary); ++i) {
    const int dof = boundary[at(i)];
    const Matrix& above = shapes[at(tree.pieceOf[at(dof)])];
    X.row(i).head(above.cols()) = above.row(tree.rowOf[at(dof)]);
  }
  return X;
}

/// Sum over the pieces of X_j'M_jj X_j + X_j'M_jb X_b + X_b'M_bj X_j.
Matrix TreeSubspace::projectedMass() const {
  const Stage stage("projection on substructures");
  const auto& tree = factor_.tree();
  std::vector<Matrix> shapes(modes_.size());
  Matrix sum = Matrix::Zero(size_, size_);
  parallel::agree([&] {
    for (int i = sizeOf(modes_) - 1; i >= 0; --i) {
      if (!tree.mine(i)) continue;
      std::vector<int> columns = columnsAbove(i);
      const Eigen::Index above = sizeOf(columns), own = count_[at(i)];
      for (int k = 0; k < own; ++k) columns.push_back(first_[at(i)] + k);
      const EliminatedPiece& piece = factor_.piece(i);
      Matrix X(piece.mass.rows(), above + own);
      const Matrix outer = onBoundary(i, shapes, above);
      X.leftCols(above) = factor_.staticShape(i, outer);
      X.rightCols(own) = modes_[at(i)].vectors;
      const bool counted =
          tree.pieces[at(i)].owner != SubstructureTree::everyRank || parallel::rank() == 0;
      if (counted) {
        const Matrix inertia = piece.mass * X;
        Matrix part = linalg::transposedTimes(X, inertia);
        const Matrix outerInertia = piece.massCoupling * outer;
        const Matrix mixed = linalg::transposedTimes(X, outerInertia);
        part.leftCols(above) += mixed;
        part.topRows(above) += mixed.transpose();
        for (int c = 0; c < sizeOf(columns); ++c)
          for (int r = 0; r < sizeOf(columns); ++r)
            sum(columns[at(r)], columns[at(c)]) += part(r, c);
      }
      if (!tree.pieces[at(i)].leaf) shapes[at(i)] = std::move(X);
    }
  });
  sum = sumOverRanks(sum);
  return 0.5 * (sum + sum.transpose());
}

linalg::RitzVectors TreeSubspace::ritz(const linalg::RitzRequest& given) const {
  const Stage stage("modes of the coupled substructures");
  linalg::RitzRequest request = given;
  request.tolerance = ofSpan;
  linalg::InversePencil pencil;
  pencil.size = size_;
  pencil.solve = [](const Matrix& B) { return B; };
  pencil.mass = [this](const Matrix& X) { return linalg::transposedTimes(mass_, X); };
  pencil.stiffness = [this] { return Matrix::Identity(size_, size_); };
  return linalg::lowestRitzVectors(pencil, request);
}

Matrix TreeSubspace::recover(const Matrix& Y) const {
  const Stage stage("recovery from substructures");
  const auto& tree = factor_.tree();
  Matrix X = Matrix::Zero(tree.dofs(), Y.cols());
  parallel::agree([&] {
    for (int i = sizeOf(modes_) - 1; i >= 0; --i) {
      if (!tree.mine(i)) continue;
      const auto& piece = tree.pieces[at(i)];
      Matrix own = Matrix::Zero(sizeOf(piece.dofs), Y.cols());
      if (!piece.boundary.empty())
        own = factor_.staticShape(i, Matrix(X(piece.boundary, Eigen::all)));
      linalg::addProduct(1.0, modes_[at(i)].vectors, Y.middleRows(first_[at(i)], count_[at(i)]),
                         own);
      X(piece.dofs, Eigen::all) = own;
    }
  });
  factor_.gather(X);
  return X;
}

}  // namespace tooljoint::reduction
