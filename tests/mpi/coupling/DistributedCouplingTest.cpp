// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The frequencies of a frame with a loop on any number of ranks, coupled primal, dual and with
/// interface reductions, against those of a single rank and against the frame as one piece.
#include <Teuchos_ParameterList.hpp>
#include <gtest/gtest.h>

#include "common/Parallel.hpp"
#include "coupling/CoupledModes.hpp"
#include "coupling/Synthesis.hpp"
#include "coupling/interface/InterfaceReduction.hpp"
#include "tests/support/SpaceFrame.hpp"

namespace DistributedCouplingTest {

using namespace tooljoint;
using namespace tooljoint::coupling;

constexpr int kModes = 20, kKept = 10;

struct Way {
  std::string name;
  Assembly assembly;
  std::shared_ptr<const reduction::InterfaceBasis> interface;
};

std::vector<Way> ways() {
  reduction::InterfaceOptions twelve, four;
  twelve.modes = 12;
  four.modes = 4;
  return {{"primal", Assembly::Primal, nullptr},
          {"dual", Assembly::Dual, nullptr},
          {"system", Assembly::Primal, reduction::systemInterfaceModes(twelve)},
          {"local", Assembly::Primal, reduction::localInterfaceModes(four)}};
}

/// Members in their own axes, so that frames take part too.
const std::vector<int> own{1, 3};

CouplingOptions options(const samples::FiveMembers& frame, const Way& way) {
  CouplingOptions chosen;
  chosen.assembly = way.assembly;
  chosen.connections.frames = frame.frames(own);
  return chosen;
}

/// Result of one rank without the others.
Vector alone(const samples::FiveMembers& frame, const Way& way) {
  const auto basis = reduction::makeBasis("Craig-Bampton", Teuchos::ParameterList());
  const auto parts = frame.parts(own);
  std::vector<reduction::ReducedSubstructure> reduced;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    reduction::ModeRequest request;
    request.kind = reduction::ModeRequest::Kind::Count;
    request.count = kKept;
    reduced.push_back(
        reduction::reduce(parts[p], basis->build(parts[p], request), {}, static_cast<int>(p)));
  }
  auto coupled = coupleWithPositions(reduced, options(frame, way));
  if (way.interface) reduceInterfaces(coupled, *way.interface);
  return lowestModes(coupled.model, kModes).values;
}

TEST(DistributedCoupling, FrequenciesDoNotDependOnTheRanks) {
  const samples::FiveMembers frame{8};
  const Vector exact = lowestModes(frame.whole().model, kModes).values;
  reduction::ReductionOptions chosen;
  chosen.modes.kind = reduction::ModeRule::Kind::PerPart;
  chosen.modes.counts = {kKept};
  const auto basis = reduction::makeBasis("Craig-Bampton", Teuchos::ParameterList());
  for (const Way& way : ways()) {
    chosen.interface = way.interface;
    const auto together = synthesise(frame.parts(own), *basis, chosen, options(frame, way));
    const Vector found = lowestModes(together.coupled.model, kModes).values,
                 expected = alone(frame, way);
    for (int i = 0; i < kModes; ++i) {
      // frequencies to 1e-10: their squares to 2e-10
      EXPECT_NEAR(found[i] / expected[i], 1.0, 2e-10) << way.name << ", mode " << i + 1;
      EXPECT_GE(found[i], exact[i] * (1 - 1e-9)) << way.name << ", mode " << i + 1;
    }
    Vector root = found;
    parallel::broadcast(root, 0);
    EXPECT_EQ(parallel::maximum((root - found).cwiseAbs().maxCoeff()), 0.0)
        << "every rank holds the same numbers";
    if (!way.interface) {
      EXPECT_NEAR(found[0] / exact[0], 1.0, 1e-4) << way.name;
    }
  }
}

}  // namespace DistributedCouplingTest
