// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/part/ConstraintModes.hpp"

#include <string>

#include "common/Error.hpp"
#include "common/Index.hpp"
#include "common/report/StageTimes.hpp"
#include "linalg/trilinos/DirectSolver.hpp"

namespace tooljoint::reduction {

namespace {

double largest(const Sparse& A) {
  double value = 0.0;
  for (int i = 0; i < A.outerSize(); ++i) {
    double row = 0.0;
    for (Sparse::InnerIterator it(A, i); it; ++it) row += std::abs(it.value());
    value = std::max(value, row);
  }
  return value;
}

}  // namespace

ConstraintModes constraintModes(const model::Substructure& part, const Partition& p,
                                const Sparse& K) {
  const Stage stage("constraint modes");
  ConstraintModes result;
  result.residuals = Vector::Zero(static_cast<Eigen::Index>(p.kept.size()));
  for (std::size_t j = 0; j < p.kept.size(); ++j)
    result.entries.emplace_back(p.kept[j], static_cast<int>(j), 1.0);

  for (std::size_t link = 0; link < p.links.size(); ++link) {
    if (p.ends[link].empty()) continue;  // floats: no motion of a kept dof reaches it
    std::vector<int> inner;
    std::vector<int> outer;
    for (int i : p.links[link]) inner.push_back(p.interior[at(i)]);
    for (int j : p.ends[link]) outer.push_back(p.kept[at(j)]);
    const Sparse KII = block(K, inner, inner);
    const Matrix KIC = block(K, inner, outer);
    Matrix phi;
    try {
      const linalg::DirectSolver solver(KII, [&](int i) {
        return model::describe(part.model.dofs[at(inner[at(i)])], part.model.componentNames);
      });
      phi = solver.solve(-KIC);  // K_II phi_C = -K_IC
    } catch (const ModelError& error) {
      throw ModelError("Part \"" + part.name + "\": its interior is a mechanism while its " +
                       std::to_string(p.kept.size()) +
                       " interface and retained dofs are held, so it has no constraint modes. "
                       "Retain more dofs there, or cut the "
                       "part elsewhere. " +
                       error.what());
    }
    const Matrix defect = KII * phi + KIC;
    const double norm = largest(KII);
    for (std::size_t j = 0; j < outer.size(); ++j) {
      const auto column = static_cast<Eigen::Index>(j);
      const double scale =
          norm * phi.col(column).cwiseAbs().maxCoeff() + KIC.col(column).cwiseAbs().maxCoeff();
      double& residual = result.residuals[p.ends[link][j]];
      if (scale > 0.0)
        residual = std::max(residual, defect.col(column).cwiseAbs().maxCoeff() / scale);
      for (std::size_t i = 0; i < inner.size(); ++i) {
        const double value = phi(static_cast<Eigen::Index>(i), column);
        if (value != 0.0) result.entries.emplace_back(inner[i], p.ends[link][j], value);
      }
    }
  }
  return result;
}

}  // namespace tooljoint::reduction
