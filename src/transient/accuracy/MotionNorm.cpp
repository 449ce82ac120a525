// SPDX-License-Identifier: BSD-3-Clause
#include "transient/accuracy/MotionNorm.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include "common/Index.hpp"
#include "coupling/input/ComponentAxes.hpp"
#include "transient/accuracy/StepControl.hpp"

namespace tooljoint::transient {
namespace {

/// Rows of the recovery that are translations, in positions; empty for a model without output.
Sparse translationsOf(const CompiledModel& model) {
  const auto& source = model.source();
  const auto n = static_cast<Eigen::Index>(model.size());
  const auto& position = model.pattern().partition().position;
  const auto components = static_cast<Eigen::Index>(source.componentNames.size());
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index row = 0; row < source.recovery.rows(); ++row) {
    const auto& name = source.componentNames[static_cast<std::size_t>(row % components)];
    if (coupling::kindOf(name) != coupling::ComponentKind::Translation) continue;
    for (model::SharedSparse::InnerIterator it(source.recovery, row); it; ++it)
      entries.emplace_back(static_cast<int>(row), position[at(it.col())], it.value());
  }
  if (entries.empty()) return Sparse(0, n);
  Sparse result(source.recovery.rows(), n);
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

/// Mass over the number of nodes, or of coordinates without nodes.
double inertiaOf(const CompiledModel& model, bool translated) {
  MassNorm norm;
  norm.bind(model);
  const auto& source = model.source();
  const auto components = static_cast<Eigen::Index>(source.componentNames.size());
  const auto lengths = translated ? source.recovery.rows() / components
                                  : static_cast<Eigen::Index>(model.wholeSize());
  return norm.mass() / static_cast<double>(lengths);
}

}  // namespace

Norms rootRatio(const Norms& a, const Norms& b) {
  const auto one = [](double x, double y) {
    if (y > 0) return std::sqrt(x / y);
    return x > 0 ? std::numeric_limits<double>::infinity() : 0.0;
  };
  return {one(a[0], b[0]), one(a[1], b[1])};
}

MotionNorm::MotionNorm(const CompiledModel& model)
    : model_(&model),
      translations_(translationsOf(model)),
      translated_(model.cut().any(translations_.rows() > 0)),
      inertia_(inertiaOf(model, translated_)) {
  product_.setZero(translations_.rows());
}

double MotionNorm::translations(const Vector& q) const {
  if (!translated_) return model_->squaredNorm(q);
  product_.noalias() = translations_ * q;
  return model_->cut().sum(product_.squaredNorm());
}

Norms MotionNorm::squares(const Vector& q) const {
  return {translations(q), model_->massForm(q.data())};
}

}  // namespace tooljoint::transient
