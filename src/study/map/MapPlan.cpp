// SPDX-License-Identifier: BSD-3-Clause
#include "study/map/MapPlan.hpp"

#include <utility>

#include "cases/CaseLists.hpp"
#include "common/Error.hpp"
#include "common/Text.hpp"
#include "study/engine/RunDecks.hpp"

namespace tooljoint::study {

namespace {

std::vector<PlannedRun> expand(const MapSettings& settings) {
  std::vector<Dimension> dimensions;
  for (const auto& axis : settings.axes) dimensions.push_back(axis.dimension);
  PlannedRun base;
  base.source = "Map/Grid";
  return product(dimensions, base, base.source);
}

void requireMotion(const cases::Case& scene, const MapSettings& settings, RunDecks& decks) {
  for (const auto& value : settings.values)
    if (value.key.rfind("transient.", 0) == 0 && !scene.moves())
      decks.fault("Map/Values/" + value.name + "/Key",
                  "is " + inQuotes(value.key) +
                      " of a motion, and the scene has no Transient list. Add one.");
}

const bool mapPlanRegistered = cases::AnalysisLists::instance().add(
    {"Map", mapParameters, [](const Teuchos::ParameterList& list) { readMap(list); },
     [](const cases::Case& scene) { return describe(planMap(scene)); },
     "no Map list: give its Grid and Values (tooljoint map)"});

}  // namespace

MapPlan planMap(const cases::Case& scene, const std::string& row) {
  if (!scene.list().isSublist("Map"))
    throw DeckError(scene.deck().file() + ": /" + scene.deck().name() +
                    " has no Map list, so there is nothing to map. Add one; tooljoint doc Map "
                    "describes it.");
  MapPlan plan;
  plan.settings = readMap(scene.list().sublist("Map"));
  RunDecks decks(scene);
  requireMotion(scene, plan.settings, decks);
  auto planned = expand(plan.settings);
  const auto only = row.empty() ? planned.size() : rowNumber(row, planned.size(), "map");
  for (std::size_t i = 0; i < planned.size(); ++i) {
    const bool wanted = row.empty() || i == only;
    MapPoint point;
    try {
      if (wanted) point.scene = decks.read(planned[i], {});
    } catch (const ModelError& error) {
      point.fault = error.what();  // a missing cell
    }
    point.plan = std::move(planned[i]);
    plan.points.push_back(std::move(point));
  }
  decks.raise();
  return plan;
}

std::string describe(const MapPlan& plan) {
  std::vector<std::string> axes, values;
  for (const auto& axis : plan.settings.axes)
    axes.push_back(axis.dimension.name + " (" + std::to_string(axis.dimension.values.size()) + ")");
  for (const auto& value : plan.settings.values) values.push_back(value.key);
  return std::to_string(plan.points.size()) + " points: " + join(axes, " x ") + "; " +
         join(values, ", ") + " (tooljoint map)";
}

}  // namespace tooljoint::study
