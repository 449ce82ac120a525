// SPDX-License-Identifier: BSD-3-Clause
#include "transient/compiled/MatrixSum.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "common/Index.hpp"
#include "transient/Tuned.hpp"

namespace tooljoint::transient {
namespace {

bool isSkew(const Sparse& matrix) {
  const Sparse transposed = matrix.transpose();
  const Sparse sum = matrix + transposed;
  double largest = 0;
  for (int k = 0; k < matrix.outerSize(); ++k)
    for (Sparse::InnerIterator it(matrix, k); it; ++it)
      largest = std::max(largest, std::abs(it.value()));
  for (int k = 0; k < sum.outerSize(); ++k)
    for (Sparse::InnerIterator it(sum, k); it; ++it)
      if (std::abs(it.value()) > Tuned::rounding * largest) return false;
  return true;
}

}  // namespace

MatrixSum::MatrixSum(const std::vector<model::MatrixTerm>& terms,
                     const std::vector<model::ScalarLaw>& laws, const linalg::BlockPattern& pattern,
                     const linalg::BlockProduct& like) {
  std::map<std::string, std::size_t> byLaw;  // laws of the same name are the same law
  std::vector<Sparse> matrices;
  for (const auto& term : terms) {
    const auto& law = laws[at(term.law)].name;
    const auto [it, fresh] = byLaw.emplace(law, terms_.size());
    if (fresh) {
      terms_.push_back({term.name, term.law, {}, {}, false});
      matrices.push_back(term.matrix);
    } else {
      terms_[it->second].name += " + " + term.name;
      matrices[it->second] += term.matrix;
    }
  }
  std::vector<const linalg::BlockValues*> samples;
  for (std::size_t i = 0; i < terms_.size(); ++i) {
    terms_[i].values.assign(pattern.storage(), 0.0);
    pattern.add(matrices[i], 1.0, terms_[i].values);
    terms_[i].product = linalg::BlockProduct(pattern, {&terms_[i].values}, &like);
    terms_[i].skew = !pattern.cut().any(!isSkew(matrices[i]));
  }
  for (const auto& term : terms_) samples.push_back(&term.values);
  product_ = linalg::BlockProduct(pattern, samples, &like);
  constant_ = terms_.size() == 1 && laws[at(terms_[0].law)].isOne();
  if (!constant_ && !terms_.empty()) sum_.assign(pattern.storage(), 0.0);
  last_.assign(terms_.size(), std::numeric_limits<double>::quiet_NaN());
}

bool MatrixSum::update(const std::vector<double>& lawValues) {
  if (terms_.empty()) return false;
  bool changed = false;
  for (std::size_t i = 0; i < terms_.size(); ++i) {
    const double value = lawValues[at(terms_[i].law)];
    if (!(value == last_[i])) changed = true;
    last_[i] = value;
  }
  if (changed)
    formed_ = false;
  else if (!constant_ && !formed_)
    form();
  return changed;
}

void MatrixSum::comeBack(const Snapshot& snapshot) {
  const bool still = formed_ && last_ == snapshot.last;
  last_ = snapshot.last;
  formed_ = snapshot.formed;
  if (formed_ && !still) form();
}

void MatrixSum::setFormed(bool formed) {
  if (formed && !formed_ && !constant_ && !terms_.empty()) form();
  formed_ = formed;
}

/// A = sum_i c_i A_i: the first term is assigned, terms with zero law are skipped.
void MatrixSum::form() const {
  const std::size_t n = sum_.size();
  double* sum = sum_.data();
  bool assigned = false;
  for (std::size_t i = 0; i < terms_.size(); ++i) {
    const double c = last_[i];
    const double* values = terms_[i].values.data();
    if (c == 0.0) continue;
    if (!assigned)
      for (std::size_t k = 0; k < n; ++k) sum[k] = c * values[k];
    else
      for (std::size_t k = 0; k < n; ++k) sum[k] += c * values[k];
    assigned = true;
  }
  if (!assigned) std::fill(sum_.begin(), sum_.end(), 0.0);
  formed_ = true;
}

void MatrixSum::addTo(const double* x, double* y, linalg::BlockRange rows) const {
  if (terms_.empty()) return;
  if (constant_ || formed_) {
    product_.addTo(current(), x, y, 1.0, rows);
    return;
  }
  for (std::size_t i = 0; i < terms_.size(); ++i)
    if (last_[i] != 0.0) terms_[i].product.addTo(terms_[i].values.data(), x, y, last_[i], rows);
}

void MatrixSum::addChangeSince(const std::vector<double>& then, double factor, const double* x,
                               double* y) const {
  for (std::size_t i = 0; i < terms_.size(); ++i) {
    const double difference = factor * (last_[i] - then[at(terms_[i].law)]);
    if (difference != 0.0) terms_[i].product.addTo(terms_[i].values.data(), x, y, difference);
  }
}

void MatrixSum::combine(double factor, double* values, std::size_t storage) const {
  if (terms_.empty()) return;
  const double* mine = current();
  for (std::size_t k = 0; k < storage; ++k) values[k] += factor * mine[k];
}

}  // namespace tooljoint::transient
