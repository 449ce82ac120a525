// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Reduce and couple in one call, and the second hook of a basis.
#include "coupling/Synthesis.hpp"

#include <Teuchos_ParameterList.hpp>
#include <gtest/gtest.h>

#include "common/Error.hpp"
#include "reduction/ReductionParameters.hpp"
#include "tests/support/ListDefaults.hpp"
#include "tests/support/SampleParts.hpp"

namespace SynthesisTest {

using namespace tooljoint;
using namespace tooljoint::coupling;
using reduction::Basis;

/// Craig-Bampton that drops one mode of every part per round until `least` are left (or never
/// stops).
class Shrinking : public reduction::ReductionMethod {
 public:
  explicit Shrinking(int least)
      : least_(least), base_(reduction::makeBasis("Craig-Bampton", Teuchos::ParameterList())) {}
  Basis build(const reduction::PartView& part,
              const reduction::ModeRequest& request) const override {
    return base_->build(part, request);
  }
  bool augment(const model::SecondOrderModel& coupled,
               const std::vector<std::vector<int>>& positions,
               const std::vector<reduction::PartView>& parts,
               std::vector<Basis>& bases) const override {
    EXPECT_EQ(positions.size(), parts.size());
    int columns = 0;
    for (const auto& position : positions)
      columns = std::max(columns, *std::max_element(position.begin(), position.end()) + 1);
    EXPECT_EQ(columns, coupled.size());
    bool changed = least_ < 0;
    for (auto& basis : bases)
      if (basis.modes() > least_ && basis.modes() > 0) {
        reduction::truncate(basis, basis.modes() - 1, "dropped by augment()");
        changed = true;
      }
    return changed;
  }

 private:
  int least_;
  std::unique_ptr<reduction::ReductionMethod> base_;
};

reduction::ReductionOptions sixModes() {
  reduction::ReductionOptions options;
  options.modes.kind = reduction::ModeRule::Kind::PerPart;
  options.modes.counts = {6};
  return options;
}

TEST(Synthesis, IsReduceAndCouple) {
  auto list = test::defaultsOf(reduction::parameters());
  list.sublist("Mode Selection").set("Modes", 3);
  const auto parts = samples::loopFrame(6, true);
  const Synthesis synthesis = synthesise(parts, list);
  const auto coupled = couple(reduction::reduceAll(parts, list));
  EXPECT_TRUE(synthesis.coupled.model.dofs == coupled.dofs);
  EXPECT_EQ((Matrix(synthesis.coupled.model.mass) - Matrix(coupled.mass)).norm(), 0.0);
}

TEST(Synthesis, CouplesAgainAfterEveryImprovement) {
  const auto parts = samples::loopFrame(6, true);
  const Synthesis synthesis = synthesise(parts, Shrinking(2), sixModes());
  for (const auto& part : synthesis.parts) {
    EXPECT_EQ(part.modes, 2);
    EXPECT_NE(part.report.table().find("dropped by augment()"), std::string::npos);
  }
  EXPECT_EQ(synthesis.coupled.model.size(), 6 + 4 * 2);
}

TEST(Synthesis, ImprovementWithoutEndIsAnError) {
  EXPECT_THROW(synthesise(samples::loopFrame(6, true), Shrinking(-1), sixModes()),
               ConvergenceError);
}

}  // namespace SynthesisTest
