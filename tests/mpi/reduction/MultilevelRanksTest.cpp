// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The result for a part cut into substructures is the same on any number of ranks, and so are
/// errors.
#include <Teuchos_ParameterList.hpp>
#include <gtest/gtest.h>
#include <mpi.h>

#include "common/Communicator.hpp"
#include "common/Error.hpp"
#include "common/Parallel.hpp"
#include "reduction/Reduce.hpp"
#include "tests/support/SolidBlock.hpp"

namespace MultilevelRanksTest {

using namespace tooljoint;
using namespace tooljoint::reduction;

std::vector<ReducedSubstructure> reduced(const std::vector<model::Substructure>& parts,
                                         ModeRule::Kind kind) {
  Teuchos::ParameterList own("Multilevel");
  own.set("Parts", 6);
  own.set("Cut-off Factor", 2.0);
  own.set("Accuracy", 1e-6);
  own.set("Corrections", 2);
  ReductionOptions options;
  options.basis = "Multilevel";
  options.modes.kind = kind;
  options.modes.counts = {7};
  options.modes.total = 13;
  return reduceAll(parts, *MethodRegistry::instance().make("Multilevel", own), options);
}

TEST(MultilevelRanks, GiveTheReductionOfOne) {
  std::vector<model::Substructure> parts{samples::solidBlock(12, 3, 2),
                                         samples::solidBlock(8, 2, 2)};
  samples::classify(parts[0], {13}, {26});
  samples::classify(parts[1], {9});
  for (const auto kind : {ModeRule::Kind::PerPart, ModeRule::Kind::Total}) {
    const auto together = reduced(parts, kind);
    std::vector<ReducedSubstructure> alone;
    {
      const parallel::CommunicatorScope self(MPI_COMM_SELF);
      alone = reduced(parts, kind);
    }
    for (std::size_t p = 0; p < parts.size(); ++p) {
      ASSERT_EQ(together[p].size(), alone[p].size());
      for (const auto& [a, b] :
           {std::pair{together[p].model.stiffnessAt(0), alone[p].model.stiffnessAt(0)},
            std::pair{Sparse(together[p].model.mass), Sparse(alone[p].model.mass)}})
        EXPECT_LT((Matrix(a) - Matrix(b)).norm(), 1e-10 * Matrix(b).norm());
    }
  }
}

TEST(MultilevelRanks, EveryRankHasTheError) {
  std::vector<model::Substructure> parts{samples::solidBlock(4, 2, 2)};
  parts[0].model.mass = Sparse(-1.0 * Sparse(parts[0].model.mass));
  EXPECT_THROW(reduced(parts, ModeRule::Kind::PerPart), ModelError);
}

}  // namespace MultilevelRanksTest
