// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Reduction of 1, 10 and 100 identical pipes that carry no load, cut from a string in a straight
/// inclined well: parts that are identical but for rounding are found and reduced once.
#include <Teuchos_ParameterList.hpp>
#include <Tpetra_Core.hpp>
#include <benchmark/benchmark.h>
#include <map>
#include <string>
#include <vector>

#include "reduction/Reduce.hpp"
#include "substructures/drillstring/scene/Scene.hpp"
#include "substructures/drillstring/scene/Stages.hpp"

namespace {

using namespace tooljoint;

/// The pipes between the first and the last, which other supports hold.
const std::vector<model::Substructure>& pipes(long elements) {
  static std::map<long, std::vector<model::Substructure>> known;
  auto& inner = known[elements];
  if (inner.empty()) {
    const auto scene = drillstring::readScene(
        std::string(TOOLJOINT_SOURCE_DIR) + "/benchmarks/unloaded_pipes.xml",
        {"Drillstring/Components/pipe/Segments/body/Elements=" + std::to_string(elements)});
    const auto parts = drillstring::cut(scene, drillstring::solveStatic(scene));
    inner.assign(parts.begin() + 1, parts.end() - 1);
  }
  return inner;
}

void reduceIdenticalPipes(benchmark::State& state) {
  const auto& all = pipes(state.range(2));
  const std::vector<model::Substructure> parts(all.begin(), all.begin() + state.range(0));
  reduction::ReductionOptions options;
  options.modes.kind = reduction::ModeRule::Kind::PerPart;
  options.modes.counts = {static_cast<int>(state.range(1))};
  const auto basis = reduction::makeBasis("Craig-Bampton", Teuchos::ParameterList());
  int shared = 0;
  for (auto _ : state) {
    const auto reduced = reduction::reduceAll(parts, *basis, options);
    shared = 0;
    for (const auto& part : reduced) shared += part.report.sharedWith.empty() ? 0 : 1;
    benchmark::DoNotOptimize(reduced.data());
  }
  if (shared != state.range(0) - 1) state.SkipWithError("identical pipes were not found");
}
BENCHMARK(reduceIdenticalPipes)
    ->ArgNames({"pipes", "modes", "elements"})
    ->ArgsProduct({{1, 100}, {6, 12, 24}, {5, 10, 20, 30}})
    ->Unit(benchmark::kMillisecond);

}  // namespace

int main(int argc, char** argv) {
  Tpetra::ScopeGuard scope(&argc, &argv);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
