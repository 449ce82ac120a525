// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "app/PartsDeck.hpp"
#include "app/ResultsWriter.hpp"
#include "app/Scene.hpp"
#include "app/Stages.hpp"
#include "app/StudyScene.hpp"
#include "io/TextFile.hpp"
#include "study/RowStore.hpp"

namespace tooljoint::app {

namespace {

/// Static states by the lists they depend on.
using StaticStages = std::map<std::string, std::shared_ptr<const StaticStage>>;

/// A string in its well.
class StringStudy : public StudyScene {
 public:
  StringStudy(Scene scene, std::shared_ptr<StaticStages> stages)
      : scene_(std::move(scene)), stages_(std::move(stages)) {}

  const deck::Deck& deck() const override { return scene_.deck; }
  std::unique_ptr<StudyScene> with(const std::vector<std::string>& overrides) const override {
    return std::make_unique<StringStudy>(readScene(scene_.deck.file(), overrides), stages_);
  }
  std::vector<std::string> reductionLists() const override {
    return {"Substructures", "Reduction"};
  }
  int nodes() const override { return scene_.string.nodeCount(); }
  std::string folder() const override { return scene_.output.folder; }

  std::string files() const override {
    std::string text;
    const auto file = [&](const Teuchos::ParameterList& list, const char* name) {
      if (list.isParameter(name))
        text += "\n" + io::readText(scene_.deck.resolve(list.get<std::string>(name)));
    };
    file(scene_.list().sublist("Drillstring"), "Library");
    const auto& well = scene_.list().sublist("Well");
    if (well.isSublist("Survey")) file(well.sublist("Survey"), "File");
    return text;
  }

  void summarise(io::Summary& summary) const override { app::summarise(scene_, summary); }

  /// Path and static state; those of an earlier scene when Substructures, Coupling, Reduction,
  /// Transient and Output alone differ.
  void settle() override {
    auto lists = scene_.list();
    for (const char* name : {"Substructures", "Coupling", "Reduction", "Transient", "Output"})
      lists.remove(name, false);
    auto& stage = (*stages_)[study::canonicalText(lists)];
    if (!stage) stage = std::make_shared<const StaticStage>(app::settle(scene_));
    stage_ = stage;
  }

  coupling::Coupling full() const override {
    if (scene_.coupling) return joinUnreduced(resolvedParts(scene_, *stage_));
    coupling::Coupling whole;
    whole.model = fullModel(*stage_);
    return whole;
  }

  coupling::ResolvedCoupling parts() const override { return resolvedParts(scene_, *stage_); }
  Vector rest() const override { return stage_->state.displacement; }

  Measures measures() const override {
    Measures m;
    const int count = nodes();
    for (int node = 1; node <= count; ++node) m.nodes.push_back(node);
    m.components = {0, 1, 2};
    m.vibrating = 2;
    m.clearance.assign(m.nodes.size(), std::numeric_limits<double>::infinity());
    const auto& points = scene_.contactPoints;
    for (int p = 0; p < points.size(); ++p) {
      const auto i = static_cast<std::size_t>(p);
      m.clearance[static_cast<std::size_t>(points.node[i] - 1)] = points.clearance[i];
    }
    m.speedRow = drillstring::kNodeDofs * count - 1;  // theta_z of the last node
    const auto rotary = scene_.rotary;
    m.turning = [rotary](double t) { return rotary.speed(t); };
    return m;
  }

  void write(io::ResultsFile& file) const override {
    std::vector<double> s, clearance, radius;
    const auto& state = stage_->state;
    for (int i = 0; i < nodes(); ++i) {
      const auto& node = scene_.string.nodes[static_cast<std::size_t>(i)];
      s.push_back(node.s);
      clearance.push_back(node.clearance);
      radius.push_back(std::hypot(state.displacement(6 * i), state.displacement(6 * i + 1)));
    }
    const auto elements = static_cast<std::size_t>(state.axialForce.size());
    file.write("/profile/s", s, {s.size()}, "m", "Depth of the nodes along the well");
    file.write("/profile/clearance", clearance, {s.size()}, "m",
               "Radial clearance between node and wall");
    file.write("/profile/radius", radius, {s.size()}, "m",
               "Static lateral distance of the nodes from the well axis");
    file.write("/profile/normal_force", state.normalForce, {s.size()}, "N",
               "Static normal contact force");
    file.write("/profile/axial_force", state.axialForce, {elements}, "N",
               "Static axial force of the elements, tension positive");
    file.write("/profile/torque", state.torque, {elements}, "N m", "Static torque of the elements");
  }

 private:
  Scene scene_;
  std::shared_ptr<StaticStages> stages_;
  std::shared_ptr<const StaticStage> stage_;
};

}  // namespace

std::unique_ptr<StudyScene> readStringStudy(const RunOptions& options) {
  return std::make_unique<StringStudy>(readScene(options.deck, options.overrides),
                                       std::make_shared<StaticStages>());
}

std::unique_ptr<StudyScene> readStudyScene(const RunOptions& options) {
  return isPartsDeck(options) ? readPartsStudy(options) : readStringStudy(options);
}

}  // namespace tooljoint::app
