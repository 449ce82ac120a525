// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/project/IdenticalParts.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <utility>

namespace tooljoint::reduction {

namespace {

/// Raises size_i to the largest entry of row i.
void raiseToRows(const Sparse& a, Vector& size) {
  if (a.rows() != size.size()) return;
  for (int i = 0; i < a.outerSize(); ++i)
    for (Sparse::InnerIterator it(a, i); it; ++it)
      size[i] = std::max(size[i], std::abs(it.value()));
}

bool sameIntegers(const int* a, const int* b, Eigen::Index n) {
  return n == 0 || std::memcmp(a, b, sizeof(int) * static_cast<std::size_t>(n)) == 0;
}

/// |x_k - y_k| <= room_k for all k < n; false if one of them is not a number.
bool near(const double* x, const double* y, const double* room, Eigen::Index n) {
  for (Eigen::Index k = 0; k < n; ++k)
    if (!(std::abs(x[k] - y[k]) <= room[k])) return false;
  return true;
}

/// A matrix for comparison with others: a_ij ~ b_ij if |a_ij - b_ij| <= s_i s_j with s_i^2 =
/// Substructure::rounding r_i and the size r of the rows. This is equally strict for moments and
/// forces.
class MatrixPattern {
 public:
  MatrixPattern(const model::SharedSparse& a, Vector s) : a_(a), s_(std::move(s)) {
    if (!square(a)) return;
    room_.resize(a.nonZeros());
    for (int i = 0; i < a.outerSize(); ++i)
      for (int k = a.outerIndexPtr()[i]; k < a.outerIndexPtr()[i + 1]; ++k)
        room_[k] = s_[i] * s_[a.innerIndexPtr()[k]];
  }

  bool matches(const model::SharedSparse& b) const {
    if (!square(a_) || !square(b)) return false;
    const auto n = static_cast<int>(a_.rows());
    const int *ai = a_.outerIndexPtr(), *aj = a_.innerIndexPtr();
    const int *bi = b.outerIndexPtr(), *bj = b.innerIndexPtr();
    // Compares runs of rows with equal structure at a time: all rows, except where rounding left an
    // exact zero.
    for (int i = 0; i < n;) {
      int end = sameIntegers(ai + i, bi + i, n - i + 1) ? n : i;
      while (end < n && ai[end + 1] - ai[i] == bi[end + 1] - bi[i]) ++end;
      const bool same = end > i && sameIntegers(aj + ai[i], bj + bi[i], ai[end] - ai[i]);
      if (same &&
          !near(a_.valuePtr() + ai[i], b.valuePtr() + bi[i], room_.data() + ai[i], ai[end] - ai[i]))
        return false;
      if (!same) end = std::max(end, i + 1);
      for (; !same && i < end; ++i)
        if (!matchesRow(b, i)) return false;
      i = end;
    }
    return true;
  }

 private:
  bool square(const model::SharedSparse& m) const {
    return m.rows() == s_.size() && m.cols() == s_.size();
  }

  /// Compares a row of matrices with different structure: missing entries are 0.
  bool matchesRow(const model::SharedSparse& b, int i) const {
    model::SharedSparse::InnerIterator x(a_, i), y(b, i);
    while (x || y) {
      const Eigen::Index column = std::min(x ? x.col() : a_.cols(), y ? y.col() : b.cols());
      double difference = 0;
      if (x && x.col() == column) difference += x.value(), ++x;
      if (y && y.col() == column) difference -= y.value(), ++y;
      if (!(std::abs(difference) <= s_[i] * s_[column])) return false;
    }
    return true;
  }

