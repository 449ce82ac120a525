// SPDX-License-Identifier: BSD-3-Clause
#include "coupling/CoupledModes.hpp"

#include "linalg/SemidefiniteModes.hpp"
#include "reduction/Partition.hpp"

namespace tooljoint::coupling {

linalg::EigenPairs lowestModes(const model::SecondOrderModel& model, int count) {
  const Sparse K = reduction::symmetricPart(model.stiffnessAt(0.0) + model.pointStiffness(0.0, model.initialDisplacement, model.initialVelocity));
  const Sparse M = reduction::symmetricPart(model.mass);
  linalg::EigenOptions options;
  options.name = [&](int i) { return model::describe(model.dofs[static_cast<std::size_t>(i)], model.componentNames); };
  const Vector diagonal = M.diagonal();
  bool singular = false;
  for (std::size_t i = 0; i < model.dofs.size(); ++i) singular = singular || model.dofs[i].force != 0 || diagonal[static_cast<Eigen::Index>(i)] == 0.0;
  return singular ? linalg::semidefiniteModes(K, M, count, options) : linalg::lowestModes(K, M, count, options);
}

}  // namespace tooljoint::coupling
