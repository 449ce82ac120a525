// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/Distribution.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <numeric>
#include <type_traits>

#include "common/Error.hpp"

namespace tooljoint::reduction {

namespace {

/// Writes values to bytes; `archive & value` is the same statement for writing and reading.
class Writer {
 public:
  static constexpr bool writing = true;
  void raw(const void* data, std::size_t size) { bytes.append(static_cast<const char*>(data), size); }
  std::string bytes;
};

class Reader {
 public:
  static constexpr bool writing = false;
  explicit Reader(const std::string& source) : bytes_(source) {}
  void raw(void* data, std::size_t size) {
    if (position_ + size > bytes_.size()) throw Error(ExitCode::Internal, "A reduced part arrived incomplete from another rank.");
    if (size > 0) std::memcpy(data, bytes_.data() + position_, size);
    position_ += size;
  }
  bool atEnd() const { return position_ == bytes_.size(); }

 private:
  const std::string& bytes_;
  std::size_t position_ = 0;
};

template <class Archive, class T>
std::enable_if_t<std::is_arithmetic_v<T>> travel(Archive& archive, T& value) {
  archive.raw(&value, sizeof value);
}

template <class Archive, class Container>
void travelSize(Archive& archive, Container& container) {
  std::uint64_t size = container.size();
  travel(archive, size);
  if constexpr (!Archive::writing) container.resize(size);
}

template <class Archive>
void travel(Archive& archive, std::string& text) {
  travelSize(archive, text);
  archive.raw(text.data(), text.size());
}

template <class Archive>
void travel(Archive& archive, Vector& vector) {
  std::int64_t size = vector.size();
  travel(archive, size);
  if constexpr (!Archive::writing) vector.resize(size);
  archive.raw(vector.data(), sizeof(double) * static_cast<std::size_t>(size));
}

template <class Archive>
void travel(Archive& archive, Sparse& matrix) {
  if constexpr (Archive::writing) matrix.makeCompressed();
  std::int64_t sizes[3] = {matrix.rows(), matrix.cols(), matrix.nonZeros()};
  archive.raw(sizes, sizeof sizes);
  if constexpr (!Archive::writing) {
    matrix.resize(sizes[0], sizes[1]);
    matrix.resizeNonZeros(sizes[2]);
  }
  archive.raw(matrix.outerIndexPtr(), sizeof(int) * static_cast<std::size_t>(sizes[0] + 1));
  archive.raw(matrix.innerIndexPtr(), sizeof(int) * static_cast<std::size_t>(sizes[2]));
  archive.raw(matrix.valuePtr(), sizeof(double) * static_cast<std::size_t>(sizes[2]));
}

template <class Archive, class T>
void travel(Archive& archive, std::vector<T>& values);

template <class Archive>
void travel(Archive& archive, BasisRow& row) {
  travel(archive, row.kind);
  travel(archive, row.name);
  travel(archive, row.eigenvalue);
  travel(archive, row.residual);
  travel(archive, row.kept);
  travel(archive, row.why);
}

template <class Archive>
void travel(Archive& archive, model::MatrixTerm& term) {
  travel(archive, term.name);
  travel(archive, term.matrix);
  travel(archive, term.law);
}

template <class Archive, class T>
void travel(Archive& archive, std::vector<T>& values) {
  travelSize(archive, values);
  for (auto& value : values) travel(archive, value);
}

template <class Archive>
void travel(Archive& archive, Partition& p) {
  travel(archive, p.size);
  travel(archive, p.interface);
  travel(archive, p.retained);
  travel(archive, p.kept);
  travel(archive, p.interior);
  travel(archive, p.links);
  travel(archive, p.ends);
}

template <class Archive>
void travel(Archive& archive, BasisResult& basis) {
  travel(archive, basis.partition);
  travel(archive, basis.vectors);
  travel(archive, basis.modeKind);
  travel(archive, basis.eigenvalues);
  travel(archive, basis.candidates);
  travel(archive, basis.complete);
  travel(archive, basis.orthonormal);
  travel(archive, basis.removable);
  travel(archive, basis.inertial);
  travel(archive, basis.boundary);
  travel(archive, basis.rows);
  travel(archive, basis.orthogonality);
  travel(archive, basis.method);
  travel(archive, basis.remarks);
}

template <class Archive>
void travel(Archive& archive, ProjectedMatrices& matrices) {
  travel(archive, matrices.mass);
  travel(archive, matrices.damping);
  travel(archive, matrices.stiffness);
  travel(archive, matrices.constantStiffness);
  travel(archive, matrices.massDefect);
  travel(archive, matrices.stiffnessDefect);
  travel(archive, matrices.structureEnforced);
}

template <class Archive>
void travel(Archive& archive, BasisReport& report) {
  for (auto* text : {&report.part, &report.basis, &report.method, &report.sharedWith}) travel(archive, *text);
  for (auto* number : {&report.interface, &report.retained, &report.interior, &report.modes, &report.negativeModes, &report.rank,
                       &report.zeroEnergyFull, &report.zeroEnergyReduced})
    travel(archive, *number);
  for (auto* number : {&report.orthogonality, &report.massDefect, &report.stiffnessDefect, &report.conditioning,
                       &report.staticDefect, &report.largestOmega, &report.explicitStep, &report.initialStateDefect})
    travel(archive, *number);
  travel(archive, report.structureEnforced);
  travel(archive, report.checked);
  std::vector<BasisRow> rows;
  if constexpr (Archive::writing) rows = *report.rows;
  travel(archive, rows);
  if constexpr (!Archive::writing) report.rows = std::make_shared<const std::vector<BasisRow>>(std::move(rows));
  travel(archive, report.remarks);
}

/// Relative difference of two parts up to which they are the same part: lengths that are differences of depths of some kilometres
/// carry 1e-13, their cube as stiffness somewhat more.
constexpr double sameEntry = 1e-11;

/// Raises size_i to the largest entry of row i.
void raiseToRows(const Sparse& a, Vector& size) {
  if (a.rows() != size.size()) return;
  for (int i = 0; i < a.outerSize(); ++i)
    for (Sparse::InnerIterator it(a, i); it; ++it) size[i] = std::max(size[i], std::abs(it.value()));
}

/// One row of two matrices whose patterns differ there.
bool equalRow(const Sparse& a, const Sparse& b, int i, const Vector& s) {
  Sparse::InnerIterator x(a, i), y(b, i);
  while (x || y) {
    const Eigen::Index column = std::min(x ? x.col() : a.cols(), y ? y.col() : a.cols());
    double difference = 0;
    if (x && x.col() == column) difference += x.value(), ++x;
    if (y && y.col() == column) difference -= y.value(), ++y;
    if (!(std::abs(difference) <= s[i] * s[column])) return false;
  }
  return true;
}

/// |a_ij - b_ij| <= s_i s_j with s_i^2 = sameEntry r_i, r the size of the rows: as strict for moments as for forces.
bool equal(const Sparse& a, const Sparse& b, const Vector& s) {
  if (a.rows() != s.size() || b.rows() != a.rows() || a.cols() != a.rows() || b.cols() != b.rows()) return false;
  if (!a.isCompressed() || !b.isCompressed()) {
    for (int i = 0; i < a.rows(); ++i)
      if (!equalRow(a, b, i, s)) return false;
    return true;
  }
  const int* ai = a.outerIndexPtr();
  const int* bi = b.outerIndexPtr();
  for (int i = 0; i < a.rows(); ++i) {
    const int width = ai[i + 1] - ai[i];
    const int* column = a.innerIndexPtr() + ai[i];
    if (bi[i + 1] - bi[i] != width || !std::equal(column, column + width, b.innerIndexPtr() + bi[i])) {
      if (!equalRow(a, b, i, s)) return false;
      continue;
    }
    const double* x = a.valuePtr() + ai[i];
    const double* y = b.valuePtr() + bi[i];
    bool near = true;
    for (int k = 0; k < width; ++k) near = near & (std::abs(x[k] - y[k]) <= s[i] * s[column[k]]);
    if (!near) return false;
  }
  return true;
}

/// A part others are compared with, and the sizes s of the rows of its matrices. Terms of one law are measured together: a geometric
/// stiffness that is rounding beside the elastic one is rounding.
class Pattern {
 public:
  explicit Pattern(const model::Substructure& part) : part_(part) {
    const auto& m = part.model;
    sizes_.assign(1, Vector::Zero(m.size()));
    raiseToRows(m.mass, sizes_[0]);
    for (const auto* terms : {&m.stiffness, &m.damping})
      for (const auto& term : *terms) {
        sizes_.push_back(Vector::Zero(m.size()));
        for (const auto& other : *terms)
          if (other.law == term.law) raiseToRows(other.matrix, sizes_.back());
      }
    for (auto& size : sizes_) size = (sameEntry * size).cwiseSqrt();
  }