  const model::SharedSparse& a_;
  Vector s_;
  Vector room_;  ///< s_i s_j of every entry
};

/// A part for comparison with others. Terms of one law are compared on a common scale: a geometric
/// stiffness that is rounding relative to the elastic one does not matter.
class Pattern {
 public:
  explicit Pattern(const model::Substructure& part) : part_(part) {
    const auto& m = part.model;
    const double same = part.rounding;
    const auto add = [&](const model::SharedSparse& matrix, const Vector& rows) {
      matrices_.emplace_back(matrix, (same * rows).cwiseSqrt());
    };
    Vector rows = Vector::Zero(m.size());
    raiseToRows(m.mass, rows);
    add(m.mass, rows);
    for (const auto* terms : {&m.stiffness, &m.damping})
      for (const auto& term : *terms) {
        rows.setZero();
        for (const auto& other : *terms)
          if (other.law == term.law) raiseToRows(other.matrix, rows);
        add(term.matrix, rows);
      }
  }

  bool matches(const model::Substructure& other) const {
    const auto& a = part_.model;
    const auto& b = other.model;
    if (a.size() != b.size() || part_.rounding != other.rounding ||
        part_.interface != other.interface || part_.retained != other.retained)
      return false;
    if (!sameTerms(a.stiffness, b.stiffness, b) || !sameTerms(a.damping, b.damping, b))
      return false;
    auto mine = matrices_.begin();
    if (!mine->matches(b.mass)) return false;
    for (const auto* terms : {&b.stiffness, &b.damping})
      for (const auto& term : *terms)
        if (!(++mine)->matches(term.matrix)) return false;
    return true;
  }

 private:
  bool sameTerms(const std::vector<model::MatrixTerm>& left,
                 const std::vector<model::MatrixTerm>& right,
                 const model::SecondOrderModel& b) const {
    if (left.size() != right.size()) return false;
    const auto& laws = part_.model.laws;
    for (std::size_t i = 0; i < left.size(); ++i) {
      const int law = left[i].law;
      if (law != right[i].law || left[i].name != right[i].name || law < 0 ||
          law >= static_cast<int>(std::min(laws.size(), b.laws.size())) ||
          laws[static_cast<std::size_t>(law)].name != b.laws[static_cast<std::size_t>(law)].name)
        return false;
    }
    return true;
  }

  const model::Substructure& part_;
  std::vector<MatrixPattern> matrices_;  ///< the mass, the stiffness terms and the damping terms
};

/// Sum of the magnitudes of the entries of all stiffness terms (of the mass, if there are none).
/// Parts whose sums differ by more than rounding are not compared further.
double signature(const model::SecondOrderModel& model) {
  const auto sum = [](const Sparse& a) {
    return a.nonZeros() > 0 ? Eigen::Map<const Vector>(a.valuePtr(), a.nonZeros()).cwiseAbs().sum()
                            : 0.0;
  };
  if (model.stiffness.empty()) return sum(model.mass);
  double total = 0;
  for (const auto& term : model.stiffness) total += sum(term.matrix);
  return total;
}

}  // namespace

std::vector<int> findIdenticalParts(const std::vector<model::Substructure>& parts,
                                    const std::vector<ModeRequest>& requests) {
  std::vector<int> representative(parts.size());
  struct First {
    std::size_t index;
    Pattern pattern;
  };
  std::multimap<double, First> firsts;  // by signature
  const First* latest = nullptr;        // the first part identical to the previous one
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const auto matches = [&](const First& first) {
      return requests[i] == requests[first.index] && first.pattern.matches(parts[i]);
    };
    if (latest == nullptr || !matches(*latest)) {
      representative[i] = static_cast<int>(i);
      const double mine = signature(parts[i].model);
      if (!std::isfinite(mine)) continue;
      const double room = 1e-8 * mine;
      auto it = firsts.lower_bound(mine - room);
      while (it != firsts.end() && it->first <= mine + room &&
             (&it->second == latest || !matches(it->second)))
        ++it;
      if (it == firsts.end() || it->first > mine + room)
        it = firsts.emplace(mine, First{i, Pattern(parts[i])});
      latest = &it->second;
    }
    representative[i] = static_cast<int>(latest->index);
  }
  return representative;
}

}  // namespace tooljoint::reduction
