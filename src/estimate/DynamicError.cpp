// SPDX-License-Identifier: BSD-3-Clause
#include "estimate/DynamicError.hpp"

#include <algorithm>

#include "common/report/StageTimes.hpp"
#include "coupling/CoupledModes.hpp"
#include "linalg/ComplexProduct.hpp"
#include "linalg/trilinos/EigenChecks.hpp"
#include "model/DofNames.hpp"
#include "reduction/part/Partition.hpp"

namespace tooljoint::estimate {

namespace {

using linalg::times;

ComplexMatrix rows(const ComplexMatrix& x, const std::vector<int>& positions) {
  ComplexMatrix part(static_cast<Eigen::Index>(positions.size()), x.cols());
  for (std::size_t i = 0; i < positions.size(); ++i)
    part.row(static_cast<Eigen::Index>(i)) = x.row(positions[i]);
  return part;
}

/// F r of a complex residual.
ComplexVector deformation(const ResidualFlexibility& flexibility, const ComplexVector& r) {
  const Matrix y = flexibility.apply((Matrix(r.size(), 2) << r.real(), r.imag()).finished());
  return y.col(0).cast<Complex>() + Complex(0, 1) * y.col(1).cast<Complex>();
}

/// Responses of the truncated modes to one residual: F r and -s^2 F M F r.
class TruncatedMotion {
 public:
  TruncatedMotion(const ResidualFlexibility& flexibility, const Sparse& mass,
                  const ComplexVector& r, Complex s)
      : first_(deformation(flexibility, r)),
        next_(-s * s * deformation(flexibility, times(mass, first_))) {}

  /// l' (F - s^2 F M F ...) r: the two first terms of the expansion of the truncated dynamic
  /// flexibility, summed as a geometric series.
  Complex work(const ComplexVector& l) const {
    const Complex still = l.cwiseProduct(first_).sum();
    const Complex next = l.cwiseProduct(next_).sum();
    return std::abs(next) < 0.5 * std::abs(still) ? still * still / (still - next) : still + next;
  }

 private:
  ComplexVector first_, next_;
};

/// Left vectors in the order of the right ones: modes of the transposed matrices with the nearest
/// values.
ComplexMatrix leftShapes(const Linearised& m, const linalg::QuadraticModes& right,
                         std::optional<linalg::DampedTarget> target) {
  const int count = static_cast<int>(right.values.size());
  const Sparse C = m.damping.transpose(), K = m.stiffness.transpose();
  if (target) target->count = count;
  const auto modes = target ? linalg::dampedModesNear(m.mass, C, K, *target)
                            : linalg::lowestDampedModes(m.mass, C, K, count);
  ComplexMatrix left(right.vectors.rows(), count);
  std::vector<char> taken(static_cast<std::size_t>(modes.values.size()), 0);
  for (Eigen::Index j = 0; j < count; ++j) {
    Eigen::Index best = -1;
    for (Eigen::Index i = 0; i < modes.values.size(); ++i)
      if (!taken[static_cast<std::size_t>(i)] &&
          (best < 0 || std::abs(modes.values[i] - right.values[j]) <
                           std::abs(modes.values[best] - right.values[j])))
        best = i;
    if (best < 0) {  // repeated zeros may be separate on one side only; they have no relative error
      left.col(j).setZero();
      continue;
    }
    taken[static_cast<std::size_t>(best)] = 1;
    left.col(j) = modes.vectors.col(best);
  }
  return left;
}

}  // namespace

std::vector<Linearised> linearise(const std::vector<model::Substructure>& parts, double t) {
  std::vector<Linearised> matrices;
  for (const auto& part : parts) matrices.push_back(linearise(part.model, t));
  return matrices;
}

std::vector<Linearised> linearise(const std::vector<model::Substructure>& parts, double t,
                                  double omega) {
  std::vector<Linearised> matrices;
  for (const auto& part : parts) matrices.push_back(linearise(part.model, t, omega));
  return matrices;
}

linalg::EnergyRounding roundingOfParts(const std::vector<model::Substructure>& parts,
                                       const coupling::Synthesis& synthesis) {
  std::vector<Sparse> absolute, shapes;
  std::vector<double> fractions;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const Sparse K = reduction::constantStiffness(parts[p].model);
    absolute.push_back(K.cwiseAbs());
    fractions.push_back(linalg::roundingOf(K));
    shapes.push_back(synthesis.parts[p].basis->vectors * synthesis.coupled.maps[p]);
  }
  return [absolute, shapes, fractions](const ComplexVector& y) {
    double sum = 0;
    for (std::size_t p = 0; p < shapes.size(); ++p) {
      const Vector size = times(shapes[p], y).cwiseAbs();
      sum += fractions[p] * size.dot(absolute[p] * size);
    }
    return sum;
  };
}

namespace {

/// The first `count` modes that are not spurious.
void keepPhysical(const model::SecondOrderModel& model, Eigen::Index count,
                  linalg::QuadraticModes& modes) {
  const auto spurious = coupling::spuriousShapes(model, modes.vectors);
  Eigen::Index kept = 0;
  for (Eigen::Index j = 0; j < modes.values.size(); ++j) {
    if (spurious[static_cast<std::size_t>(j)]) continue;
    modes.values[kept] = modes.values[j];
    modes.vectors.col(kept) = ComplexVector(modes.vectors.col(j));
    modes.residuals[kept++] = modes.residuals[j];
  }
  kept = std::min(kept, count);
  modes.values.conservativeResize(kept);
  modes.vectors.conservativeResize(Eigen::NoChange, kept);
  modes.residuals.conservativeResize(kept);
}

}  // namespace

