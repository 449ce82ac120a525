// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

#include "common/Error.hpp"
#include "common/Text.hpp"
#include "linalg/factor/MumpsFactor.hpp"
#include "parts/file/PartFile.hpp"

namespace tooljoint::parts {

namespace {

/// A difference or a negative pivot below this relative size is rounding.
constexpr double rounding = 1e-10;

class MassCheck {
 public:
  explicit MassCheck(const PartContent& content) : content_(content), M_(content.part.model.mass) {}

  void run() const {
    symmetric();
    definite();
  }

 private:
  std::string dof(Eigen::Index i) const {
    const auto& m = content_.part.model;
    const auto& label = m.dofs[static_cast<std::size_t>(i)];
    return label.kind == model::DofLabel::Kind::Modal
               ? "mode " + std::to_string(label.component + 1)
               : model::describe(label, m.componentNames);
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw ModelError("Part \"" + content_.part.name + "\" (" + content_.file + "): its mass " +
                     what);
  }

  /// |m_ij - m_ji| <= 1e-10 sqrt(m_ii m_jj), or relative to the largest entry if a diagonal is
  /// missing
  void symmetric() const {
    const Sparse transposed = M_.transpose();
    const Sparse difference = M_ - transposed;
    const Vector diagonal = M_.diagonal().cwiseAbs();
    const double largest = M_.nonZeros() > 0 ? M_.coeffs().cwiseAbs().maxCoeff() : 0.0;
    double worst = 0.0;
    Eigen::Index row = 0, column = 0;
    for (int i = 0; i < difference.rows(); ++i)
      for (Sparse::InnerIterator it(difference, i); it; ++it) {
        const double scale = std::sqrt(diagonal[i] * diagonal[it.col()]);
        const double defect = std::abs(it.value()) / (scale > 0.0 ? scale : largest);
        if (it.value() == 0.0 || defect <= worst) continue;
        worst = defect;
        row = i;
        column = it.col();
      }
    if (worst <= rounding) return;
    fail("is not symmetric: " + formatNumber(M_.coeff(row, column)) + " in the row of " + dof(row) +
         " and the column of " + dof(column) + ", but " + formatNumber(M_.coeff(column, row)) +
         " in the transposed entry. Write equal triangles, or one triangle in a symmetric file.");
  }

  /// Checks that S M S + 1e-10 has no negative pivot; S scales the diagonal to 1.
  void definite() const {
    const Vector diagonal = M_.diagonal();
    for (Eigen::Index i = 0; i < diagonal.size(); ++i)
      if (diagonal[i] < 0.0)
        fail("is indefinite: " + formatNumber(diagonal[i]) + " on the diagonal of " + dof(i) +
             ". A mass matrix must be positive semidefinite.");
    Vector scale(diagonal.size());
    for (Eigen::Index i = 0; i < diagonal.size(); ++i)
      scale[i] = diagonal[i] > 0.0 ? 1.0 / std::sqrt(diagonal[i]) : 0.0;
    for (int i = 0; i < M_.rows(); ++i)
      for (Sparse::InnerIterator it(M_, i); it; ++it)
        if (it.value() != 0.0 && (diagonal[i] == 0.0 || diagonal[it.col()] == 0.0))
          fail("is indefinite: " + dof(diagonal[i] == 0.0 ? i : it.col()) +
               " has a zero diagonal entry, but is coupled with " +
               dof(diagonal[i] == 0.0 ? it.col() : i) + " by " + formatNumber(it.value()) + ".");
    if (linalg::suitsMumps(M_) && diagonal.minCoeff() > 0.0 && linalg::isDefinite(M_, -rounding))
      return;
    using ColumnMajor = Eigen::SparseMatrix<double>;
    ColumnMajor scaled = ColumnMajor(scale.asDiagonal() * ColumnMajor(M_) * scale.asDiagonal());
    ColumnMajor shift(scaled.rows(), scaled.cols());
    shift.setIdentity();
    scaled += rounding * shift;
    const Eigen::SimplicialLDLT<ColumnMajor> factor(scaled);
    const Vector pivots = factor.vectorD();
    Eigen::Index at = 0;
    if (factor.info() == Eigen::Success && (pivots.size() == 0 || pivots.minCoeff(&at) > 0.0))
      return;
    const auto& order = factor.permutationPinv().indices();
    fail("is indefinite: a motion that includes " + dof(order.size() > 0 ? order[at] : at) +
         " has negative kinetic energy. Check the signs of its entries.");
  }

  const PartContent& content_;
  const Sparse& M_;
};

}  // namespace

void checkMass(const PartContent& content) { MassCheck(content).run(); }

}  // namespace tooljoint::parts
