// SPDX-License-Identifier: BSD-3-Clause
#include "linalg/factor/PartialFactor.hpp"

#include <algorithm>
#include <mpi.h>
#include <string>
#include <utility>
#include <vector>

#include "common/Error.hpp"
#include "common/Index.hpp"
#include "common/Interrupt.hpp"
#include "linalg/factor/FactorMemory.hpp"
#include "linalg/factor/MumpsControl.hpp"

namespace tooljoint::linalg {

using namespace mumps;

struct PartialFactor::Impl : mumps::Instance {
  int inner = 0;
  std::vector<int> rows, columns, others;  ///< indices start at 1
  std::vector<double> values;

  ~Impl() { close(); }  // while the entries exist

  /// Takes the entries of the lower triangle; true if the pattern has changed.
  bool take(const Sparse& A) {
    const std::vector<int> rowsBefore = std::move(rows), columnsBefore = std::move(columns);
    rows.clear(), columns.clear(), values.clear();
    forEachEntry(A, [&](int row, int column, double value) {
      if (column > row) return;
      rows.push_back(row + 1);
      columns.push_back(column + 1);
      values.push_back(value);
    });
    return rows != rowsBefore || columns != columnsBefore;
  }

  void release() {
    for (auto* list : {&rows, &columns}) std::vector<int>().swap(*list);
    std::vector<double>().swap(values);
  }

  [[noreturn]] void fail() const {
    if (status() == noMemory) refuseMemory(id.n, std::max(info(16), info(17)), freeMegabytes());
    throw ModelError("MUMPS could not factor a matrix of " + std::to_string(id.n) +
                     " rows: error " + std::to_string(status()) + " (" + std::to_string(info(2)) +
                     ").");
  }
};

PartialFactor::PartialFactor() : impl_(std::make_unique<Impl>()) {}
PartialFactor::~PartialFactor() = default;
PartialFactor::PartialFactor(PartialFactor&&) noexcept = default;
PartialFactor& PartialFactor::operator=(PartialFactor&&) noexcept = default;

bool PartialFactor::factor(const Sparse& A, int inner, Matrix& schur) {
  stopIfInterrupted();
  Impl& m = *impl_;
  const int rest = static_cast<int>(A.rows()) - inner;
  const bool another = m.take(A) || m.inner != inner || !m.open;
  if (another) m.begin(1, MPI_COMM_SELF);
  m.inner = inner;
  m.id.n = static_cast<MUMPS_INT>(A.rows());
  m.id.nnz = static_cast<MUMPS_INT8>(m.rows.size());
  m.id.irn = m.rows.data();
  m.id.jcn = m.columns.data();
  m.id.a = m.values.data();
  schur.setZero(rest, rest);
  if (rest > 0) {
    m.others = range(rest, inner + 1);
    m.control(19) = 1;  // the Schur complement of `others`, its lower triangle by rows
    m.id.size_schur = rest;
    m.id.listvar_schur = m.others.data();
    m.id.schur = schur.data();
  }
  if (another) {
    m.call(analyse);
    if (m.status() < 0) m.fail();
    const long needed = m.info(16);  // MB of the factorisation
    const auto most = freeMegabytes();
    if (most && needed > *most) refuseMemory(A.rows(), needed, most);
  }
  m.call(decompose);
  while ((m.status() == noRoom || m.status() == realRoom) && m.control(14) < mostRoom) {
    m.control(14) *= 2;
    m.call(decompose);
  }
  if (m.status() == singular || m.status() == notDefinite) return false;
  if (m.status() < 0) m.fail();
  if (m.info(12) > 0) return false;  // negative pivots
  if (rest == 0) m.release();        // solutions need no entries
  // by rows, so the upper triangle of a column-major matrix
  schur.triangularView<Eigen::StrictlyLower>() = schur.transpose();
  return true;
}

Matrix PartialFactor::solve(const Matrix& b) const {
  Impl& m = *impl_;
  Matrix x = Matrix::Zero(m.id.n, b.cols());
  x.topRows(m.inner) = b;
  if (b.cols() == 0) return b;
  m.id.rhs = x.data();
  m.id.nrhs = static_cast<MUMPS_INT>(x.cols());
  m.id.lrhs = static_cast<MUMPS_INT>(x.rows());
  m.control(26) = 0;  // for the inner rows
  m.call(substitute);
  if (m.status() < 0) m.fail();
  return x.topRows(m.inner);
}

long PartialFactor::entries() const {
  // INFOG(29): entries of the factors; large numbers are negative and in millions
  const long entries = impl_->info(29);
  return entries < 0 ? -1000000L * entries : entries;
}

}  // namespace tooljoint::linalg