linalg::QuadraticModes physicalDampedModes(const model::SecondOrderModel& model,
                                           const Linearised& m, int count,
                                           const linalg::EnergyRounding& rounding) {
  const int all = 2 * model.size();
  for (int looked = std::min(count, all);; looked = std::min(2 * looked, all)) {
    auto modes = linalg::lowestDampedModes(m.mass, m.damping, m.stiffness, looked,
                                           model::namer(model), rounding);
    const auto found = modes.values.size();
    keepPhysical(model, count, modes);
    if (modes.values.size() >= count || looked == all || found < looked) return modes;
  }
}

linalg::QuadraticModes physicalDampedModes(const model::SecondOrderModel& model,
                                           const Linearised& m, const linalg::DampedTarget& target,
                                           const linalg::EnergyRounding& rounding) {
  auto looked = target;
  for (;; looked.count *= 2) {
    auto modes = linalg::dampedModesNear(m.mass, m.damping, m.stiffness, looked, rounding);
    const auto found = modes.values.size();
    keepPhysical(model, found, modes);
    if (modes.values.size() >= target.count || found < looked.count) return modes;
  }
}

DynamicError::DynamicError(const std::vector<model::Substructure>& parts,
                           const coupling::Synthesis& synthesis,
                           const std::vector<Linearised>& matrices)
    : parts_(parts), synthesis_(synthesis) {
  for (std::size_t p = 0; p < parts.size(); ++p) {
    flexibilities_.emplace_back(parts[p], *synthesis.parts[p].basis,
                                reduction::symmetricPart(matrices[p].stiffness));
    const auto& interior = flexibilities_.back().interior();
    masses_.push_back(reduction::block(matrices[p].mass, interior, interior));
  }
}

ComplexVector DynamicError::ofModes(const std::vector<Linearised>& matrices, const Linearised& m,
                                    const linalg::QuadraticModes& right,
                                    const std::optional<linalg::DampedTarget>& target) const {
  const ComplexMatrix left = leftShapes(m, right, target);
  const Stage stage("error estimates");
  const auto count = right.values.size();
  ComplexVector work = ComplexVector::Zero(count);
  ComplexVector slope = ComplexVector::Zero(count);
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    const auto& basis = synthesis_.parts[p].basis->vectors;
    const auto& map = synthesis_.coupled.maps[p];
    const auto& part = matrices[p];
    const Sparse damping = part.damping.transpose(), stiffness = part.stiffness.transpose();
    const auto& interior = flexibilities_[p].interior();
    const ComplexMatrix D = times(basis, times(map, right.vectors)),
                        E = times(basis, times(map, left));
    for (Eigen::Index j = 0; j < count; ++j) {
      const Complex s = right.values[j];
      const ComplexVector MD = times(part.mass, D.col(j)), CD = times(part.damping, D.col(j));
      const ComplexVector r = s * s * MD + s * CD + times(part.stiffness, D.col(j));
      const ComplexVector l = s * s * times(part.mass, E.col(j)) + s * times(damping, E.col(j)) +
                              times(stiffness, E.col(j));
      slope[j] += E.col(j).cwiseProduct(2.0 * s * MD + CD).sum();
      if (flexibilities_[p].truncated() > 0)
        work[j] += TruncatedMotion(flexibilities_[p], masses_[p], rows(r, interior), s)
                       .work(rows(l, interior));
    }
  }
  ComplexVector error = ComplexVector::Zero(count);
  for (Eigen::Index j = 0; j < count; ++j)
    if (slope[j] != 0.0) error[j] = -work[j] / slope[j];
  return error;
}

ComplexMatrix DynamicError::ofResponses(const std::vector<Linearised>& matrices, Complex s,
                                        const ComplexMatrix& y,
                                        const std::vector<ComplexMatrix>& loads,
                                        const ComplexMatrix& z,
                                        const std::vector<ComplexMatrix>& outputs) const {
  const Stage stage("error estimates");
  ComplexMatrix error = ComplexMatrix::Zero(z.cols(), y.cols());
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    if (flexibilities_[p].truncated() == 0) continue;
    const auto& basis = synthesis_.parts[p].basis->vectors;
    const auto& map = synthesis_.coupled.maps[p];
    const auto& part = matrices[p];
    const auto& interior = flexibilities_[p].interior();
    const ComplexMatrix D = times(basis, times(map, y)), E = times(basis, times(map, z));
    const ComplexMatrix r = rows(s * s * times(part.mass, D) + s * times(part.damping, D) +
                                     times(part.stiffness, D) - loads[p],
                                 interior);
    const ComplexMatrix l =
        rows(s * s * times(part.mass, E) + s * times(part.damping.transpose(), E) +
                 times(part.stiffness.transpose(), E) - outputs[p],
             interior);
    for (Eigen::Index c = 0; c < y.cols(); ++c) {
      const TruncatedMotion motion(flexibilities_[p], masses_[p], r.col(c), s);
      for (Eigen::Index o = 0; o < z.cols(); ++o) error(o, c) += motion.work(l.col(o));
    }
  }
  return error;
}

}  // namespace tooljoint::estimate
