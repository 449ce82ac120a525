// SPDX-License-Identifier: BSD-3-Clause
#include "linalg/GrowingKrylov.hpp"

#include <algorithm>
#include <utility>

#include "common/Error.hpp"
#include "linalg/Deterministic.hpp"
#include "linalg/GeneralEigen.hpp"

namespace tooljoint::linalg {

namespace {

/// A remainder after orthogonalisation below this fraction of the vector is rounding.
constexpr double rounding = 1e-14;

}  // namespace

template <class Scalar>
GrowingKrylov<Scalar>::GrowingKrylov(Operator apply, int size)
    : apply_(std::move(apply)), size_(size), directions_(size, 0) {}

template <class Scalar>
void GrowingKrylov<Scalar>::start(int columns, std::uint64_t seed) {
  width_ = std::min(columns, size_);
  add(scatteredNumbers(size_, width_, seed).cast<Scalar>());
}

template <class Scalar>
void GrowingKrylov<Scalar>::startWhole() {
  width_ = size_;
  add(Block::Identity(size_, size_));
}

template <class Scalar>
void GrowingKrylov<Scalar>::startBeside(int columns, std::uint64_t seed) {
  const std::deque<int> later = std::exchange(open_, {});
  add(scatteredNumbers(size_, std::min(columns, size_ - count_), seed).cast<Scalar>());
  open_.insert(open_.end(), later.begin(), later.end());
}

template <class Scalar>
void GrowingKrylov<Scalar>::add(const Block& columns) {
  Column coefficients;
  for (Eigen::Index j = 0; j < columns.cols(); ++j) {
    const int place = append(columns.col(j), columns.col(j).norm(), coefficients);
    if (place >= 0) open_.push_back(place);
  }
}

template <class Scalar>
int GrowingKrylov<Scalar>::append(Column w, double size, Column& h) {
  const auto V = directions_.leftCols(count_);
  h = V.adjoint() * w;
  w -= V * h;
  const Column again = V.adjoint() * w;
  w -= V * again;
  h += again;
  const double length = w.norm();
  if (!(length > rounding * size) || count_ >= size_) return -1;
  if (directions_.cols() == count_) {
    const auto room = std::min<Eigen::Index>(size_, std::max<Eigen::Index>(2 * count_, 64));
    directions_.conservativeResize(size_, room);
    const auto rows = projected_.rows(), columns = projected_.cols();
    projected_.conservativeResize(room, room);
    projected_.rightCols(room - columns).setZero();
    projected_.bottomRows(room - rows).setZero();
  }
  directions_.col(count_) = w / length;
  h.conservativeResize(count_ + 1);
  h[count_] = length;
  return count_++;
}

template <class Scalar>
void GrowingKrylov<Scalar>::step() {
  const auto width = std::min<std::size_t>(open_.size(), static_cast<std::size_t>(width_));
  const std::vector<int> now(open_.begin(), open_.begin() + static_cast<std::ptrdiff_t>(width));
  open_.erase(open_.begin(), open_.begin() + static_cast<std::ptrdiff_t>(width));
  Block columns(size_, static_cast<Eigen::Index>(width));
  for (std::size_t j = 0; j < width; ++j)
    columns.col(static_cast<Eigen::Index>(j)) = directions_.col(now[j]);
  const Block images = apply_(columns);
  std::vector<int> fresh;
  Column h;
  for (std::size_t j = 0; j < width; ++j) {
    const Column w = images.col(static_cast<Eigen::Index>(j));
    const int place = append(w, w.norm(), h);
    projected_.col(now[j]).setZero();
    projected_.col(now[j]).head(h.size()) = h;
    if (place >= 0) fresh.push_back(place);
    done_.push_back(now[j]);
  }
  // the current chain is continued before the waiting ones
  open_.insert(open_.begin(), fresh.begin(), fresh.end());
}

template <class Scalar>
void GrowingKrylov<Scalar>::grow(int columns) {
  while (!open_.empty() && static_cast<int>(done_.size()) < columns) step();
}

template <class Scalar>
RitzPairs GrowingKrylov<Scalar>::ritz() const {
  const auto m = static_cast<Eigen::Index>(done_.size());
  Block H(m, m), rest(static_cast<Eigen::Index>(open_.size()), m);
  for (Eigen::Index j = 0; j < m; ++j) {
    const int column = done_[static_cast<std::size_t>(j)];
    for (Eigen::Index i = 0; i < m; ++i)
      H(i, j) = projected_(done_[static_cast<std::size_t>(i)], column);
    for (std::size_t i = 0; i < open_.size(); ++i)
      rest(static_cast<Eigen::Index>(i), j) = projected_(open_[i], column);
  }
  auto found = generalPairs(std::move(H));
  if (!found.converged)
    throw ConvergenceError("The QR iteration of a projected eigenproblem did not converge.");
  RitzPairs pairs;
  pairs.values = std::move(found.values);
  pairs.coefficients = std::move(found.vectors);
  pairs.residuals.resize(m);
  for (Eigen::Index j = 0; j < m; ++j) {
    const double size = std::abs(pairs.values[j]);
    const double left =
        rest.rows() > 0 ? Eigen::VectorXcd(rest * pairs.coefficients.col(j)).norm() : 0.0;
    pairs.residuals[j] = size > 0 ? left / size : 0.0;
  }
  return pairs;
}

template <class Scalar>
Eigen::VectorXcd GrowingKrylov<Scalar>::vector(const RitzPairs& pairs, Eigen::Index j) const {
  Eigen::VectorXcd z = Eigen::VectorXcd::Zero(size_);
  for (std::size_t i = 0; i < done_.size(); ++i)
    z += directions_.col(done_[i]) * pairs.coefficients(static_cast<Eigen::Index>(i), j);
  return z;
}

template class GrowingKrylov<double>;
template class GrowingKrylov<std::complex<double>>;

}  // namespace tooljoint::linalg