  bool matches(const model::Substructure& other) const {
    const auto& a = part_.model;
    const auto& b = other.model;
    if (a.size() != b.size() || part_.interface != other.interface || part_.retained != other.retained) return false;
    if (!sameTerms(a.stiffness, b.stiffness, b) || !sameTerms(a.damping, b.damping, b) || !equal(a.mass, b.mass, sizes_[0])) return false;
    auto size = sizes_.begin();
    for (std::size_t i = 0; i < a.stiffness.size(); ++i)
      if (!equal(a.stiffness[i].matrix, b.stiffness[i].matrix, *++size)) return false;
    for (std::size_t i = 0; i < a.damping.size(); ++i)
      if (!equal(a.damping[i].matrix, b.damping[i].matrix, *++size)) return false;
    return true;
  }

 private:
  bool sameTerms(const std::vector<model::MatrixTerm>& left, const std::vector<model::MatrixTerm>& right,
                 const model::SecondOrderModel& b) const {
    if (left.size() != right.size()) return false;
    const auto& laws = part_.model.laws;
    for (std::size_t i = 0; i < left.size(); ++i) {
      const int law = left[i].law;
      if (law != right[i].law || left[i].name != right[i].name || law < 0 || law >= static_cast<int>(std::min(laws.size(), b.laws.size())) ||
          laws[static_cast<std::size_t>(law)].name != b.laws[static_cast<std::size_t>(law)].name)
        return false;
    }
    return true;
  }

