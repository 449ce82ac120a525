// SPDX-License-Identifier: BSD-3-Clause
#include "transient/schemes/MasslessStart.hpp"

#include <algorithm>
#include <vector>

#include "common/Index.hpp"
#include "common/Text.hpp"
#include "common/report/Log.hpp"
#include "linalg/blocks/BlockFactor.hpp"
#include "transient/implicit/PhaseCorrection.hpp"

namespace tooljoint::transient {
namespace {

/// A force out of balance below this part of the largest one is rounding.
constexpr double inBalance = 1e-9;

/// 1 for dofs with mass, damping or points, which keep the start they are given; 0 for the others.
Vector heldDofs(const CompiledModel& model, const MassFactor& mass) {
  const auto& pattern = model.pattern();
  Vector held(model.size()), rows(model.size());
  for (int i = 0; i < model.size(); ++i) held[i] = mass.isMissing(i) ? 0.0 : 1.0;
  for (const auto& term : model.damping().terms()) {
    rowSums(pattern, term.values.data(), rows);
    held = held.cwiseMax(rows.cwiseSign());
  }
  std::vector<char> touched(at(pattern.blocks()), 0);
  for (const auto& batch : model.points()) batch.markBlocks(touched);
  for (int b = 0; b < pattern.blocks(); ++b)
    if (touched[at(b)]) held.segment(pattern.start(b), pattern.width(b)).setOnes();
  model.cut().complete(held.data());
  return held.cwiseMin(1.0);
}

/// Factor of K_ss with unit pivots elsewhere; false when it is singular.
bool factorBetween(const CompiledModel& model, const Vector& held, linalg::BlockFactor& factor) {
  const auto& pattern = model.pattern();
  model.combine(0.0, 0.0, 1.0, factor.values());
  for (int b = 0; b < pattern.blocks(); ++b)
    for (int e = pattern.rowBegin(b); e < pattern.rowBegin(b + 1); ++e) {
      const int c = pattern.column(e);
      for (int j = 0; j < pattern.width(c); ++j)
        for (int i = 0; i < pattern.width(b); ++i)
          if (held[pattern.start(b) + i] > 0 || held[pattern.start(c) + j] > 0)
            factor.values()[pattern.offset(e) + at(j * pattern.width(b) + i)] = 0.0;
    }
  for (int i = 0; i < model.size(); ++i)
    if (held[i] > 0 && model.cut().owns(i)) factor.values()[pattern.address(i, i)] = 1.0;
  return factor.factor() < 0;
}

}  // namespace

void balanceMassless(CompiledModel& model, const MassFactor& mass, State& state) {
  const Vector held = heldDofs(model, mass);
  if (!model.cut().any(held.size() > 0 && held.minCoeff() == 0.0)) return;
  linalg::BlockFactor factor(model.pattern());
  if (!factorBetween(model, held, factor)) return;
  const Eigen::Map<const Vector> load(model.load(), model.size());
  const auto balance = [&](Vector& x, bool loaded) {
    Vector internal = Vector::Zero(model.size());
    model.addStiffness(x.data(), internal.data());
    Vector change =
        ((loaded ? 1.0 : 0.0) * load - internal).cwiseProduct(Vector::Ones(held.size()) - held);
    Vector missing = change;
    model.cut().complete(missing.data());
    model.cut().complete(internal.data());
    const double most = std::max(model.largest(internal), loaded ? model.largest(load) : 0.0);
    if (!(model.largest(missing) > inBalance * most)) return Vector();
    factor.solve(change.data());
    x += change;
    return change;
  };
  const Vector moved = balance(state.q, true);
  balance(state.v, false);
  if (moved.size() > 0)
    log::info(
        "Degrees of freedom without mass and damping start in balance with the others, with "
        "a change of up to " +
        formatNumber(model.largest(moved)) + " at " + model.worstName(moved) + ".");
}

}  // namespace tooljoint::transient
