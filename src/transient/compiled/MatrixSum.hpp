// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "linalg/blocks/BlockSparse.hpp"
#include "model/SecondOrderModel.hpp"

namespace tooljoint::transient {

/// A sum of constant matrices times laws: sum_i c_i(t) C_i.
class MatrixSum {
 public:
  struct Term {
    std::string name;            ///< names of the merged terms, joined by " + "
    int law = 0;                 ///< index of the model's law
    linalg::BlockValues values;  ///< on the common pattern
    linalg::BlockProduct product;
    bool skew = false;  ///< no work (gyroscopics): x'Ax = 0 to rounding
  };

  MatrixSum() = default;
  /// \param like a product whose list of blocks is shared with the terms where possible
  MatrixSum(const std::vector<model::MatrixTerm>& terms, const std::vector<model::ScalarLaw>& laws,
            const linalg::BlockPattern& pattern, const linalg::BlockProduct& like);
  bool empty() const { return terms_.empty(); }
  /// True if the value of a law has changed. The sum is formed when the laws are constant or when
  /// it is needed; while the laws vary, products are taken term by term.
  bool update(const std::vector<double>& lawValues);
  /// State of the last update() and of the sum, for a later return. The sum is formed again if
  /// another one has replaced it.
  struct Snapshot {
    std::vector<double> last;
    bool formed = false;
  };
  void remember(Snapshot& snapshot) const { snapshot.last = last_, snapshot.formed = formed_; }
  void comeBack(const Snapshot& snapshot);
  bool isFormed() const { return formed_; }
  void setFormed(bool formed);
  /// y += factor (A(t) - A(then)) x, with `then` the law values at another time.
  void addChangeSince(const std::vector<double>& then, double factor, const double* x,
                      double* y) const;
  /// y += A(t) x for the rows of these blocks.
  void addTo(const double* x, double* y, linalg::BlockRange rows) const;
  /// values += factor * A(t).
  void combine(double factor, double* values, std::size_t storage) const;
  double entry(std::size_t address) const { return terms_.empty() ? 0.0 : current()[address]; }
  const std::vector<Term>& terms() const { return terms_; }
  /// Value of the law of a term at the time of the last update().
  double factor(std::size_t term) const { return last_[term]; }
  /// Constant and symmetric: the forces have the potential x'Ax / 2.
  bool isConservative() const { return constant_ && product_.isSymmetric(); }
  /// Contribution of the rows of some blocks to x'Ax, for a conservative A.
  double form(const double* x, linalg::BlockRange rows) const {
    return product_.form(current(), x, rows);
  }
  /// Values of A(t) on the pattern; undefined when empty().
  const double* current() const {
    if (constant_) return terms_.front().values.data();
    if (!formed_) form();
    return sum_.data();
  }

 private:
  std::vector<Term> terms_;
  std::vector<double> last_;  ///< law values at the time of the last update()
  void form() const;
  mutable linalg::BlockValues sum_;
  mutable bool formed_ = false;  ///< sum_ belongs to last_
  linalg::BlockProduct product_;
  bool constant_ = false;  ///< one term with the law 1: no sum is kept
};

}  // namespace tooljoint::transient
