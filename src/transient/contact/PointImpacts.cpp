// SPDX-License-Identifier: BSD-3-Clause
#include "transient/contact/PointImpacts.hpp"

#include <algorithm>

#include "common/Index.hpp"
#include "transient/contact/FewRows.hpp"

namespace tooljoint::transient {
namespace {

constexpr int widest = PointSolve::widest;

/// -tr(J G): above 1 if a wall is stiffer than the surroundings of the point.
double yielding(int n, const double* J, const double* G) {
  double trace = 0;
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) trace -= J[i * n + k] * G[k * n + i];
  return trace;
}

/// G0 = G (I + P G)^-1; false if it does not exist.
bool withoutLaws(int w, const double* G, const double* P, double* G0) {
  double A[widest * widest], B[widest * widest];
  for (int i = 0; i < w; ++i)
    for (int j = 0; j < w; ++j) {
      A[i * w + j] = i == j ? 1.0 : 0.0;
      for (int k = 0; k < w; ++k) A[i * w + j] += P[i * w + k] * G[k * w + j];
    }
  if (!invertFew(w, A, B)) return false;
  for (int i = 0; i < w; ++i)
    for (int j = 0; j < w; ++j) {
      G0[i * w + j] = 0;
      for (int k = 0; k < w; ++k) G0[i * w + j] += G[i * w + k] * B[k * w + j];
    }
  return true;
}

}  // namespace

void PointImpacts::bind(const CompiledModel& model, Strategies& strategies) {
  strategies_ = &strategies;
  stiffness_.clear();
  light_.clear();
  Vector massless(model.size());
  model.diagonal(1.0, 0.0, 0.0, massless.data());
  for (double& m : massless) m = m == 0.0 ? 1.0 : 0.0;
  for (const auto& batch : model.points()) {
    stiffness_.emplace_back(at(batch.points()), 0.0);
    light_.emplace_back(at(batch.points()), char{0});
    for (int row = 0; row < batch.points() * batch.width(); ++row)
      if (batch.rowWeight(row, massless.data()) > 0.0) light_.back()[at(row / batch.width())] = 1;
  }
}

void PointImpacts::set(CompiledModel& model, double h, double impact) {
  h_ = h;
  impact_ = impact;
  for (std::size_t b = 0; b < stiffness_.size(); ++b)
    for (int p = 0; p < model.points()[b].points(); ++p)
      model.points()[b].setScale(p, stiffness_[b][at(p)] * h * h > 1.0 ? impact : 1.0);
}

void PointImpacts::find(std::size_t number, PointBatch& batch, double t,
                        const std::vector<int>& points, const std::vector<double>& compliance) {
  if (impact_ == 1.0 || !batch.law().hasWalls()) return;
  const int w = batch.width();
  double G0[widest * widest];
  for (int p : points) {
    if (light_[number][at(p)]) continue;
    const double* J = batch.dfdd() + p * w * w;
    const double* G = &compliance[at(p * w * w)];
    if (yielding(w, J, G) < 0.5) continue;  // for J = P, a stiffness of 1/h^2
    if (!withoutLaws(w, G, batch.frozen() + p * w * w, G0)) continue;
    double& stiffness = stiffness_[number][at(p)];
    const double unit = batch.scale(p) * h_ * h_, here = yielding(w, J, G0);
    if (here / unit <= stiffness) continue;
    stiffness = std::max(stiffness, std::min(here, yieldingDeeper(batch, p, t, G0)) / unit);
    if (batch.scale(p) == 1.0 && stiffness * h_ * h_ > 1.0) {
      batch.setScale(p, impact_);
      batch.rescale(p);
      strategies_->count(Strategy::RestingImpacts);
    }
  }
}

/// -tr(df/dd G0) at the depth to which its force moves the point in the step. A law that is steep
/// there too is the wall itself, not the depth in which a regularised law begins.
double PointImpacts::yieldingDeeper(PointBatch& batch, int point, double t,
                                    const double* G0) const {
  using Rows =
      Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;
  const int w = batch.width();
  const auto local = [&](const double* rows) -> PointSolve::Local {
    return Eigen::Map<const Vector>(rows + point * w, w);
  };
  const PointSolve::Local d = local(batch.d()), v = local(batch.v()),
                          deeper = d - Rows(G0, w, w).lazyProduct(local(batch.force()));
  PointSolve::Local f = d;
  double dfdd[widest * widest] = {}, dfdv[widest * widest];
  batch.evaluateElsewhere(t, point, deeper.data(), v.data(), f.data(), dfdd, dfdv);
  return yielding(w, dfdd, G0);
}

void PointImpacts::save(std::vector<double>& memory) const {
  for (const auto& batch : stiffness_) memory.insert(memory.end(), batch.begin(), batch.end());
}

void PointImpacts::restore(const double*& memory) {
  for (auto& batch : stiffness_)
    for (double& stiffness : batch) stiffness = *memory++;
}

}  // namespace tooljoint::transient
