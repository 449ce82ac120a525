// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A string in its well as a case: from its deck to a static state that can be divided into parts,
/// reduced and integrated in time.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "cases/Case.hpp"
#include "cases/recording/RecordedNodes.hpp"
#include "substructures/drillstring/scene/Scene.hpp"
#include "substructures/drillstring/scene/Stages.hpp"

namespace tooljoint::drillstring {

class DrillstringCase : public cases::Case, public cases::NodeChoice {
 public:
  explicit DrillstringCase(Scene scene);

  const deck::Deck& deck() const override { return scene_->deck; }
  std::unique_ptr<cases::Case> with(const std::vector<std::string>& overrides) const override;
  std::unique_ptr<cases::Case> turningAt(double speed) const override;
  std::vector<std::string> reductionLists() const override {
    return {"Substructures", "Reduction"};
  }
  /// The choices of `Substructures/Rule` "By cost".
  std::vector<std::vector<cases::Overrides>> openChoices() const override;
  bool reducesWithoutMotion() const override { return false; }
  const io::OutputSettings& output() const override { return scene_->output; }
  /// The nodes nearest to `Output/Depths`.
  std::vector<std::int64_t> recordedNodes() const override;
  std::string files() const override;
  int nodes() const override { return scene_->string.nodeCount(); }
  int components() const override;
  int freeDofs() const override { return scene_->freeDofs(); }
  std::string describe() const override;
  std::vector<std::string> remarks() const override;
  void summarise(io::Summary& summary) const override;
  cases::CaseOutline outline() const override;
  /// Computes the static state if no support holds the string along its axis: only that state shows
  /// whether it floats.
  void verify() const override;
  /// Path and static state. Those of an earlier case are reused if only Substructures, Coupling,
  /// Reduction, Output and Transient without its Start Time differ: friction, drive and bit of the
  /// static state depend on the time at which the motion starts.
  std::shared_ptr<const cases::RestingCase> solveStatic() const override;

  const Scene& scene() const { return *scene_; }

 private:
  /// Static states by the lists they depend on.
  using FoundStates = std::map<std::string, std::shared_ptr<const StaticStage>>;

  std::shared_ptr<const Scene> scene_;
  std::shared_ptr<FoundStates> found_;
};

}  // namespace tooljoint::drillstring
