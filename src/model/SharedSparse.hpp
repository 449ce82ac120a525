// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A sparse matrix whose copies share its storage until one of them is changed.
#pragma once

#include <memory>
#include <new>
#include <utility>

#include "common/Types.hpp"

namespace tooljoint::model {

/// A value like `Sparse`, always compressed, that costs a pointer to copy: a hundred identical
/// reduced parts hold one mass matrix. It is read as any sparse expression of Eigen and as `const
/// Sparse&`; a changed copy has its own storage.
class SharedSparse : public Eigen::Map<const Sparse> {
  using View = Eigen::Map<const Sparse>;

 public:
  SharedSparse() : SharedSparse(empty()) {}
  SharedSparse(Sparse&& matrix) : SharedSparse(taken(matrix)) {}
  template <class Derived>
  SharedSparse(const Eigen::EigenBase<Derived>& expression)
      : SharedSparse(Sparse(expression.derived())) {}
  SharedSparse(const SharedSparse& other)
      : View(static_cast<const View&>(other)), matrix_(other.matrix_) {}
  SharedSparse& operator=(const SharedSparse& other) {
    if (this != &other) look(other.matrix_);
    return *this;
  }
  ~SharedSparse() = default;

  operator const Sparse&() const { return *matrix_; }
  const Sparse& sparse() const { return *matrix_; }
  /// Whether both share the same storage.
  bool sharesWith(const SharedSparse& other) const { return matrix_ == other.matrix_; }

  /// As in Sparse. (Iterate over rows with `SharedSparse::InnerIterator`.)
  Eigen::Diagonal<const Sparse> diagonal() const { return sparse().diagonal(); }
  void resize(Eigen::Index rows, Eigen::Index columns) { *this = Sparse(rows, columns); }
  template <class Iterator>
  void setFromTriplets(Iterator begin, Iterator end) {
    Sparse matrix(rows(), cols());
    matrix.setFromTriplets(begin, end);
    look(taken(matrix));
  }
  void setIdentity() {
    Sparse matrix(rows(), cols());
    matrix.setIdentity();
    look(taken(matrix));
  }
  SharedSparse& operator*=(double factor) { return *this = *this * factor; }
  /// Entry (i, j) for writing, until this matrix is copied; created if missing.
  double& coeffRef(Eigen::Index i, Eigen::Index j) {
    if (matrix_.use_count() > 1) look(std::make_shared<Sparse>(*matrix_));
    double* entry = &matrix_->coeffRef(i, j);
    if (matrix_->isCompressed()) return *entry;
    matrix_->makeCompressed();
    look(matrix_);
    return matrix_->coeffRef(i, j);
  }

 private:
  using Storage = std::shared_ptr<Sparse>;

  explicit SharedSparse(Storage matrix)
      : View(matrix->rows(), matrix->cols(), matrix->nonZeros(), matrix->outerIndexPtr(),
             matrix->innerIndexPtr(), matrix->valuePtr()),
        matrix_(std::move(matrix)) {}

  static const Storage& empty() {
    static const Storage none = std::make_shared<Sparse>();
    return none;
  }
  /// Takes the entries of a matrix, which is empty afterwards: Eigen 3.4 moves sparse matrices only
  /// by swap().
  static Storage taken(Sparse& matrix) {
    auto storage = std::make_shared<Sparse>();
    storage->swap(matrix);
    storage->makeCompressed();
    return storage;
  }
  /// A Map is redirected by constructing it again (recommended by Eigen).
  void look(Storage matrix) {
    matrix_ = std::move(matrix);
    new (static_cast<View*>(this))
        View(matrix_->rows(), matrix_->cols(), matrix_->nonZeros(), matrix_->outerIndexPtr(),
             matrix_->innerIndexPtr(), matrix_->valuePtr());
  }

  Storage matrix_;
};

}  // namespace tooljoint::model
