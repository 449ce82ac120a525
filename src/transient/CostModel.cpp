// SPDX-License-Identifier: BSD-3-Clause
#include "transient/CostModel.hpp"

#include <algorithm>

#include "common/Index.hpp"
#include "linalg/blocks/BlockFactor.hpp"
#include "transient/Integrator.hpp"
#include "transient/compiled/CompiledModel.hpp"

namespace tooljoint::transient {
namespace {

/// Relaxations in a usual step; the phase correction adds these solves and products.
constexpr double relaxations = 2;
constexpr double phaseSolves = 1, phaseProducts = 2;
/// Law at one point (logarithms, roots, arctangents), with the compliance of the point.
constexpr double lawWork = 150;
/// Vectors read or written once per dof in a step.
constexpr double implicitVectors = 40, explicitVectors = 30;

/// Cost of a multiplication relative to one in a 6 x 6 block, whose kernel is unrolled: in a block
/// of another size, and in a row of a point, which is gathered entry by entry.
constexpr double oddBlock = 2.5, gathered = 4;

/// Multiplications of a product with these values. A block with off-diagonal entries counts whole,
/// a diagonal one by its diagonal, a zero block not at all.
double productWork(const linalg::BlockPattern& pattern, const double* values) {
  double work = 0;
  for (int b = 0; b < pattern.blocks(); ++b)
    for (int e = pattern.rowBegin(b); e < pattern.rowBegin(b + 1); ++e) {
      const int rows = pattern.width(b), columns = pattern.width(pattern.column(e));
      bool diagonal = false, beside = false;
      for (int j = 0; j < columns; ++j)
        for (int i = 0; i < rows; ++i)
          if (values[pattern.offset(e) + at(j * rows + i)] != 0.0)
            (i == j && rows == columns ? diagonal : beside) = true;
      const double each = rows == 6 && columns == 6 ? 1.0 : oddBlock;
      work += beside ? each * rows * columns : diagonal ? rows : 0;
    }
  return work;
}

/// Mean cost of a multiplication in a factor on this pattern.
double pace(const linalg::BlockPattern& pattern) {
  double all = 0, odd = 0;
  for (int b = 0; b < pattern.blocks(); ++b)
    for (int e = pattern.rowBegin(b); e < pattern.rowBegin(b + 1); ++e) {
      const double entries =
          static_cast<double>(pattern.width(b)) * pattern.width(pattern.column(e));
      all += entries;
      if (pattern.width(b) != 6 || pattern.width(pattern.column(e)) != 6) odd += entries;
    }
  return all > 0 ? 1 + (oddBlock - 1) * odd / all : 1;
}

}  // namespace

CostModel costModel(const model::SecondOrderModel& source, const TransientOptions& options) {
  CompiledModel model(source);
  const auto& pattern = model.pattern();
  const bool isExplicit =
      IntegratorRegistry::instance().make(options.integrator, options.own)->isExplicit();
  CostModel cost;
  cost.size = model.size();

  const double solve = linalg::BlockFactor(pattern).solveWork() * pace(pattern);
  linalg::BlockValues values(pattern.storage());
  model.setTime(options.start);
  const auto work = [&](double m, double c, double k) {
    model.combine(m, c, k, values.data());
    return productWork(pattern, values.data());
  };
  const double mass = work(1, 0, 0), damping = work(0, 1, 0), stiffness = work(0, 0, 1);

  // Each evaluation gathers and scatters the rows of points near contact. The clearances of all
  // points are read once.
  Vector q(model.size());
  model.toPositions(source.initialDisplacement, q);
  double near = 0, rows = 0, all = 0;
  for (std::size_t s = 0; s < source.points.size(); ++s) {
    auto& batch = model.points()[s];
    batch.look(options.start, options.step > 0 ? options.step : 1e-3, q.data());
    near += static_cast<double>(batch.active().size());
    const auto& sparse = source.points[s].rows;
    for (int point : batch.active())
      for (int row = point * batch.width(); row < (point + 1) * batch.width(); ++row)
        for (Sparse::InnerIterator it(sparse, row); it; ++it) rows += 1;
    all += static_cast<double>(batch.points());
  }
  const double evaluation = 2 * gathered * rows + lawWork * near;
  const double booked = options.ledger ? 0.5 : 0.0;  // every second step
  if (isExplicit) {
    cost.solves = 4 * solve;
    cost.products = 4 * (damping + stiffness) + booked * (mass + damping + stiffness) / 2;
    cost.points = 4 * evaluation + 5 * all;
    cost.vectors = explicitVectors * cost.size;
  } else {
    cost.solves = (relaxations + phaseSolves) * solve;
    cost.products =
        (1 + phaseProducts) * mass + damping + stiffness + booked * (damping + stiffness);
    cost.points = (relaxations + booked) * evaluation + 5 * all;
    cost.vectors = implicitVectors * cost.size;
  }
  return cost;
}

}  // namespace tooljoint::transient
