// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/Basis.hpp"

namespace tooljoint::reduction {

bool Basis::improve(const model::SecondOrderModel&, const std::vector<std::vector<int>>&, const std::vector<model::Substructure>&,
                    std::vector<BasisResult>&) const {
  return false;
}

void truncate(BasisResult& basis, int modes, const std::string& why) {
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

}  // namespace tooljoint::reduction
