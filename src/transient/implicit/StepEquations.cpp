// SPDX-License-Identifier: BSD-3-Clause
#include "transient/implicit/StepEquations.hpp"

#include <limits>

#include "transient/Tuned.hpp"

namespace tooljoint::transient {

void StepEquations::bind(CompiledModel& model, double tolerance) {
  model_ = &model;
  relative_ = tolerance;
  scale_.bind(model);
  const int n = model.size();
  for (Vector* x : {&linear_, &residual_, &forces_}) x->setZero(n);
  atCut_.setZero(n - model.cut().interior(n));
}

void StepEquations::begin(const State& to, const StepScheme& scheme) {
  linearise(to, &scheme);
  const double stop =
      scheme.acceleration / scheme.velocity *
      model_->cut().largest((scale_.inertia().array().abs() * to.v.array().abs()).maxCoeff());
  mostForce_ = Tuned::mostGrowth * std::max(reference_, stop);
  error_ = INFINITY;
}

/// Also finds the sizes of the terms (a is the predicted one), run by run while the data are in the
/// cache.
void StepEquations::linearise(const State& to, const StepScheme* rest) {
  const CompiledModel& model = *model_;
  const Eigen::Map<const Vector> load(model.timed().load(), model.size());
  const double ahead = rest != nullptr ? rest->acceleration / rest->velocity : 0.0;
  const int interior = model.cut().interior(model.size());
  double sizes[2] = {0, 0};  // largest force, largest rounding error
  const auto measureSizes = [&](int begin, int length, const auto& internal) {
    const auto part = [begin, length](const auto& x) { return x.segment(begin, length).array(); };
    const auto forces = part(scale_.weight()) * internal.abs();
    const auto inertia = part(scale_.inertia()) * (part(to.a) + ahead * part(to.v)).abs();
    sizes[0] = std::max(sizes[0], forces.max(inertia).maxCoeff());
    sizes[1] = std::max(sizes[1], (part(scale_.rounding()) * part(to.q).abs()).maxCoeff());
  };
  for (const auto& run : model.runs()) {
    const int begin = model.pattern().start(run.begin),
              length = model.pattern().start(run.end) - begin;
    auto sum = linear_.segment(begin, length).array();
    const auto acting = load.segment(begin, length).array();
    sum.setZero();
    model.addStiffness(to.q.data(), linear_.data(), run);
    if (begin < interior)
      measureSizes(begin, length, sum.abs().max(acting.abs()));
    else
      atCut_.segment(begin - interior, length) = sum;
    model.addMass(to.a.data(), linear_.data(), run);
    sum -= acting;
    if (rest == nullptr) model.addDamping(to.v.data(), linear_.data(), run);
  }
  if (model.cut().isDivided()) {
    model.cut().completeCut(atCut_.data());
    const auto length = static_cast<int>(atCut_.size());
    if (length > 0)
      measureSizes(interior, length,
                   atCut_.array().abs().max(load.segment(interior, length).array().abs()));
    model.cut().reduce(sizes, 2, nullptr, 0);
  }
  linearReference_ = reference_ = sizes[0];
  floor_ = sizes[1];
}

double StepEquations::measure(const State& to) {
  forces_.setZero();
  for (auto& batch : model_->points()) {
    batch.evaluate(to.t, to.q.data(), to.v.data());
    batch.addForce(forces_.data());
  }
  residual_ = linear_ - forces_;
  const Vector& weight = scale_.weight();
  const int n = model_->size(), interior = model_->cut().interior(n);
  double largest[2] = {0, linearReference_}, square = 0;
  const auto look = [&](int i, double residual, double force, bool counts) {
    const double scaled = weight[i] * residual;
    largest[0] = std::max(largest[0], std::abs(scaled));
    largest[1] = std::max(largest[1], std::abs(weight[i] * force));
    if (counts) square += scaled * scaled;
  };
  for (int i = 0; i < interior; ++i) look(i, residual_[i], forces_[i], true);
  if (model_->cut().isDivided()) {
    atCut_ = residual_.tail(n - interior);
    model_->cut().completeCut(atCut_.data());
    model_->cut().complete(forces_.data());
    for (int i = interior; i < n; ++i)
      look(i, atCut_[i - interior], forces_[i], model_->cut().owns(i));
    model_->cut().reduce(largest, 2, &square, 1);
  }
  error_ = std::isfinite(square) ? largest[0] : square;
  merit_ = std::sqrt(square);
  reference_ = largest[1];
  return merit_;
}

double StepEquations::relativeError() const {
  return error_ / std::max(std::min(reference_, mostForce_), std::numeric_limits<double>::min());
}

std::string StepEquations::worstName() const {
  Vector residual = residual_;
  model_->cut().complete(residual.data());
  return model_->worstName(residual.cwiseProduct(weight()));
}

}  // namespace tooljoint::transient
