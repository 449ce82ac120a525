// SPDX-License-Identifier: BSD-3-Clause
#include "coupling/CoupledModes.hpp"

#include <algorithm>
#include <vector>

#include "common/report/StageTimes.hpp"
#include "linalg/SparseProducts.hpp"
#include "linalg/trilinos/EigenChecks.hpp"
#include "linalg/trilinos/SemidefiniteModes.hpp"
#include "model/DofNames.hpp"
#include "model/laws/Friction.hpp"
#include "reduction/part/Partition.hpp"

namespace tooljoint::coupling {

namespace {

bool forcesHaveMass(const model::SecondOrderModel& model) {
  const Vector mass = model.mass.diagonal();
  for (std::size_t i = 0; i < model.dofs.size(); ++i)
    if (model.dofs[i].force != 0 && mass[static_cast<Eigen::Index>(i)] != 0.0) return true;
  return false;
}

}  // namespace

Sparse normalStiffness(const model::SecondOrderModel& model, std::size_t first) {
  model::SecondOrderModel smooth;
  smooth.mass = Sparse(model.size(), model.size());
  smooth.points.assign(model.points.begin() + static_cast<std::ptrdiff_t>(first),
                       model.points.end());
  for (auto& set : smooth.points) set.law = model::withoutFriction(set.law);
  return reduction::symmetricPart(
      smooth.pointStiffness(0.0, model.initialDisplacement, model.initialVelocity));
}

model::SharedSparse undampedStiffness(const model::SecondOrderModel& model) {
  if (model.points.empty() && model.stiffness.size() == 1) {
    const auto& only = model.stiffness.front();
    if (model.laws[static_cast<std::size_t>(only.law)].isOne() &&
        linalg::isExactlySymmetric(only.matrix))
      return only.matrix;
  }
  return reduction::symmetricPart(model.stiffnessAt(0.0)) + normalStiffness(model);
}

linalg::EigenPairs lowestModes(const model::SecondOrderModel& model, int count) {
  const Stage stage("undamped modes");
  const model::SharedSparse K = undampedStiffness(model);
  const Sparse M = reduction::symmetricPart(model.mass);
  linalg::EigenOptions options;
  options.name = model::namer(model);
  return linalg::hasSingularMass(M)
             ? linalg::semidefiniteModes(K, M, count < model.size() ? count : -1, options)
             : linalg::lowestModes(K, M, count, options);
}

std::vector<char> spuriousShapes(const model::SecondOrderModel& model,
                                 const Eigen::MatrixXcd& shapes) {
  std::vector<char> spurious(static_cast<std::size_t>(shapes.cols()), 0);
  if (!forcesHaveMass(model)) return spurious;
  Vector ofForces(model.size());
  for (std::size_t i = 0; i < model.dofs.size(); ++i)
    ofForces[static_cast<Eigen::Index>(i)] = model.dofs[i].force != 0 ? 1.0 : 0.0;
  const Sparse M = reduction::symmetricPart(model.mass);
  for (Eigen::Index j = 0; j < shapes.cols(); ++j) {
    double all = 0, forces = 0;
    for (const Vector& x : {Vector(shapes.col(j).real()), Vector(shapes.col(j).imag())}) {
      const Vector Mx = M * x;
      all += x.dot(Mx);
      forces += x.dot(ofForces.cwiseProduct(Mx));
    }
    spurious[static_cast<std::size_t>(j)] = forces > 0.5 * all ? 1 : 0;
  }
  return spurious;
}

linalg::EigenPairs lowestPhysicalModes(const model::SecondOrderModel& model, int count,
                                       int* spurious) {
  if (spurious != nullptr) *spurious = 0;
  if (!forcesHaveMass(model)) return lowestModes(model, count);
  const linalg::EigenPairs all = lowestModes(model, model.size());
  const auto out = spuriousShapes(model, all.vectors.cast<std::complex<double>>());
  std::vector<Eigen::Index> physical;
  for (Eigen::Index j = 0; j < all.values.size(); ++j)
    if (!out[static_cast<std::size_t>(j)]) physical.push_back(j);
  if (spurious != nullptr) *spurious = all.count() - static_cast<int>(physical.size());
  physical.resize(std::min(physical.size(), static_cast<std::size_t>(count)));
  linalg::EigenPairs kept = all;
  linalg::truncate(kept, static_cast<int>(physical.size()));
  for (std::size_t j = 0; j < physical.size(); ++j) {
    const auto to = static_cast<Eigen::Index>(j);
    kept.values[to] = all.values[physical[j]];
    kept.vectors.col(to) = all.vectors.col(physical[j]);
    kept.residuals[to] = all.residuals[physical[j]];
  }
  return kept;
}

}  // namespace tooljoint::coupling
