// SPDX-License-Identifier: BSD-3-Clause
#include "linalg/InverseLanczos.hpp"

#include <algorithm>
#include <cmath>

#include "common/Error.hpp"
#include "linalg/DenseDecompositions.hpp"
#include "linalg/DenseKernels.hpp"
#include "linalg/Deterministic.hpp"

namespace tooljoint::linalg {

namespace {

/// Pencils up to this size are solved by a dense method.
constexpr int denseUpTo = 300;
/// Pencils up to this size are solved by a dense method if the iteration needs more than this
/// fraction of the size.
constexpr int denseAtMost = 3000;
constexpr double denseShare = 0.3;
/// Vectors in a block, which is also the number of copies found of a repeated eigenvalue.
constexpr int blockSize = 8;
/// mu = 1 / lambda below this part of the largest means an infinite lambda (massless dofs).
constexpr double infinite = 1e-14;
/// Remainder of a unit vector that is linearly dependent on earlier ones.
constexpr double dependent = 1e-9;

Matrix columnsOf(const Matrix& A, Eigen::Index first, Eigen::Index count) {
  return A.middleCols(first, count);
}

/// Number of wanted values among the decreasing `mu`.
int wantedOf(const Vector& mu, const RitzRequest& request) {
  int wanted = 0;
  while (wanted < mu.size() && wanted < request.count && mu[wanted] * request.below > 1.0) ++wanted;
  return wanted;
}

RitzVectors dense(const InversePencil& pencil, const RitzRequest& request) {
  // M phi = mu K phi
  const Matrix M = pencil.mass(Matrix::Identity(pencil.size, pencil.size));
  const auto pairs = symmetricPairs(0.5 * (M + M.transpose()), pencil.stiffness());
  if (!pairs.converged)
    throw ConvergenceError("The QR iteration for the modes of a substructure did not converge.");
  const Vector mu = pairs.values.reverse();
  int finite = 0;
  while (finite < mu.size() && mu[finite] > infinite * mu[0]) ++finite;
  const int wanted = wantedOf(mu.head(finite), request);
  const Matrix decreasing = pairs.vectors.rowwise().reverse();
  return {mu.head(wanted).cwiseInverse(), decreasing.leftCols(wanted), wanted == finite};
}

class Iteration {
 public:
  Iteration(const InversePencil& pencil, const RitzRequest& request)
      : pencil_(pencil), request_(request) {}

  RitzVectors run() {
    const Matrix start =
        pencil_.mass(scatteredNumbers(pencil_.size, std::min(blockSize, pencil_.size), 29));
    Matrix Q = pencil_.solve(start), KQ = start;
    orthonormalise(Q, KQ);
    int nextCheck = 3 * blockSize;
    while (Q.cols() > 0) {
      append(Q, KQ);
      if (size_ > denseShare * pencil_.size && pencil_.size <= denseAtMost)
        return dense(pencil_, request_);
      // W = K^-1 M Q, K W = M Q
      const Eigen::Index last = Q.cols();
      KQ = pencil_.mass(Q);
      project(KQ, last);
      Q = pencil_.solve(KQ);
      const Matrix K_W = KQ, W = Q;
      orthonormalise(Q, KQ);
      if (Q.cols() > 0 && size_ < nextCheck && size_ + blockSize < pencil_.size) continue;
      nextCheck = size_ + std::max(2 * blockSize, size_ / 6);
      const Matrix coupling = transposedTimes(Q, K_W);  // component of W in the next block
      if (converged(coupling, last)) break;
    }
    RitzVectors result;
    result.values = mu_.head(wanted_).cwiseInverse();
    const Matrix chosen = columnsOf(Y_, 0, wanted_);
    result.vectors = Matrix::Zero(pencil_.size, wanted_);
    addProduct(1.0, columnsOf(V_, 0, size_), chosen, result.vectors);
    result.complete = Q.cols() == 0 && wanted_ == finite_;
    return result;
  }

