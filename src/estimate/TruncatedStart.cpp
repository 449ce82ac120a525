// SPDX-License-Identifier: BSD-3-Clause
#include "estimate/TruncatedStart.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "linalg/DenseDecompositions.hpp"
#include "reduction/part/Partition.hpp"
#include "reduction/vectors/ModalVectors.hpp"

namespace tooljoint::estimate {
namespace {

/// Applications of F M, and the smallest part of a vector that counts as new.
constexpr int steps = 12;
constexpr double independent = 1e-8;

Vector restricted(const Vector& x, const std::vector<int>& rows) {
  Vector out(static_cast<Eigen::Index>(rows.size()));
  for (std::size_t i = 0; i < rows.size(); ++i) out[static_cast<Eigen::Index>(i)] = x[rows[i]];
  return out;
}

/// Appends the part of x that is M-orthogonal to the columns of Q; false if it is linearly
/// dependent.
bool append(const Sparse& M, Vector x, Matrix& Q) {
  const double before = std::sqrt(std::max(0.0, x.dot(M * x)));
  if (!(before > 0.0)) return false;
  for (int pass = 0; pass < 2; ++pass) x -= Q * (Q.transpose() * Vector(M * x));
  const double size = std::sqrt(std::max(0.0, x.dot(M * x)));
  if (!(size > independent * before)) return false;
  Q.conservativeResize(x.size(), Q.cols() + 1);
  Q.rightCols(1) = x / size;
  return true;
}

}  // namespace

void TruncatedStart::begin(const PartResidual& part, const Vector& displacement,
                           const Vector& velocity) {
  interior_ = part.flexibility().interior();
  const auto& model = part.part().model;
  const Sparse M = reduction::block(model.mass, interior_, interior_);
  const Sparse K = reduction::block(reduction::symmetricPart(reduction::constantStiffness(model)),
                                    interior_, interior_);
  const Matrix W = Matrix(reduction::modalColumns(*part.reduced().basis));
  const Matrix MW = M * W;
  const Matrix gram = W.transpose() * MW;
  const auto left = [&](const Vector& x) {
    Vector inner = restricted(x, interior_);
    if (W.cols() == 0) return inner;
    return Vector(inner - W * linalg::solveSymmetric(gram, Vector(MW.transpose() * inner)));
  };
  const Vector d = left(displacement), v = left(velocity);
  Matrix Q(d.size(), 0);
  for (const Vector& start : {d, v}) {
    if (!append(M, start, Q)) continue;
    for (int i = 0; i < steps && Q.cols() < d.size(); ++i)
      if (!append(M, part.flexibility().apply(Matrix(M * Q.rightCols(1))).col(0), Q)) break;
  }
  if (Q.cols() == 0) return;
  const auto ritz = linalg::symmetricPairs(Q.transpose() * Matrix(K * Q));
  shapes_ = Q * ritz.vectors;
  omega_ = ritz.values.cwiseMax(0.0).cwiseSqrt();
  displacement_ = shapes_.transpose() * Vector(M * d);
  velocity_ = shapes_.transpose() * Vector(M * v);
}

void TruncatedStart::add(double t, Vector& w) const {
  if (shapes_.cols() == 0) return;
  Vector amplitudes(omega_.size());
  for (Eigen::Index j = 0; j < omega_.size(); ++j) {
    const double phase = omega_[j] * t;
    const double sine = omega_[j] > 0.0 ? std::sin(phase) / omega_[j] : t;
    amplitudes[j] = displacement_[j] * std::cos(phase) + velocity_[j] * sine;
  }
  const Vector motion = shapes_ * amplitudes;
  for (std::size_t i = 0; i < interior_.size(); ++i)
    w[interior_[i]] += motion[static_cast<Eigen::Index>(i)];
}

}  // namespace tooljoint::estimate
