// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/project/Distribution.hpp"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <type_traits>

#include "common/Error.hpp"

namespace tooljoint::reduction {

namespace {

/// Writes values to bytes; `archive & value` is the same statement for writing and reading.
class Writer {
 public:
  static constexpr bool writing = true;
  void raw(const void* data, std::size_t size) {
    bytes.append(static_cast<const char*>(data), size);
  }
  std::string bytes;
};

class Reader {
 public:
  static constexpr bool writing = false;
  explicit Reader(const std::string& source) : bytes_(source) {}
  void raw(void* data, std::size_t size) {
    if (position_ + size > bytes_.size())
      throw Error(ExitCode::Internal, "A reduced part arrived incomplete from another rank.");
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

template <class Archive>
void travel(Archive& archive, model::SharedSparse& shared) {
  Sparse matrix = shared;
  travel(archive, matrix);
  if constexpr (!Archive::writing) shared = std::move(matrix);
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

template <class Archive, class T>
void travel(Archive& archive, model::SharedList<T>& list) {
  travel(archive, list.own());
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
void travel(Archive& archive, Basis& basis) {
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
  for (auto* text : {&report.part, &report.basis, &report.method, &report.sharedWith})
    travel(archive, *text);
  for (auto* number :
       {&report.interface, &report.retained, &report.interior, &report.modes, &report.negativeModes,
        &report.rank, &report.zeroEnergyFull, &report.zeroEnergyReduced})
    travel(archive, *number);
  for (auto* number : {&report.orthogonality, &report.massDefect, &report.stiffnessDefect,
                       &report.conditioning, &report.staticDefect, &report.largestOmega,
                       &report.explicitStep, &report.initialStateDefect})
    travel(archive, *number);
  travel(archive, report.structureEnforced);
  travel(archive, report.checked);
  std::vector<BasisRow> rows;
  if constexpr (Archive::writing) rows = *report.rows;
  travel(archive, rows);
  if constexpr (!Archive::writing)
    report.rows = std::make_shared<const std::vector<BasisRow>>(std::move(rows));
  travel(archive, report.remarks);
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
  if (!reader.atEnd())
    throw Error(ExitCode::Internal, "A reduced part arrived with bytes that do not belong to it.");
  return core;
}

}  // namespace tooljoint::reduction
