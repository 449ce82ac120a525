// SPDX-License-Identifier: BSD-3-Clause
#include "study/engine/StudyPlan.hpp"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <map>
#include <set>
#include <utility>

#include "cases/CaseLists.hpp"
#include "cases/ListText.hpp"
#include "common/Error.hpp"
#include "common/Text.hpp"
#include "deck/reading/FileName.hpp"
#include "io/TextFile.hpp"
#include "study/engine/RunDecks.hpp"
#include "study/reference/FittedReference.hpp"
#include "transient/TransientParameters.hpp"
#include "transient/schemes/DefaultStep.hpp"

namespace tooljoint::study {

namespace {

constexpr std::size_t listedRuns = 12;  ///< in a fault

double transientNumber(const cases::Case& scene, const char* name) {
  return scene.transient().get<double>(name);
}

/// The lists of a deck that affect the computation.
Teuchos::ParameterList computed(const cases::Case& scene) {
  auto list = scene.list();
  list.remove("Output", false);
  if (list.isSublist("Transient"))
    for (const char* name : {"Progress", "Checkpoint Interval"})
      list.sublist("Transient").remove(name, false);
  return list;
}

/// Files of the basis "User Vectors", for every part that "%" in their name can stand for.
std::vector<std::string> vectorFiles(const cases::Case& scene) {
  if (!scene.reduces() || !scene.reduction().isSublist("User Vectors")) return {};
  const auto& list = scene.reduction().sublist("User Vectors");
  if (!list.isParameter("File")) return {};
  const std::filesystem::path pattern(deck::fileName(list, "File"));
  const auto name = pattern.filename().string();
  const auto mark = name.find('%');
  const auto fits = [&](const std::string& file) {
    if (mark == std::string::npos) return file == name;
    const auto tail = name.substr(mark + 1);
    return file.size() + 1 >= name.size() && file.compare(0, mark, name, 0, mark) == 0 &&
           file.compare(file.size() - tail.size(), tail.size(), tail) == 0;
  };
  std::vector<std::string> files;
  std::error_code failed;
  for (const auto& entry : std::filesystem::directory_iterator(
           pattern.has_parent_path() ? pattern.parent_path() : ".", failed))
    if (entry.is_regular_file() && fits(entry.path().filename().string()))
      files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  return files;
}

bool changesTransient(const std::string& override) {
  const std::string list = "Transient";
  const auto begin = override.find_first_not_of("!/ ");
  return begin != std::string::npos && override.compare(begin, list.size(), list) == 0;
}

/// Step of an implicit integrator [s]; 0 for an integrator that chooses its steps.
double stepOf(const cases::Case& scene) {
  const auto& list = scene.transient();
  if (transient::isExplicit(list)) return 0.0;
  if (list.isType<double>("Step")) return list.get<double>("Step");
  return list.get<std::string>("Integrator") == "Generalized-alpha" ? transient::defaultAlphaStep
                                                                    : 0.0;
}

/// 0 for "reference" and for "1".
std::size_t numberOf(std::size_t runs, const std::string& row) {
  return row == "reference" ? 0 : rowNumber(row, runs, "study");
}

class Planner {
 public:
  Planner(const cases::Case& scene, const std::string& row)
      : scene_(scene), row_(row), decks_(scene) {}

  StudyPlan plan() {
    if (!scene_.list().isSublist("Study"))
      throw DeckError(scene_.deck().file() + ": /" + scene_.deck().name() +
                      " has no Study list, so there is nothing to compare. Add one; tooljoint doc "
                      "Study describes it.");
    if (!scene_.moves())
      throw DeckError(scene_.deck().error(
          "Study", "compares motions, and the scene has no Transient list. Add one."));
    plan_.settings = readStudy(scene_.list().sublist("Study"));
    span();
    auto methods = expand(plan_.settings, scene_.reductionLists());
    if (plan_.settings.check.empty()) fitReference(plan_.settings, shortestStep(methods));
    auto planned = references(plan_.settings, scene_.reductionLists());
    for (auto& run : methods) planned.push_back(std::move(run));
    baseline(planned);
    const auto only = row_.empty() ? 0 : numberOf(planned.size(), row_);
    for (std::size_t i = 0; i < planned.size(); ++i) {
      const bool companion = planned[i].kind != RunKind::Method && only == 0;
      if (row_.empty() || i == 0 || i == only || companion)
        add(std::move(planned[i]));
      else
        plan_.runs.push_back({std::move(planned[i]), nullptr, i});
    }
    decks_.raise();
    compare();
    decks_.raise();
    return std::move(plan_);
  }

 private:
  void fault(const std::string& path, const std::string& sentence) { decks_.fault(path, sentence); }

  void span() {
    plan_.start = transientNumber(scene_, "Start Time");
    plan_.end = plan_.settings.end.value_or(transientNumber(scene_, "End Time"));
    const double window =
        plan_.settings.window.value_or(std::min(defaultWindow, plan_.simulated()));
    plan_.windowEnd = plan_.start + window;
    if (!(plan_.end > plan_.start))
      fault("Study/End Time", "is " + formatNumber(plan_.end) + " s, but the motion starts at " +
                                  formatNumber(plan_.start) + " s.");
    else if (plan_.windowEnd > plan_.end * (1.0 + 1e-12))
      fault("Study/Window", "reaches to " + formatNumber(plan_.windowEnd) +
                                " s, but the runs end at " + formatNumber(plan_.end) +
                                " s. Shorten it, or raise Study/End Time.");
    else if (window < transientNumber(scene_, "Sampling Interval"))
      fault("Study/Window", "of " + formatNumber(window) +
                                " s is shorter than Transient/Sampling Interval (" +
                                formatNumber(transientNumber(scene_, "Sampling Interval")) +
                                " s): no motion would be compared.");
    decks_.raise();
  }

