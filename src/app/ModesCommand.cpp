// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "app/Commands.hpp"
#include "app/Report.hpp"
#include "app/Scene.hpp"
#include "app/Stages.hpp"
#include "common/Log.hpp"
#include "coupling/Synthesis.hpp"
#include "linalg/EigenSolver.hpp"
#include "reduction/Reduce.hpp"

namespace tooljoint::app {

namespace {

constexpr double kTwoPi = 6.28318530717958647692;

/// omega^2 of the symmetric part of K (contact at the static state included) against M.
Vector eigenvalues(const model::SecondOrderModel& model, int count) {
  const Sparse stiffness = model.stiffnessAt(0.0) + model.pointStiffness(0.0, model.initialDisplacement, model.initialVelocity);
  const Sparse symmetric = 0.5 * (stiffness + Sparse(stiffness.transpose()));
  const Sparse mass = 0.5 * (model.mass + Sparse(model.mass.transpose()));
  return linalg::lowestModes(symmetric, mass, std::min(count, model.size())).values;
}

/// sign(omega^2) sqrt(|omega^2|) / 2 pi: a negative frequency is a divergent mode.
double frequency(double eigenvalue) { return std::copysign(std::sqrt(std::abs(eigenvalue)) / kTwoPi, eigenvalue); }

}  // namespace

void modes(const RunOptions& options) {
  const auto scene = readScene(options.deck, options.overrides);
  log::info(describeScene(scene));
  const auto stage = settle(scene);
  log::info(describeStatic(stage));
  const Vector full = eigenvalues(fullModel(stage), options.modeCount);
  Vector coupled;
  if (scene.reduces()) {
    const auto synthesis = coupling::synthesise(cut(scene, stage), scene.list().sublist("Reduction"));
    for (const auto& part : synthesis.parts) log::info(part.report.table());
    log::info(reduction::summaryTable(synthesis.parts));
    coupled = eigenvalues(synthesis.coupled.model, options.modeCount);
  }
  log::info("Eigenfrequencies about the static state (undamped, symmetric part, closed contacts linear, negative = divergent):");
  log::info(scene.reduces() ? "  mode       full [Hz]    coupled [Hz]   relative error" : "  mode       full [Hz]");
  for (Eigen::Index i = 0; i < full.size(); ++i) {
    char line[128];
    if (i < coupled.size())
      std::snprintf(line, sizeof line, "  %4ld  %14.8g  %14.8g   %14.2e", static_cast<long>(i + 1), frequency(full(i)), frequency(coupled(i)),
                    frequency(coupled(i)) / frequency(full(i)) - 1.0);
    else
      std::snprintf(line, sizeof line, "  %4ld  %14.8g", static_cast<long>(i + 1), frequency(full(i)));
    log::info(line);
  }
}

}  // namespace tooljoint::app