 private:
  /// Orthonormalises the columns of Q against V and each other in the inner product of K; dependent
  /// ones are dropped.
  void orthonormalise(Matrix& Q, Matrix& KQ) const {
    scale(Q, KQ);
    for (int pass = 0; pass < 2; ++pass) {
      for (int again = 0; again < 2 && size_ > 0; ++again) {
        const Matrix part = transposedTimes(columnsOf(KV_, 0, size_), Q);
        addProduct(-1.0, columnsOf(V_, 0, size_), part, Q);
        addProduct(-1.0, columnsOf(KV_, 0, size_), part, KQ);
      }
      if (Q.cols() == 0) return;
      const Matrix gram = transposedTimes(Q, KQ);
      const auto pairs = symmetricPairs(0.5 * (gram + gram.transpose()));
      const double least = pass == 0 ? dependent * dependent : 0.5;
      Eigen::Index first = 0;
      while (first < Q.cols() && !(pairs.values[first] > least)) ++first;
      const Eigen::Index kept = Q.cols() - first;
      const Matrix R = pairs.vectors.rightCols(kept) *
                       pairs.values.tail(kept).cwiseSqrt().cwiseInverse().asDiagonal();
      Q = Q * R;
      KQ = KQ * R;
    }
  }

  static void scale(Matrix& Q, Matrix& KQ) {
    for (Eigen::Index j = 0; j < Q.cols(); ++j) {
      const double length = std::sqrt(std::max(0.0, Q.col(j).dot(KQ.col(j))));
      const double factor = length > 0.0 ? 1.0 / length : 0.0;
      Q.col(j) *= factor;
      KQ.col(j) *= factor;
    }
  }

  void append(const Matrix& Q, const Matrix& KQ) {
    const Eigen::Index needed = size_ + Q.cols();
    if (needed > V_.cols()) {
      const Eigen::Index room = std::max<Eigen::Index>(needed, V_.cols() * 3 / 2 + 8 * blockSize);
      V_.conservativeResize(pencil_.size, room);
      KV_.conservativeResize(pencil_.size, room);
      H_.conservativeResize(room, room);
    }
    V_.middleCols(size_, Q.cols()) = Q;
    KV_.middleCols(size_, Q.cols()) = KQ;
    size_ = static_cast<int>(needed);
  }

  /// New columns of H = V' M V from M Q of the last block.
  void project(const Matrix& MQ, Eigen::Index last) {
    const Matrix columns = transposedTimes(columnsOf(V_, 0, size_), MQ);
    H_.block(0, size_ - last, size_, last) = columns;
    H_.block(size_ - last, 0, last, size_) = columns.transpose();
  }

  /// Computes the Ritz values of H; true if the wanted ones have converged.
  bool converged(const Matrix& coupling, Eigen::Index last) {
    const Matrix H = H_.topLeftCorner(size_, size_);
    const auto pairs = symmetricPairs(0.5 * (H + H.transpose()));
    mu_ = pairs.values.reverse();
    Y_ = pairs.vectors.rowwise().reverse();
    finite_ = 0;
    while (finite_ < size_ && mu_[finite_] > infinite * mu_[0]) ++finite_;
    wanted_ = wantedOf(mu_.head(finite_), request_);
    if (coupling.rows() == 0) return true;  // invariant subspace: contains all
    if (wanted_ == finite_ && wanted_ < request_.count) return false;
    const Matrix residual = coupling * Y_.block(size_ - last, 0, last, wanted_);
    for (int j = 0; j < wanted_; ++j)
      if (!(residual.col(j).norm() <= request_.tolerance * mu_[j])) return false;
    return true;
  }

  const InversePencil& pencil_;
  const RitzRequest& request_;
  Matrix V_, KV_, H_;
  int size_ = 0, wanted_ = 0, finite_ = 0;
  Vector mu_;
  Matrix Y_;
};

}  // namespace

RitzVectors lowestRitzVectors(const InversePencil& pencil, const RitzRequest& request) {
  if (pencil.size == 0) return {Vector(), Matrix(0, 0), true};
  if (request.count == 0) return {Vector(), Matrix(pencil.size, 0), false};
  const bool all = request.count >= pencil.size && std::isinf(request.below);
  return all || pencil.size <= denseUpTo ? dense(pencil, request)
                                         : Iteration(pencil, request).run();
}

}  // namespace tooljoint::linalg