  /// Shortest step of the implicit runs with steps given in the deck [s]; 0 without such runs. Each
  /// different list Transient is read once.
  double shortestStep(const std::vector<PlannedRun>& methods) {
    std::set<std::string> seen;
    double shortest = 0.0;
    for (auto run : methods) {
      auto& own = run.overrides;
      own.erase(
          std::remove_if(own.begin(), own.end(),
                         [](const SourcedOverride& one) { return !changesTransient(one.text); }),
          own.end());
      std::string key;
      for (const auto& one : own) key += one.text + "\n";
      if (!seen.insert(key).second) continue;
      const auto moved = decks_.read(run, {});
      const double step = moved && moved->moves() ? stepOf(*moved) : 0.0;
      if (step > 0.0) shortest = shortest > 0.0 ? std::min(shortest, step) : step;
    }
    return shortest;
  }

  void add(PlannedRun run) {
    auto scene = decks_.read(run, {"Transient/End Time=" + formatNumber(plan_.end)});
    if (scene) plan_.runs.push_back({std::move(run), std::move(scene), plan_.runs.size()});
  }

  void baseline(const std::vector<PlannedRun>& planned) {
    const auto& wanted = plan_.settings.baseline;
    if (wanted.empty()) return;
    std::vector<std::string> labels;
    for (const auto& run : planned)
      if (run.kind == RunKind::Method) labels.push_back(run.label);
    if (std::find(labels.begin(), labels.end(), wanted) != labels.end()) return;
    const auto near = closest(wanted, labels);
    const auto more = labels.size() - std::min(labels.size(), listedRuns);
    labels.resize(labels.size() - more);
    fault("Study/Baseline", "names no run: there is no " + inQuotes(wanted) + "." +
                                (near.empty() ? "" : " Did you mean " + inQuotes(near) + "?") +
                                " The runs are " + quotedList(labels) +
                                (more > 0 ? " and " + std::to_string(more) + " more." : "."));
  }

  /// Runs must have the same nodes at the same times; runs of one method, and those of the
  /// reference, must differ.
  void compare() {
    const auto& reference = *plan_.runs.front().scene;
    std::map<std::string, std::size_t> seen;
    for (std::size_t i = 0; i < plan_.runs.size(); ++i) {
      auto& run = plan_.runs[i];
      const auto& source = run.plan.source;
      if (!run.scene) continue;
      if (!run.scene->moves()) {
        fault(source, "takes the Transient list out: nothing would move.");
        continue;
      }
      if (run.scene->reduces() != run.plan.reduced)
        fault(source, run.plan.reduced
                          ? "runs the reduced model, but its deck has no Reduction list. Add "
                            "one to the deck or with Set."
                          : "runs the full model, but puts a Reduction list back with Set.");
      if (run.scene->nodes() != reference.nodes())
        fault(source, "has " + std::to_string(run.scene->nodes()) + " nodes (" + run.plan.label +
                          "), the reference " + std::to_string(reference.nodes()) +
                          ": their motions cannot be compared node by node.");
      if (run.plan.kind == RunKind::Sensitivity) continue;
      const bool method = run.plan.kind == RunKind::Method;
      const auto [it, fresh] = seen.emplace(
          (method ? "" : "reference\n") + cases::canonicalText(computed(*run.scene)), i);
      const auto& first = plan_.runs[it->second].plan;
      run.twin = it->second;
      if (!fresh && (!method || first.source == source))
        fault(source, "makes the run " + inQuotes(run.plan.label) + ", which is the same as " +
                          inQuotes(first.label) + ". Change something, or leave it out.");
    }
  }

  const cases::Case& scene_;
  const std::string& row_;
  StudyPlan plan_;
  RunDecks decks_;
};

const bool studyPlanRegistered = cases::AnalysisLists::instance().add(
    {"Study", [] { return parameters(); },
     [](const Teuchos::ParameterList& list) { readStudy(list); },
     [](const cases::Case& scene) { return describe(planStudy(scene)); }});

}  // namespace

bool StudyPlan::hasStatistics() const {
  return settings.statistics &&
         end - windowEnd > 1.5 * transientNumber(*runs.front().scene, "Sampling Interval");
}

std::size_t StudyPlan::referenceRuns() const {
  return static_cast<std::size_t>(std::count_if(runs.begin(), runs.end(), [](const StudyRun& run) {
    return run.plan.kind != RunKind::Method;
  }));
}

StudyPlan planStudy(const cases::Case& scene, const std::string& row) {
  return Planner(scene, row).plan();
}

std::size_t runNumber(const StudyPlan& plan, const std::string& row) {
  return numberOf(plan.runs.size(), row);
}

std::string describe(const StudyPlan& plan) {
  const auto runs = plan.runs.size() - plan.referenceRuns();
  return std::to_string(runs) + " runs of " + std::to_string(plan.settings.methods.size()) +
         " methods, each " + std::to_string(plan.settings.repeats) + " times, and " +
         std::to_string(plan.referenceRuns()) + " of the reference (" +
         describeReference(plan.settings, plan.runs.front().scene->transient()) + "); to " +
         formatNumber(plan.end) + " s, compared up to " + formatNumber(plan.windowEnd) +
         " s (tooljoint study)";
}

std::string contentOf(const cases::Case& scene) {
  std::string text = cases::canonicalText(computed(scene)) + scene.files();
  for (const auto& file : vectorFiles(scene)) text += "\n" + io::readText(file);
  return text;
}

}  // namespace tooljoint::study
