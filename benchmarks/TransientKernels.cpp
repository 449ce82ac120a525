// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Cost of the pieces of a time step on a string of the size of the reference scene (972 dofs,
/// contact looked at at 161 nodes), and of longer ones. Figures depend on the machine:
/// docs/validation.md records some with theirs.
#include <algorithm>
#include <benchmark/benchmark.h>
#include <cmath>
#include <ctime>
#include <numeric>

#include "HelicalString.hpp"
#include "linalg/blocks/LargePages.hpp"
#include "transient/Transient.hpp"
#include "transient/schemes/Explicit.hpp"

namespace {

using namespace tooljoint;
using namespace tooljoint::benchmarks;

struct NoSink final : transient::SampleSink {
  void sample(double, const Vector&, const Vector&, const Vector&) override {}
};

/// A state of lively contact: one second of motion from the centre line.
struct Motion final : transient::SampleSink {
  Vector q, v;
  double t = 0;
  void sample(double time, const Vector& q_, const Vector& v_, const Vector&) override {
    t = time, q = q_, v = v_;
  }
};

transient::TransientOptions options(const std::string& integrator, double begin, double end,
                                    double step) {
  transient::TransientOptions o;
  o.integrator = integrator;
  o.start = begin;
  o.end = end;
  o.step = step;
  o.progress = false;
  return o;
}

/// The model with the state after one second as its initial state.
const model::SecondOrderModel& settled(bool steady) {
  static model::SecondOrderModel models[2];
  auto& model = models[steady ? 1 : 0];
  if (model.size() == 0) {
    model = helicalString(referenceMesh(), steady);
    Motion end;
    auto o = options("Generalized-alpha", 0, 1.0, 1e-3);
    o.own.set("Accept Unconverged", true);
    transient::integrate(model, o, end);
    model.initialDisplacement = end.q;
    model.initialVelocity = end.v;
  }
  return model;
}

struct Kernel {
  transient::CompiledModel model;
  transient::State state;
  transient::ExplicitRightHandSide rhs;
  transient::Counters counters;
  explicit Kernel(const model::SecondOrderModel& source) : model(source) {
    state.resize(model.size());
    state.t = 1.0;
    model.toPositions(source.initialDisplacement, state.q);
    model.toPositions(source.initialVelocity, state.v);
    rhs.bind(model, "benchmark", counters);
    rhs.look(1.0, 0.0, state.q.data());
  }
};

/// One acceleration: residual with speed-dependent damping, contact, mass solve. The argument tells
/// whether the rotary speed is steady.
void rightHandSide(benchmark::State& bench) {
  Kernel kernel(settled(bench.range(0) != 0));
  for (auto _ : bench) {
    kernel.state.t += 1e-9;  // another time: speed-dependent matrices are combined anew unless the
                             // speed is the same
    kernel.rhs.complete(kernel.state);
    benchmark::DoNotOptimize(kernel.state.a.data());
  }
  bench.counters["dofs"] = kernel.model.size();
  bench.counters["points looked at"] =
      static_cast<double>(kernel.model.points()[0].active().size());
}
BENCHMARK(rightHandSide)->Arg(0)->Arg(1);

/// The same with the law evaluated at all 161 points.
void rightHandSideAllPoints(benchmark::State& bench) {
  Kernel kernel(settled(false));
  kernel.rhs.look(1.0, 0.0, kernel.state.q.data());
  const Vector far = Vector::Constant(kernel.model.size(),
                                      10.0);  // everything out of reach: all points become active
  kernel.rhs.missed(far.data());
  for (auto _ : bench) {
    kernel.state.t += 1e-9;
    kernel.rhs.complete(kernel.state);
    benchmark::DoNotOptimize(kernel.state.a.data());
  }
  bench.counters["points looked at"] =
      static_cast<double>(kernel.model.points()[0].active().size());
}
BENCHMARK(rightHandSideAllPoints);

void product(benchmark::State& bench) {
  Kernel kernel(settled(false));
  for (auto _ : bench) {
    kernel.model.addStiffness(kernel.state.q.data(), kernel.state.a.data());
    benchmark::DoNotOptimize(kernel.state.a.data());
  }
}
BENCHMARK(product);

void combineMatrices(benchmark::State& bench) {
  Kernel kernel(settled(false));
  double t = 1.0;
  for (auto _ : bench) kernel.model.setTime(t += 1e-9);
}
BENCHMARK(combineMatrices);

void pointForces(benchmark::State& bench) {
  Kernel kernel(settled(false));
  for (auto _ : bench) {
    kernel.model.addPointForces(1.0, kernel.state.q.data(), kernel.state.v.data(),
                                kernel.state.a.data());
    benchmark::DoNotOptimize(kernel.state.a.data());
  }
  bench.counters["points looked at"] =
      static_cast<double>(kernel.model.points()[0].active().size());
}
BENCHMARK(pointForces);

void pointTangents(benchmark::State& bench) {
  Kernel kernel(settled(false));
  for (auto _ : bench)
    for (auto& batch : kernel.model.points())
      batch.evaluateWithTangent(1.0, kernel.state.q.data(), kernel.state.v.data());
}
BENCHMARK(pointTangents);

void solve(benchmark::State& bench) {
  Kernel kernel(settled(false));
  linalg::BlockFactor factor(kernel.model.pattern());
  kernel.model.combine(4e6, 2e3, 1.0, factor.values());
  factor.factor();
  for (auto _ : bench) {
    kernel.state.a = kernel.state.v;
    factor.solve(kernel.state.a.data());
    benchmark::DoNotOptimize(kernel.state.a.data());
  }
}
BENCHMARK(solve);

void factorise(benchmark::State& bench) {
  Kernel kernel(settled(false));
  linalg::BlockFactor factor(kernel.model.pattern());
  for (auto _ : bench) {
    kernel.model.combine(4e6, 2e3, 1.0, factor.values());
    benchmark::DoNotOptimize(factor.factor());
  }
}
BENCHMARK(factorise);

/// One step of 1 ms; 0.25 s each time. Arguments: steady speed, energy ledger.
void generalizedAlphaStep(benchmark::State& bench) {
  const auto& model = settled(bench.range(0) != 0);
  auto o = options("Generalized-alpha", 1.0, 1.25, 1e-3);
  o.ledger = bench.range(1) != 0;
  NoSink sink;
  transient::TransientReport report;
  double seconds = 0;
  long steps = 0;
  for (auto _ : bench) {
    report = transient::integrate(model, o, sink);
    bench.SetIterationTime(report.cpu);
    seconds += report.cpu;
    steps += report.counters.steps;
  }
  bench.counters["us/step"] = 1e6 * seconds / static_cast<double>(steps);
  bench.counters["newton/step"] = static_cast<double>(report.counters.newtonIterations) /
                                  static_cast<double>(report.counters.steps);
  bench.counters["factorisations/step"] = static_cast<double>(report.counters.factorisations) /
                                          static_cast<double>(report.counters.steps);
  bench.counters["halved"] = static_cast<double>(report.counters.halved);
}
BENCHMARK(generalizedAlphaStep)
    ->Args({1, 0})
    ->Args({1, 1})
    ->Args({0, 0})
    ->Args({0, 1})
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

/// One step of RK4 (4 right-hand sides); 0.02 s each time. Argument: energy ledger.
void rungeKuttaStep(benchmark::State& bench) {
  const auto& model = settled(true);
  auto o = options("RK4", 1.0, 1.02, 0);
  o.ledger = bench.range(0) != 0;
  NoSink sink;
  double seconds = 0;
  long steps = 0;
  for (auto _ : bench) {
    const auto report = transient::integrate(model, o, sink);
    bench.SetIterationTime(report.cpu);
    seconds += report.cpu;
    steps += report.counters.steps;
    bench.counters["step us"] = 1e6 * report.counters.maxStep;
  }
  bench.counters["us/step"] = 1e6 * seconds / static_cast<double>(steps);
}
BENCHMARK(rungeKuttaStep)->Arg(0)->Arg(1)->UseManualTime()->Unit(benchmark::kMillisecond);

/// CPU seconds from the sample at `begin` to the one at `end`, and the state there.
struct Window final : transient::SampleSink {
  double begin, end, seconds = 0;
  Vector q;
  Window(double from, double to) : begin(from), end(to) {}
  void sample(double t, const Vector& now, const Vector&, const Vector&) override {
    const double clock = static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
    if (std::abs(t - begin) < 1e-9) seconds = -clock;
    if (std::abs(t - end) < 1e-9) seconds += clock, q = now;
  }
};

/// Share of the inner nodes that are at the wall.
double contactShare(const model::SecondOrderModel& model, const Vector& q) {
  const auto& set = model.points[0];
  const Vector d = set.rows * q;
  std::vector<int> points(static_cast<std::size_t>(set.law->size()));
  std::iota(points.begin(), points.end(), 0);
  std::vector<double> gap(points.size());
  set.law->clearanceLeft(points, d.data(), gap.data());
  return static_cast<double>(
             std::count_if(gap.begin(), gap.end(), [](double g) { return g <= 0; })) /
         static_cast<double>(gap.size());
}

/// Cost of a step against length: the string repeated end to end, so that the share of contacts is
/// the same. Arguments: elements; whether the steps of 1 ms are the 100 of the fall from the centre
/// line (0.02 to 0.12 s, to the first contacts) or 300 in contact (0.2 to 0.5 s). What comes before
/// is left out.
void longString(benchmark::State& bench) {
  const auto model = helicalString(longMesh(static_cast<std::size_t>(bench.range(0))), true);
  Window window(bench.range(1) != 0 ? 0.2 : 0.02, bench.range(1) != 0 ? 0.5 : 0.12);
  NoSink sink;
  const auto before =
      transient::integrate(model, options("Generalized-alpha", 0, window.begin, 1e-3), sink)
          .counters;
  auto o = options("Generalized-alpha", 0, window.end, 1e-3);
  o.sampling = 0.02;
  double seconds = 0;
  long iterations = 0, steps = 0, factorisations = 0;
  for (auto _ : bench) {
    const auto whole = transient::integrate(model, o, window).counters;
    bench.SetIterationTime(window.seconds);
    seconds += window.seconds;
    iterations += whole.newtonIterations - before.newtonIterations;
    factorisations += whole.factorisations - before.factorisations;
    steps += whole.steps - before.steps;
  }
  const auto perStep = [steps](long count) {
    return static_cast<double>(count) / static_cast<double>(steps);
  };
  bench.counters["dofs"] = model.size();
  bench.counters["contact share at the end"] = contactShare(model, window.q);
  bench.counters["iterations/step"] = perStep(iterations);
  bench.counters["factorisations/step"] = perStep(factorisations);
  bench.counters["ns/step/dof"] = 1e9 * seconds / static_cast<double>(steps) / model.size();
}
BENCHMARK(longString)
    ->ArgsProduct({{162, 1620, 16200}, {0, 1}})
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace

int main(int argc, char** argv) {
  tooljoint::linalg::shareLargePages();  // as the program does
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
}
