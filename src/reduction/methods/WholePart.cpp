// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/methods/WholePart.hpp"

#include "reduction/methods/BasisBuilder.hpp"

namespace tooljoint::reduction {

Basis wholePart(const PartView& part) {
  Basis basis;
  Partition& p = basis.partition;
  p.size = part.model().size();
  p.interface = part.part().interface;
  for (int i = 0; i < p.size; ++i)
    if (!contains(p.interface, i)) p.retained.push_back(i);
  p.boundary = p.interface;
  p.boundary.insert(p.boundary.end(), p.retained.begin(), p.retained.end());
  basis.complete = true;
  basis.removable = false;
  basis.method = "none: the part is not reduced";
  addConstraintRows(part, p, Vector::Zero(p.size), basis, "the part is not reduced");
  Triplets ones;
  for (int j = 0; j < p.size; ++j) ones.emplace_back(p.boundary[at(j)], j, 1.0);
  basis.vectors = sparse(p.size, p.size, ones);
  return basis;
}

bool isWhole(const Basis& basis) {
  return basis.modes() == 0 && basis.forces() == 0 &&
         sizeOf(basis.partition.boundary) == basis.partition.size;
}

}  // namespace tooljoint::reduction
