// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Positions of the dofs named by connections.
#pragma once

#include <string>
#include <vector>

#include "coupling/assembly/AlignedParts.hpp"
#include "coupling/input/Connections.hpp"

namespace tooljoint::coupling {

/// A coordinate of an aligned part.
struct DofPosition {
  int part = 0;
  int dof = 0;
};

class DofLookup {
 public:
  explicit DofLookup(const std::vector<AlignedPart>& alignedParts);

  /// Positions of the dof: one, or all of them when no part is named. `who` begins messages: `The
  /// constraint "a"`. ModelError: unknown part (with a suggestion), component or node, an interior
  /// dof of a reduced part, or a dof that a frame cannot rotate.
  std::vector<DofPosition> find(const PartDof& dof, const std::string& who) const;
  /// The dof for messages, with the node number of the user: `u of node 4 of part "beam"`.
  std::string describe(const PartDof& dof) const;
  const model::ComponentNames& names() const { return alignedParts_.front().model->componentNames; }

 private:
  int component(const std::string& name, const std::string& who) const;
  bool hasNode(int part, std::int64_t node) const;

  const std::vector<AlignedPart>& alignedParts_;
};

/// Names of parts of any kind.
template <class Parts>
std::vector<std::string> namesOf(const Parts& parts) {
  std::vector<std::string> names;
  for (const auto& part : parts) names.push_back(part.name);
  return names;
}

/// ` names part "pip", but no part has this name. Did you mean "pipe"?`
std::string noSuchPart(const std::string& name, const std::vector<std::string>& names);

/// Index of `name` among `names`. ModelError if it is not among them; `who` begins the message.
int partNumber(const std::vector<std::string>& names, const std::string& name,
               const std::string& who);

/// `u of node 4 of part "beam"`.
std::string describe(const PartDof& dof);

}  // namespace tooljoint::coupling
