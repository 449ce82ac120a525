// SPDX-License-Identifier: BSD-3-Clause
#include "linalg/factor/MumpsFactor.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <mpi.h>
#include <optional>
#include <string>
#include <vector>

#include "common/Communicator.hpp"
#include "common/Error.hpp"
#include "common/Index.hpp"
#include "linalg/factor/FactorMemory.hpp"
#include "linalg/factor/MumpsControl.hpp"

namespace tooljoint::linalg {

namespace {

/// With fewer rows KLU2 is as fast for solids: 0.1 s.
constexpr int fewRows = 2000;
/// Entries in a row of a string: its node and two neighbours, six dofs each. Solids have 81.
constexpr int entriesOfAString = 18;
using namespace mumps;

}  // namespace

struct MumpsFactor::Impl : mumps::Instance {
  bool factored = false;
  Symmetry symmetry = Symmetry::None;
  std::vector<int> rows, columns;  ///< of the analysed entries, starting at 1
  std::optional<long> memory;      ///< given limit [MB] instead of free memory
  MPI_Comm comm = MPI_COMM_SELF;

  ~Impl() { close(); }  // while the entries exist

  bool divided() const { return comm != MPI_COMM_SELF; }

  /// Available memory of the rank with the least [MB], if ranks on one machine share its memory.
  std::optional<long> available() const {
    auto megabytes = memory ? memory : freeMegabytes();
    if (!divided()) return megabytes;
    MPI_Comm machine = MPI_COMM_NULL;
    MPI_Comm_split_type(comm, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
    int beside = 1;
    MPI_Comm_size(machine, &beside);
    MPI_Comm_free(&machine);
    constexpr long unknown = std::numeric_limits<long>::max();
    long least = megabytes ? *megabytes / beside : unknown;
    MPI_Allreduce(MPI_IN_PLACE, &least, 1, MPI_LONG, MPI_MIN, comm);
    return least == unknown ? std::nullopt : std::optional(least);
  }

  void start(Symmetry kind) {
    factored = false;
    symmetry = kind;
    begin(kind == Symmetry::None ? 0 : kind == Symmetry::Definite ? 1 : 2, comm);
  }

  /// visit(row, column, value) for the entries that MUMPS reads: the lower triangle of a symmetric
  /// A.
  template <class Visit>
  void forEachRead(const Sparse& A, const Visit& visit) const {
    const bool half = symmetry != Symmetry::None;
    forEachEntry(A, [&](int row, int column, double value) {
      if (!half || column <= row) visit(row, column, value);
    });
  }

  bool samePattern(const Sparse& A) const {
    if (id.n != A.rows()) return false;
    std::size_t k = 0;
    bool same = true;
    forEachRead(A, [&](int row, int column, double) {
      same = same && k < rows.size() && rows[k] == row + 1 && columns[k] == column + 1;
      ++k;
    });
    return same && k == rows.size();
  }

  void takePattern(const Sparse& A) {
    std::size_t count = 0;
    forEachRead(A, [&](int, int, double) { ++count; });
    rows.clear(), columns.clear();
    rows.reserve(count), columns.reserve(count);
    forEachRead(A, [&](int row, int column, double) {
      rows.push_back(row + 1);
      columns.push_back(column + 1);
    });
    id.n = static_cast<MUMPS_INT>(A.rows());
    id.nnz = static_cast<MUMPS_INT8>(rows.size());
    id.irn = rows.data();
    id.jcn = columns.data();
  }

  [[noreturn]] void fail() const {
    if (status() == noMemory)
      refuseMemory(id.n, std::max(info(16), info(17)), available(), divided());
    throw ModelError("MUMPS could not factor a matrix of " + std::to_string(id.n) +
                     " rows: error " + std::to_string(status()) + " (" + std::to_string(info(2)) +
                     ").");
  }

  void analysePattern(const Sparse& A) {
    takePattern(A);
    call(analyse);
    if (status() < 0) fail();
    const long needed = info(16);  // INFOG(16): MB of the factorisation
    const auto most = available();
    if (most && needed > *most) refuseMemory(A.rows(), needed, most, divided());
  }

  /// Increases the memory for pivots if the analysis did not foresee them. MUMPS does not read the
  /// entries again.
  void decomposeEntries(const Sparse& A) {
    std::vector<double> values;
    values.reserve(rows.size());
    forEachRead(A, [&](int, int, double value) { values.push_back(value); });
    id.a = values.data();
    call(decompose);
    while ((status() == noRoom || status() == realRoom) && control(14) < mostRoom) {
      control(14) *= 2;
      call(decompose);
    }
    id.a = nullptr;
  }
};

MumpsFactor::MumpsFactor(std::optional<long> memory, parallel::Ranks ranks)
    : impl_(std::make_unique<Impl>()) {
  impl_->memory = memory;
  if (ranks == parallel::Ranks::All && parallel::size() > 1) impl_->comm = parallel::communicator();
}
MumpsFactor::~MumpsFactor() = default;
MumpsFactor::MumpsFactor(MumpsFactor&&) noexcept = default;
MumpsFactor& MumpsFactor::operator=(MumpsFactor&&) noexcept = default;

bool MumpsFactor::factor(const Sparse& A, Symmetry symmetry) {
  Impl& m = *impl_;
  const bool known = m.open && m.symmetry == symmetry && m.samePattern(A);
  if (!known) m.start(symmetry);
  m.factored = false;
  if (!known) m.analysePattern(A);
  m.decomposeEntries(A);
  if (m.status() == singular || m.status() == notDefinite) return false;
  if (m.status() < 0) m.fail();
  if (symmetry == Symmetry::Definite && m.info(12) > 0) return false;  // negative pivots
  m.factored = true;
  return true;
}

Matrix MumpsFactor::solve(const Matrix& b) const {
  Impl& m = *impl_;
  Matrix x = b;  // read and written on the first rank
  m.id.rhs = x.data();
  m.id.nrhs = static_cast<MUMPS_INT>(x.cols());
  m.id.lrhs = static_cast<MUMPS_INT>(x.rows());
  m.call(substitute);
  if (m.status() < 0) m.fail();
  if (m.divided())
    for (Eigen::Index j = 0; j < x.cols(); ++j)
      MPI_Bcast(x.col(j).data(), static_cast<int>(x.rows()), MPI_DOUBLE, 0, m.comm);
  return x;
}

long MumpsFactor::entries() const {
  // INFOG(29): entries of the factors; large numbers are negative and in millions
  const long entries = impl_->info(29);
  return entries < 0 ? -1000000L * entries : entries;
}

std::optional<int> MumpsFactor::negativePivots() const {
  if (!impl_->factored || impl_->symmetry == Symmetry::None) return {};
  return impl_->info(12);
}

bool suitsMumps(const Sparse& A) {
  return A.rows() >= fewRows && A.nonZeros() > entriesOfAString * A.rows();
}

bool isDefinite(const Sparse& A, double tolerance) {
  Sparse lowered = withoutZeros(A);  // masses often couple each direction only with itself
  for (int i = 0; i < A.rows(); ++i) lowered.coeffRef(i, i) *= 1.0 - tolerance;
  return MumpsFactor().factor(lowered, MumpsFactor::Symmetry::Definite);
}

}  // namespace tooljoint::linalg
