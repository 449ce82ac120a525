// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/ReductionMethod.hpp"

#include <utility>

namespace tooljoint::reduction {

bool ReductionMethod::augment(const model::SecondOrderModel&, const std::vector<std::vector<int>>&,
                              const std::vector<PartView>&, std::vector<Basis>&) const {
  return false;
}

DependentCoordinates ReductionMethod::dependentCoordinates(const model::SecondOrderModel&,
                                                           const std::vector<Sparse>&,
                                                           const std::vector<PartView>&,
                                                           const std::vector<Basis>&) const {
  return {};
}

void ReductionMethod::checkInput(const std::vector<PartOutline>&) const {}

namespace {

/// Keeps the modal columns with keep[k] != 0 in Phi, eigenvalues and kinds; sets the reasons in the
/// rows of all.
void keepColumns(Basis& basis, const std::vector<char>& keep, const std::string& kept,
                 const std::string& dropped) {
  const int boundary = sizeOf(basis.partition.boundary);
  std::vector<int> columns = range(boundary), modes;
  std::vector<std::string> kinds;
  for (int k = 0; k < sizeOf(keep); ++k) {
    BasisRow& row = basis.rows[at(boundary + k)];
    row.kept = keep[at(k)] != 0;
    if (!row.kept || !kept.empty()) row.why = row.kept ? kept : dropped;
    if (!row.kept) continue;
    columns.push_back(boundary + k);
    modes.push_back(k);
    kinds.push_back(basis.modeKind[at(k)]);
  }
  basis.vectors = block(basis.vectors, range(basis.vectors.rows()), columns);
  basis.eigenvalues = Vector(basis.eigenvalues(modes));
  basis.modeKind = std::move(kinds);
}

}  // namespace

void truncate(Basis& basis, int modes, const std::string& why) {
  if (modes >= basis.modes()) return;
  std::vector<char> keep(at(basis.modes()), 0);
  std::fill_n(keep.begin(), modes, 1);
  keepColumns(basis, keep, "", why);
}

void select(Basis& basis, const std::vector<char>& keep, const std::string& kept,
            const std::string& dropped) {
  std::vector<int> order;  // of the candidates: kept ones first
  for (const char wanted : {1, 0})
    for (int k = 0; k < sizeOf(keep); ++k)
      if ((keep[at(k)] != 0) == (wanted != 0)) order.push_back(k);
  basis.candidates.head(basis.modes()) = Vector(basis.eigenvalues(order));
  keepColumns(basis, keep, kept, dropped);
}

}  // namespace tooljoint::reduction
