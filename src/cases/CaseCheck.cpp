// SPDX-License-Identifier: BSD-3-Clause
#include "cases/CaseCheck.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "cases/CaseLists.hpp"
#include "cases/ReducedCase.hpp"
#include "cases/recording/RecordedNodes.hpp"
#include "cases/run/Report.hpp"
#include "cases/run/Run.hpp"
#include "common/Text.hpp"
#include "common/report/Log.hpp"
#include "reduction/selection/ModeSelection.hpp"

namespace tooljoint::cases {

namespace {

/// "modelled" and "not modelled" lines, aligned.
void list(const OutlineItem& item) {
  char line[512];
  std::snprintf(line, sizeof line, "  %-3s %-24s %s", item.present ? "yes" : "no",
                item.what.c_str(), item.why.c_str());
  log::info(line);
}

/// Choice of the modes if a tolerance determines it, and estimated errors.
void listEstimates(const Teuchos::ParameterList& reduction) {
  std::vector<std::string> tolerances;
  for (const char* name : {"Frequency Tolerance", "Motion Tolerance"})
    if (const double tolerance = reduction::toleranceOf(reduction, name); tolerance > 0)
      tolerances.push_back(std::string(name) + " " + formatNumber(tolerance));
  if (!tolerances.empty())
    list({true, "modes by tolerance",
          join(tolerances, ", ") + ": in rounds" +
              (reduction::selectsModesBy(reduction, "Motion Tolerance") ? ", each with a transient"
                                                                        : "")});
  const auto estimated = reduction.get<std::string>("Error Estimate");
  list({estimated != "None", "error estimate",
        estimated == "None" ? "Error Estimate is None" : "a posteriori, \"" + estimated + "\""});
}

/// Treatment of the joined dofs.
void listInterfaces(const Teuchos::ParameterList& reduction) {
  const auto name = reduction.get<std::string>("Interface Reduction");
  list({name != "None", "interface reduction",
        name == "None" ? "all joined dofs are kept"
                       : "characteristic constraint modes, \"" + name + "\""});
}

void listTransient(const Case& one) {
  if (!one.moves()) {
    list({false, "transient", "no Transient list: the run stops at the static state"});
    return;
  }
  const auto& transient = one.transient();
  const double duration = transient.get<double>("End Time") - transient.get<double>("Start Time");
  const double samples = std::floor(duration / transient.get<double>("Sampling Interval")) + 1.0;
  std::string what =
      transient.get<std::string>("Integrator") + " over " + formatNumber(duration) + " s";
  if (transient.isParameter("Step"))
    what += ", about " + countText(std::ceil(duration / transient.get<double>("Step"))) + " steps";
  list({true, "transient", what});
  const auto& output = one.output();
  const double bytes =
      8.0 * samples * static_cast<double>(recordedCount(one)) *
      (one.components() * (output.hasField("displacement") + output.hasField("velocity") +
                           output.hasField("acceleration")) +
       output.hasField("normal_force"));
  list({true, "results.h5",
        countText(samples) + " samples, about " + countText(std::ceil(bytes / 1e6)) + " MB"});
}

void listWork(const Case& one, const CaseOutline& outline) {
  log::info("computed:");
  list(outline.rest);
  if (one.reduces()) {
    list({true, "reduction", outline.reduction});
    listEstimates(one.reduction());
    listInterfaces(one.reduction());
  } else {
    list({false, "reduction", "no Reduction list: the full model runs"});
  }
  list(outline.coupling);
  for (const auto& note : outline.notes) log::info(note);
  listTransient(one);
}

std::vector<OutlineItem> analysesOf(const Case& one) {
  std::vector<OutlineItem> found;
  for (const auto& analysis : AnalysisLists::instance().lists()) {
    const bool given = one.list().isSublist(analysis.name);
    if (!given && analysis.without.empty()) continue;
    std::string name = analysis.name;
    std::transform(name.begin(), name.end(), name.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    found.push_back({given, name, given ? analysis.describe(one) : analysis.without});
  }
  return found;
}

/// Solves for the state at rest and reduces the case, to compare the cost of both models.
void listCost(const Case& one) {
  if (!one.reduces() || !one.moves()) {
    log::info("cost        nothing to compare: the deck has " +
              std::string(one.moves() ? "no Reduction list" : "no Transient list"));
    return;
  }
  const auto rest = one.atRest();
  const auto text = rest->describe();
  if (!text.empty()) log::info(text);
  const auto reduced = reduce(one, *rest);
  if (!reduced.tried.empty()) log::info(describeCuts(reduced));
  log::info(predictCost(one, rest->full().model, reduced.model()));
}

}  // namespace

void check(const Case& one, bool cost) {
  one.verify();
  const auto outline = one.outline();
  const auto analyses = analysesOf(one);
  log::info(one.deck().file() + " is a valid deck.");
  announce(one);
  log::info("modelled:");
  for (const auto& item : outline.modelled) list(item);
  listWork(one, outline);
  for (const auto& item : analyses) list(item);
  if (cost) listCost(one);
}

}  // namespace tooljoint::cases
