// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drillstring/case/DrillstringCase.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "cases/CaseKinds.hpp"
#include "cases/CaseLists.hpp"
#include "cases/ListText.hpp"
#include "common/Error.hpp"
#include "common/Text.hpp"
#include "deck/PrintedUnits.hpp"
#include "io/TextFile.hpp"
#include "parts/ReducedPart.hpp"
#include "substructures/beam/NodalDofs.hpp"
#include "substructures/drillstring/assembly/Libraries.hpp"
#include "substructures/drillstring/case/StringOutline.hpp"
#include "substructures/drillstring/case/StringRecord.hpp"
#include "substructures/drillstring/case/StringResults.hpp"
#include "substructures/drillstring/case/UsualRanges.hpp"
#include "substructures/drillstring/figures/BendingElements.hpp"
#include "substructures/drillstring/scene/CutByCost.hpp"
#include "substructures/drillstring/scene/Remarks.hpp"
#include "substructures/drillstring/scene/StringStability.hpp"

namespace tooljoint::drillstring {

namespace {

/// A string at rest in its well.
class RestingString : public cases::RestingCase {
 public:
  RestingString(std::shared_ptr<const Scene> scene, std::shared_ptr<const StaticStage> stage)
      : sharedScene_(std::move(scene)),
        sharedStage_(std::move(stage)),
        scene_(*sharedScene_),
        stage_(*sharedStage_) {}

  void judge() const override { judgeStatic(scene_, stage_); }

  coupling::Coupling full() const override {
    if (scene_.coupling) return joinUnreduced(resolvedParts(scene_, stage_));
    coupling::Coupling whole;
    whole.model = fullModel(stage_);
    return whole;
  }
  coupling::ResolvedCoupling parts() const override { return resolvedParts(scene_, stage_); }
  Vector rest() const override { return stage_.state.displacement; }

  cases::Measures measures() const override {
    cases::Measures m;
    const int count = scene_.string.nodeCount();
    for (int node = 1; node <= count; ++node) m.nodes.push_back(node);
    for (const auto& node : scene_.string.nodes) m.depth.push_back(node.s);
    m.bending = bendingPlaces(scene_.string, stage_.path, elementsBelowReleases(scene_, stage_));
    m.components = {0, 1, 2};
    m.vibrating = 2;
    m.clearance.assign(m.nodes.size(), std::numeric_limits<double>::infinity());
    const auto& points = scene_.contactPoints;
    for (int p = 0; p < points.size(); ++p) {
      const auto i = static_cast<std::size_t>(p);
      m.clearance[static_cast<std::size_t>(points.node[i] - 1)] = points.clearance[i];
    }
    m.wall = kContactSet;
    m.speedRow = kNodeDofs * (count - 1) + beam::nodal::thetaZ;
    const auto rotary = scene_.rotary;
    m.turning = [rotary](double t) { return rotary.speed(t); };
    return m;
  }

  std::string describe() const override { return describeStatic(scene_, stage_); }
  void summarise(io::Summary& summary) const override {
    drillstring::summarise(scene_, stage_, summary);
  }
  std::vector<cases::RestFigure> figures() const override { return restFigures(stage_); }
  void write(io::ResultsFile& file) const override {
    writeModel(scene_, stage_, file);
    writeSections(scene_, file);
    writeBending(scene_, stage_, file);
    writePath(stage_, file);
    writeStatic(scene_, stage_, file);
  }
  void stageTables(io::OutputFolder& folder) const override {
    stageStaticTables(scene_, stage_, folder);
  }
  void writeProfile(io::ResultsFile& file) const override {
    drillstring::writeProfile(scene_, stage_, file);
  }

  std::unique_ptr<cases::MotionRecord> record(const model::SecondOrderModel& model) const override {
    return std::make_unique<StringRecord>(scene_, stage_, model);
  }
  std::vector<parts::PartContent> contents(
      const std::vector<model::Substructure>& parts) const override {
    std::vector<parts::PartContent> out;
    for (const auto& part : parts) out.push_back(parts::contentOf(part));
    return out;
  }

