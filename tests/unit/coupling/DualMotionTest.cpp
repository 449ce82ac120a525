// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Motion with multipliers: the same as without, forces between parts, consistent starts, and
/// integrators that refuse it.
#include <Teuchos_ParameterList.hpp>
#include <cmath>
#include <gtest/gtest.h>

#include "common/Error.hpp"
#include "coupling/assembly/Assembler.hpp"
#include "model/laws/Connectors.hpp"
#include "reduction/Reduce.hpp"
#include "tests/support/SpaceFrame.hpp"
#include "transient/Transient.hpp"

namespace DualMotionTest {

using namespace tooljoint;
using namespace tooljoint::coupling;

/// Recovered displacements, velocities and coordinates at the samples.
class Motion : public transient::SampleSink {
 public:
  explicit Motion(const model::SecondOrderModel& m) : model_(m) {}
  void sample(double, const Vector& q, const Vector& v, const Vector& a) override {
    displacement.push_back(model_.recoveryOffset + model_.recovery * q);
    velocity.push_back(model_.recovery * v);
    coordinates.push_back(q);
    accelerations.push_back(a);
  }
  std::vector<Vector> displacement, velocity, coordinates, accelerations;

 private:
  const model::SecondOrderModel& model_;
};

double difference(const std::vector<Vector>& a, const std::vector<Vector>& b) {
  double error = 0, size = 0;
  for (std::size_t i = 0; i < b.size(); ++i) {
    error = std::max(error, (a[i] - b[i]).cwiseAbs().maxCoeff());
    size = std::max(size, b[i].cwiseAbs().maxCoeff());
  }
  EXPECT_GT(size, 0.0);
  return error / size;
}

transient::TransientOptions steps(const std::string& integrator = "Generalized-alpha") {
  transient::TransientOptions options;
  options.integrator = integrator;
  options.end = 0.2;
  options.step = 2e-4;
  options.sampling = 1e-3;
  options.progress = false;
  return options;
}

const std::vector<int> own{1, 3};

/// The frame under a force at node 5 that sets in at once, with some damping; the middles of beam
/// and left strut are retained.
std::vector<reduction::ReducedSubstructure> loadedFrame(int modes) {
  const samples::FiveMembers frame{6};
  auto parts = frame.parts(own);
  for (int p = 0; p < 5; ++p) {
    auto& part = parts[static_cast<std::size_t>(p)];
    part.model.damping.push_back(
        {"Rayleigh", Sparse(2.0 * part.model.mass + 1e-5 * part.model.stiffness.front().matrix),
         0});
    std::vector<int> ends;
    for (int node : {frame.members[static_cast<std::size_t>(p)].nodes.front(),
                     frame.members[static_cast<std::size_t>(p)].nodes.back()})
      if (node > 2) ends.push_back(node);
    samples::classify(part, ends, {303, 403});
  }
  Vector force = Vector::Zero(parts[4].model.size());
  force[samples::find(parts[4].model, model::DofLabel::physical(5, 0))] = 3000;
  force[samples::find(parts[4].model, model::DofLabel::physical(5, 2))] = -20000;
  parts[4].model.loads.push_back({"push", force, 0});
  reduction::ReductionOptions options;
  options.modes.kind = reduction::ModeRule::Kind::PerPart;
  options.modes.counts = {modes};
  return reduction::reduceAll(
      parts, *reduction::makeBasis("Craig-Bampton", Teuchos::ParameterList()), options);
}

CouplingOptions options(Assembly assembly, bool stop) {
  const samples::FiveMembers frame{6};
  CouplingOptions chosen;
  chosen.assembly = assembly;
  chosen.connections.frames = frame.frames(own);
  if (stop) {
    model::StopParameters parameters;
    parameters.gap = 2e-4;
    parameters.stiffness = 1e7;
    parameters.smoothing = 2e-5;
    Connector connector;
    connector.name = "stop";
    connector.law = model::stops({parameters});
    connector.rows = {
        separation({"beam", 303}, {"left strut", 403}, {0.1, 0.9, 0.3}, samples::spaceComponents)};
    chosen.connections.connectors.push_back(connector);
  }
  return chosen;
}

TEST(DualMotion, IsThePrimalMotion) {
  const auto parts = loadedFrame(6);
  for (const bool stop : {false, true}) {
    const auto primal = coupleWithPositions(parts, options(Assembly::Primal, stop));
    const auto dual = coupleWithPositions(parts, options(Assembly::Dual, stop));
    Motion a(primal.model), b(dual.model);
    const auto first = transient::integrate(primal.model, steps(), a);
    const auto second = transient::integrate(dual.model, steps(), b);
    if (stop) {
      double least = 1;
      for (const auto& q : a.coordinates)
        least =
            std::min(least, (primal.model.points[0].offset + primal.model.points[0].rows * q)[0]);
      EXPECT_LT(least, -2e-4) << "the stop is met";
    }
    std::printf(
        "stop %d: displacement %.2e, velocity %.2e; %ld and %ld iterations, wall %.3f and %.3f s\n",
        stop, difference(b.displacement, a.displacement), difference(b.velocity, a.velocity),
        first.counters.newtonIterations, second.counters.newtonIterations, first.wall, second.wall);
    EXPECT_LT(difference(b.displacement, a.displacement), stop ? 1e-5 : 1e-8);
    EXPECT_LT(difference(b.velocity, a.velocity), stop ? 1e-4 : 1e-7);
    EXPECT_LT(std::abs(second.energy.residual()), 1e-2);
  }
}

}  // namespace DualMotionTest
