// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/methods/WholePart.hpp"

#include <algorithm>

namespace tooljoint::reduction {

Basis wholePart(const model::Substructure& part) {
  Basis basis;
  Partition& p = basis.partition;
  p.size = part.model.size();
  p.interface = part.interface;
  p.retained = part.interior();
  p.retained.insert(p.retained.end(), part.retained.begin(), part.retained.end());
  std::sort(p.retained.begin(), p.retained.end());
  p.kept = p.interface;
  p.kept.insert(p.kept.end(), p.retained.begin(), p.retained.end());
  basis.complete = true;
  basis.removable = false;
  basis.method = "none: the part is kept whole";
  Triplets ones;
  for (std::size_t j = 0; j < p.kept.size(); ++j) {
    ones.emplace_back(p.kept[j], static_cast<int>(j), 1.0);
    BasisRow row;
    row.kind = "constraint";
    row.name = model::describe(part.model.dofs[static_cast<std::size_t>(p.kept[j])],
                               part.model.componentNames);
    const bool retained = std::binary_search(part.retained.begin(), part.retained.end(), p.kept[j]);
    row.why = j < p.interface.size() ? "interface dof"
              : retained             ? "retained dof"
                                     : "the part is kept whole";
    basis.rows.push_back(row);
  }
  basis.vectors = Sparse(p.size, p.size);
  basis.vectors.setFromTriplets(ones.begin(), ones.end());
  return basis;
}

bool isWhole(const Basis& basis) {
  return basis.modes() == 0 && basis.forces() == 0 &&
         static_cast<int>(basis.partition.kept.size()) == basis.partition.size;
}

}  // namespace tooljoint::reduction