 private:
  std::shared_ptr<const Scene> sharedScene_;
  std::shared_ptr<const StaticStage> sharedStage_;
  const Scene& scene_;
  const StaticStage& stage_;
};

const bool drillstringCaseRegistered = cases::CaseKinds::instance().add(
    {{"Drillstring", "Well"}, 1, sceneSpec, [](const deck::Deck& deck) {
       return std::make_unique<DrillstringCase>(readScene(deck));
     }});

}  // namespace

DrillstringCase::DrillstringCase(Scene scene)
    : scene_(std::make_shared<const Scene>(std::move(scene))),
      found_(std::make_shared<FoundStates>()) {}

std::unique_ptr<cases::Case> DrillstringCase::with(
    const std::vector<std::string>& overrides) const {
  auto other = std::make_unique<DrillstringCase>(readScene(deck().with(overrides)));
  other->found_ = found_;
  return other;
}

std::vector<std::vector<cases::Overrides>> DrillstringCase::openChoices() const {
  return cutsByCost(*scene_);
}

std::unique_ptr<cases::Case> DrillstringCase::turningAt(double speed) const {
  if (!scene_->rotary.present()) return nullptr;
  return std::make_unique<DrillstringCase>(drillstring::turningAt(*scene_, speed));
}

std::vector<std::int64_t> DrillstringCase::recordedNodes() const {
  const auto& nodes = scene_->string.nodes;
  const auto wanted = cases::listOrDefaults(list(), io::parameters());
  if (wanted.isParameter("Nodes"))
    throw DeckError(deck().error(
        "Output/Nodes", "names nodes of parts. Those of a string are chosen by Output/Depths."));
  std::set<std::int64_t> chosen;
  if (!wanted.isParameter("Depths")) return {};
  for (const double depth : wanted.get<Teuchos::Array<double>>("Depths")) {
    if (depth > nodes.back().s + 1e-6)
      throw DeckError(deck().error("Output/Depths", "has " + deck::printed(depth, "m") +
                                                        ", but the string ends at " +
                                                        deck::printed(nodes.back().s, "m") +
                                                        ". Give depths above its end."));
    const auto nearest =
        std::min_element(nodes.begin(), nodes.end(), [depth](const auto& a, const auto& b) {
          return std::abs(a.s - depth) < std::abs(b.s - depth);
        });
    chosen.insert(std::distance(nodes.begin(), nearest) + 1);
  }
  return {chosen.begin(), chosen.end()};
}

std::string DrillstringCase::files() const {
  std::string text;
  const auto file = [&](const Teuchos::ParameterList& list, const char* name) {
    if (!list.isParameter(name)) return;
    const auto builtIn = componentLibraries().find(list.get<std::string>(name));
    text += "\n" + (builtIn == componentLibraries().end()
                        ? io::readText(deck().resolve(list.get<std::string>(name)))
                        : builtIn->second);
  };
  file(list().sublist("Drillstring"), "Library");
  file(list().sublist("Drillstring"), "Pipe Table");
  const auto& well = list().sublist("Well");
  if (well.isSublist("Survey")) file(well.sublist("Survey"), "File");
  return text;
}

int DrillstringCase::components() const { return kNodeDofs; }

std::string DrillstringCase::describe() const { return describeScene(*scene_); }

std::vector<std::string> DrillstringCase::remarks() const {
  auto found = unusualValues(deck());
  if (const auto remark = prestressRemark(*scene_); !remark.empty()) found.push_back(remark);
  for (const auto& remark : {bitFrictionRemark(*scene_), unbalanceRemark(*scene_),
                             axialFrictionRemark(*scene_), torqueOnBitRemark(*scene_)})
    if (!remark.empty()) found.push_back(remark);
  return found;
}

void DrillstringCase::summarise(io::Summary& summary) const {
  drillstring::summarise(*scene_, summary);
}

cases::CaseOutline DrillstringCase::outline() const { return outlineOf(*scene_); }

void DrillstringCase::verify() const {
  if (!freeDirections(*scene_).empty()) atRest();
}

std::shared_ptr<const cases::RestingCase> DrillstringCase::solveStatic() const {
  auto lists = list();
  for (const char* name : {"Substructures", "Coupling", "Reduction", "Transient", "Output"})
    lists.remove(name, false);
  auto& found = (*found_)[cases::canonicalText(lists) + formatNumber(scene_->startTime())];
  if (!found) found = std::make_shared<const StaticStage>(findEquilibrium(*scene_));
  return std::make_shared<RestingString>(scene_, found);
}

}  // namespace tooljoint::drillstring
