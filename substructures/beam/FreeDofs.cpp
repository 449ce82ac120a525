// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/beam/FreeDofs.hpp"

#include "linalg/chains/ChainShare.hpp"

namespace tooljoint::beam {

FreeDofs::FreeDofs(int perNode, const std::vector<char>& held) : perNode_(perNode) {
  for (int dof = 0; dof < sizeOf(held); ++dof) {
    unknown_.push_back(held[at(dof)] != 0 ? -1 : size());
    if (held[at(dof)] == 0) dof_.push_back(dof);
  }
}

std::vector<int> FreeDofs::ofElement(int first) const {
  const auto begin = unknown_.begin() + static_cast<std::ptrdiff_t>(first) * perNode_;
  return {begin, begin + 2 * perNode_};
}

Vector FreeDofs::restrict(const Vector& full) const { return full(dof_); }

void FreeDofs::put(const Vector& x, Vector& full) const { full(dof_) = x; }

std::vector<int> FreeDofs::firstOfNodes() const {
  std::vector<int> nodes;
  for (int i = 0; i < size(); ++i) nodes.push_back(node(i));
  return linalg::firstRows(nodes);
}

}  // namespace tooljoint::beam