  const model::Substructure& part_;
  std::vector<Vector> sizes_;  ///< of the mass, the stiffness terms and the damping terms
};

/// Sum of the sizes of the entries of all stiffness terms (of the mass, without any): what differs here by more than rounding is not
/// looked at any closer.
double signature(const model::SecondOrderModel& model) {
  const auto sum = [](const Sparse& a) { return a.nonZeros() > 0 ? Eigen::Map<const Vector>(a.valuePtr(), a.nonZeros()).cwiseAbs().sum() : 0.0; };
  if (model.stiffness.empty()) return sum(model.mass);
  double total = 0;
  for (const auto& term : model.stiffness) total += sum(term.matrix);
  return total;
}

}  // namespace

std::vector<int> assignOwners(const std::vector<int>& weights, int ranks) {
  std::vector<int> order(weights.size());
  std::iota(order.begin(), order.end(), 0);
  const auto weight = [&](int i) { return weights[static_cast<std::size_t>(i)]; };
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return weight(a) > weight(b); });
  std::vector<double> load(static_cast<std::size_t>(ranks), 0.0);
  std::vector<int> owner(weights.size(), 0);
  for (int part : order) {
    const auto least = std::min_element(load.begin(), load.end());
    owner[static_cast<std::size_t>(part)] = static_cast<int>(least - load.begin());
    *least += 1.0 + weight(part);
  }
  return owner;
}

std::vector<int> findTwins(const std::vector<model::Substructure>& parts, const std::vector<ModeRequest>& requests) {
  // By increasing signature: a part is compared with the first ones of its own size only, however many different ones there are.
  std::vector<int> twin(parts.size());
  struct First {
    std::size_t index;
    Pattern pattern;
  };
  std::multimap<double, First> firsts;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    twin[i] = static_cast<int>(i);
    const double mine = signature(parts[i].model);
    if (!std::isfinite(mine)) continue;
    const double room = 1e-8 * mine;
    for (auto it = firsts.lower_bound(mine - room); it != firsts.end() && it->first <= mine + room; ++it) {
      if (!(requests[i] == requests[it->second.index]) || !it->second.pattern.matches(parts[i])) continue;
      twin[i] = static_cast<int>(it->second.index);
      break;
    }
    if (twin[i] == static_cast<int>(i)) firsts.emplace(mine, First{i, Pattern(parts[i])});
  }
  return twin;
}

std::string pack(const ReducedCore& core) {
  Writer writer;
  ReducedCore copy = core;  // travel() takes references that reading changes
  travel(writer, copy.basis);
  travel(writer, copy.matrices);
  travel(writer, copy.report);
  return writer.bytes;
}

ReducedCore unpack(const std::string& bytes) {
  Reader reader(bytes);
  ReducedCore core;
  travel(reader, core.basis);
  travel(reader, core.matrices);
  travel(reader, core.report);
  if (!reader.atEnd()) throw Error(ExitCode::Internal, "A reduced part arrived with bytes that do not belong to it.");
  return core;
}

}  // namespace tooljoint::reduction
