// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Names of the dofs of a model, for messages and tables.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "common/Index.hpp"
#include "model/SecondOrderModel.hpp"

namespace tooljoint::model {

/// "theta_z of node 17": dof i of the model.
inline std::string dofName(const SecondOrderModel& model, Eigen::Index i) {
  return describe(model.dofs[at(i)], model.componentNames, model.nodeName);
}

/// Names of the dofs at these positions (of all dofs), for solvers; the model must outlive it.
inline std::function<std::string(int)> namer(const SecondOrderModel& model,
                                             std::vector<int> positions) {
  return [&model, positions = std::move(positions)](int i) {
    return dofName(model, positions[at(i)]);
  };
}
inline std::function<std::string(int)> namer(const SecondOrderModel& model) {
  return [&model](int i) { return dofName(model, i); };
}

}  // namespace tooljoint::model
