// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/methods/ReductionMethod.hpp"

namespace tooljoint::reduction {

bool ReductionMethod::augment(const model::SecondOrderModel&, const std::vector<std::vector<int>>&,
                              const std::vector<model::Substructure>&, std::vector<Basis>&) const {
  return false;
}

DependentCoordinates ReductionMethod::dependentCoordinates(const model::SecondOrderModel&,
                                                           const std::vector<Sparse>&,
                                                           const std::vector<model::Substructure>&,
                                                           const std::vector<Basis>&) const {
  return {};
}

void ReductionMethod::checkInput(const std::vector<PartOutline>&) const {}

void truncate(Basis& basis, int modes, const std::string& why) {
  const int before = basis.modes();
  if (modes >= before) return;
  const auto keptColumns = static_cast<Eigen::Index>(basis.partition.kept.size());
  const Sparse::Index columns = static_cast<Sparse::Index>(keptColumns) + modes;
  Triplets entries;
  for (int i = 0; i < basis.vectors.outerSize(); ++i)
    for (Sparse::InnerIterator it(basis.vectors, i); it; ++it)
      if (it.col() < columns) entries.emplace_back(i, static_cast<int>(it.col()), it.value());
  basis.vectors = Sparse(basis.vectors.rows(), columns);
  basis.vectors.setFromTriplets(entries.begin(), entries.end());
  basis.eigenvalues.conservativeResize(modes);
  basis.modeKind.resize(static_cast<std::size_t>(modes));
  for (int k = modes; k < before; ++k) {
    auto& row = basis.rows[static_cast<std::size_t>(keptColumns + k)];
    row.kept = false;
    row.why = why;
  }
}

void select(Basis& basis, const std::vector<char>& keep, const std::string& kept,
            const std::string& dropped) {
  const auto constraints = static_cast<int>(basis.partition.kept.size());
  std::vector<int> column(static_cast<std::size_t>(basis.vectors.cols()), -1);
  int next = 0;
  for (std::size_t j = 0; j < column.size(); ++j)
    if (static_cast<int>(j) < constraints || keep[j - static_cast<std::size_t>(constraints)])
      column[j] = next++;
  Triplets entries;
  for (int i = 0; i < basis.vectors.outerSize(); ++i)
    for (Sparse::InnerIterator it(basis.vectors, i); it; ++it)
      if (column[static_cast<std::size_t>(it.col())] >= 0)
        entries.emplace_back(i, column[static_cast<std::size_t>(it.col())], it.value());
  const Eigen::Index rows = basis.vectors.rows();
  basis.vectors = Sparse(rows, next);
  basis.vectors.setFromTriplets(entries.begin(), entries.end());

  Vector eigenvalues(next - constraints);
  std::vector<std::string> kinds;
  std::vector<double> left;
  for (std::size_t k = 0; k < keep.size(); ++k) {
    BasisRow& row = basis.rows[static_cast<std::size_t>(constraints) + k];
    const double value = basis.eigenvalues[static_cast<Eigen::Index>(k)];
    row.kept = keep[k] != 0;
    row.why = row.kept ? kept : dropped;
    if (!row.kept) {
      left.push_back(value);
      continue;
    }
    eigenvalues[static_cast<Eigen::Index>(kinds.size())] = value;
    kinds.push_back(basis.modeKind[k]);
  }
  const auto modes = static_cast<Eigen::Index>(keep.size());
  for (Eigen::Index k = 0; k < eigenvalues.size(); ++k) basis.candidates[k] = eigenvalues[k];
  for (std::size_t k = 0;
       k < left.size() && static_cast<Eigen::Index>(k) + eigenvalues.size() < modes; ++k)
    basis.candidates[eigenvalues.size() + static_cast<Eigen::Index>(k)] = left[k];
  basis.eigenvalues = eigenvalues;
  basis.modeKind = kinds;
}

}  // namespace tooljoint::reduction
