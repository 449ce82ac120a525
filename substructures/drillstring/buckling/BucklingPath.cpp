// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drillstring/buckling/BucklingPath.hpp"

#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

#include "cases/ListText.hpp"
#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "common/Index.hpp"
#include "common/Interrupt.hpp"
#include "common/Parallel.hpp"
#include "common/Text.hpp"
#include "common/report/StageTimes.hpp"
#include "deck/Defaults.hpp"
#include "deck/PrintedUnits.hpp"
#include "substructures/drillstring/buckling/BucklingModel.hpp"

namespace tooljoint::drillstring {

namespace {

const std::string listName = "Buckling";

/// Largest number of jumps of a path.
constexpr int mostJumps = 100;
/// Smallest number of half waves of a buckled string: a well that turns deflects it in one, a
/// torque at an end in two.
constexpr int buckledHalfWaves = 3;
/// Increments of the weight for a jump, as fractions of the last weight: at a turning point there
/// is no state at the weight just before. If no state is found, the next increment is tried.
constexpr double beyondLimit[] = {1e-4, 1e-3, 1e-2};
/// Steps over bifurcations, as a fraction of the largest step.
constexpr double bifurcationShare = 1.0 / 64.0;

statics::PathOptions pathOptions(const Scene& scene, const BucklingSettings& settings) {
  statics::PathOptions options;
  options.to = *settings.lastWeight;
  options.firstStep = settings.firstStep;
  options.largestStep = settings.largestStep;
  options.smallestStep = settings.smallestStep;
  options.bifurcationStep = bifurcationShare * settings.largestStep;
  options.maxSteps = settings.maxSteps;
  options.maxIterations = settings.maxIterations;
  options.tolerance = scene.statics.tolerance;
  return options;
}

void addBranch(const statics::PathReport& branch, statics::PathReport& all) {
  const auto before = all;
  all = branch;
  all.steps += before.steps;
  all.failedSteps += before.failedSteps;
}

constexpr int storeFormat = 2;  ///< raised when the meaning of a stored path changes

/// Progress of the path: the start of a branch.
struct Reached {
  std::size_t done = 0;  ///< number of states
  BucklingPath path;
  double from = 0.0;  ///< parameter of the path [N]
  Vector x;
  int branch = 0;
  bool unloads = false;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(done, path, from, x, branch, unloads);
  }
};

/// Storage of the progress.
struct Store {
  const cases::RowFolder& folder;
  cases::RowKeys keys;
};

Store storeOf(const cases::RowFolder& folder) {
  const auto& list = folder.owner.list();
  const auto own = list.isSublist(listName) ? cases::canonicalText(list.sublist(listName)) : "";
  return {folder,
          {"states",
           fmt::format("buckling {}\n{}\n{}", storeFormat, cases::identity(folder.owner), own),
           {}}};
}

/// The path of the crooked string, with its jumps.
class Branches {
 public:
  /// \param start  state of the crooked string without weight on bit, or start of a later branch
  Branches(const BucklingModel& model, const BucklingSettings& settings,
           const statics::PathOptions& options, Vector start, BucklingPath& found,
           const Store& store, int branch)
      : model_(model),
        problem_(model.problem()),
        measure_(model.measure(problem_)),
        settings_(settings),
        options_(options),
        found_(found),
        store_(store),
        kept_(found.states.size()),
        x_(std::move(start)),
        before_(x_),
        branch_(branch) {}

  void follow() {
    while (true) {
      if (options_.from >= options_.to) return end();
      const auto report = statics::followPath(
          problem_, x_, options_, [this](const statics::PathPoint& point) { return add(point); });
      addBranch(report, found_.report);
      found_.report.parameter = model_.weightOnBit(report.parameter);
      const bool ended = report.end == statics::PathEnd::Reached ||
                         report.end == statics::PathEnd::Steps || found_.states.empty();
      if (ended || settings_.atLimit == LimitRule::Follow) return;
      if (branch_ == mostJumps)
        return fail("The string has jumped " + std::to_string(mostJumps) +
                    " times, the most that are computed.");
      if (!jump(report)) return;
    }
  }

  const Vector& x() const { return x_; }
  int branch() const { return branch_; }

 private:
  /// Returns whether the path continues. With jumps it ends where the weight would decrease, or
  /// where more pivots are negative than before.
  bool add(const statics::PathPoint& point) {
    if (parallel::maximum(interruptRequested() ? 1.0 : 0.0) > 0.0)
      throw InterruptedError(
          kept_ > 0
              ? cases::interruptedSentence(store_.keys, static_cast<int>(kept_),
                                           store_.folder.folder)
              : "Interrupted before the first jump of the string. A path is kept from jump to "
                "jump: the same command begins anew.");
    const bool jumps = settings_.atLimit == LimitRule::Jump && point.step > 0;
    before_ = point.step == 0 ? point.x : x_;
    x_ = point.x;
    if (jumps && point.parameter <= last_) return false;
    last_ = point.parameter;
    auto state = measure_.state(model_.weightOnBit(point.parameter), problem_.problem().expand(x_));
    state.branch = branch_;
    state.negativePivots = point.negativePivots.value_or(0);
    allowed_ = point.step == 0 ? state.negativePivots : std::min(allowed_, state.negativePivots);
    const bool known = !found_.states.empty() && found_.states.back().branch == branch_ &&
                       found_.states.back().weight == state.weight;
    if (!known) found_.states.push_back(state);
    return !jumps || state.negativePivots <= allowed_;
  }

  /// Jumps to another state under a slightly larger weight; if none is found, under a larger one.
  bool jump(const statics::PathReport& report) {
    const double most = last_;
    const Vector from = x_, towards = x_ - before_;
    std::string why;
    for (const double beyond : beyondLimit) {
      options_.from = std::min(options_.to, most + beyond * model_.last());
      try {
        x_ = model_.jump(problem_, from, towards, options_.from);
        if (statics::startsPath(problem_, x_, options_)) {
          ++branch_;
          kept_ = found_.states.size();
          cases::keepReached(store_.folder, store_.keys,
                             Reached{kept_, found_, options_.from, x_, branch_, model_.unloads()});
          return true;
        }
      } catch (const ConvergenceError& error) {
        why = std::string(" ") + error.what();
      }
    }
    fail((report.end == statics::PathEnd::Stopped
              ? fmt::format(
                    "The state becomes unstable under {}, and no other state was found up to {}.",
                    deck::printed(model_.weightOnBit(most), "kN", 6),
                    deck::printed(model_.weightOnBit(options_.from), "kN", 6))
              : report.explanation) +
         why);
    return false;
  }

  /// Ends the path with the state after a jump at the last weight.
  void end() {
    add({0, options_.to, x_, problem_.negativePivots(x_, options_.to)});
    found_.report.end = statics::PathEnd::Reached;
    found_.report.parameter = model_.weightOnBit(options_.to);
  }

  void fail(const std::string& why) {
    found_.report.end = statics::PathEnd::Failed;
    found_.report.explanation = why;
  }

  const BucklingModel& model_;
  const equilibrium::LoadPath problem_;
  const BucklingMeasure measure_;
  const BucklingSettings& settings_;
  statics::PathOptions options_;
  BucklingPath& found_;
  const Store& store_;
  std::size_t kept_;  ///< number of stored states
  Vector x_, before_;
  double last_ = 0.0;  ///< parameter of the last state
  int branch_ = 0;
  /// Negative pivots that cause no jump, since the branch has had them from its first state on: a
  /// string that winds about the axis of a vertical hole can rest in any rotational position, and
  /// its crookedness makes some of them slightly unstable.
  int allowed_ = 0;
};

}  // namespace

namespace {

/// Relative accuracy of the limit.
constexpr double limitAccuracy = 1e-5;

/// The smallest parameter at which `holds` is false, by halving the path step that crosses it. Null
/// if it is true up to the end.
std::optional<double> limitOf(const equilibrium::LoadPath& problem, Vector x,
                              statics::PathOptions options, const statics::PathObserver& holds) {
  std::optional<double> below, above;
  const auto look = [&](const statics::PathPoint& point) {
    const bool held = holds(point);
    if (held) below = point.parameter, x = point.x;
    if (!held) above = point.parameter;
    return held;
  };
  statics::followPath(problem, Vector(x), options, look);
  bool found = above.has_value();
  while (found && below && *above - *below > limitAccuracy * *above) {
    options.from = 0.5 * (*below + *above);
    found = false;
    statics::followPath(problem, Vector(x), options, [&](const statics::PathPoint& point) {
      found = true;
      look(point);
      return false;
    });
  }
  return above;
}

}  // namespace

namespace {

/// The path of the crooked string from a state to the last weight and, if requested, back.
void followBranches(BucklingModel& model, const BucklingSettings& settings,
                    statics::PathOptions options, Vector x, BucklingPath& found, const Store& store,
                    int branch) {
  if (!model.unloads()) {
    Branches loading(model, settings, options, std::move(x), found, store, branch);
    loading.follow();
    if (!settings.unloadTo || found.report.end != statics::PathEnd::Reached) return;
    x = loading.x(), branch = loading.branch(), options.from = 0.0;
    model.unload();
    cases::keepReached(store.folder, store.keys,
                       Reached{found.states.size(), found, 0.0, x, branch, true});
  }
  options.to = model.last() - *settings.unloadTo;
  Branches(model, settings, options, std::move(x), found, store, branch).follow();
  if (found.report.end != statics::PathEnd::Reached)
    found.report.explanation = "While the weight falls: " + found.report.explanation;
}

}  // namespace

BucklingSettings bucklingSettings(const Scene& scene) {
  const auto spec = bucklingParameters();
  BucklingSettings settings;
  const bool given = scene.list().isSublist(spec.name());
  deck::withDefaults(spec, given ? scene.list().sublist(spec.name()) : Teuchos::ParameterList(),
                     [&](const auto& list) { settings = readBuckling(list); });
  if (!settings.lastWeight && scene.weightOnBit() > 0.0) settings.lastWeight = scene.weightOnBit();
  if (!settings.lastWeight)
    throw DeckError(scene.deck.file() + ": the last weight on bit is not given. Give " + listName +
                    "/Last Weight On Bit or Loads/Weight On Bit.");
  if (settings.unloadTo && !(*settings.unloadTo < *settings.lastWeight))
    throw DeckError(scene.deck.error(
        listName + "/Unload To",
        "is " + deck::printed(*settings.unloadTo, "kN", 6) + ", but the last weight on bit is " +
            deck::printed(*settings.lastWeight, "kN", 6) + ". Give a smaller one."));
  return settings;
}

BucklingPath bucklingPath(const Scene& scene, const BucklingSettings& settings,
                          const cases::RowFolder& folder) {
  const Stage stage("path of buckling");
  BucklingPath found;
  found.depth = scene.string.depths();
  auto options = pathOptions(scene, settings);
  BucklingModel model(scene, options.to);
  const auto store = storeOf(folder);
  auto reached = cases::restoreReached<Reached>(folder, store.keys);
  if (reached.done > 0) {
    found = std::move(reached.path);
    options.from = reached.from;
    if (found.crookedness > 0.0) model.setCrooked(found.crookedness, found.pitch);
    if (reached.unloads) model.unload();
    followBranches(model, settings, options, reached.x, found, store, reached.branch);
    return found;
  }

  // The straight string up to its first negative pivot, or until it deflects in half waves: a
  // torque, or a well that turns, leads it to the buckled branch without a negative pivot.
  double compression = 0.0, rigidity = 0.0;
  Vector start;
  {
    const auto problem = model.problem();
    const auto measure = model.measure(problem);
    start = model.start(problem);
    BucklingState last;  // of the path's own steps
    bool first = true, held = true;
    const auto straightAt = [&](const statics::PathPoint& point) {
      const auto now = measure.state(point.parameter, problem.problem().expand(point.x));
      if (held) last = now;
      if (std::exchange(first, false)) found.theory = measure.theory(-now.compression);
      const bool smooth = measure.liesLow() && now.halfWaves >= buckledHalfWaves;
      const bool holds = point.negativePivots.value_or(0) == 0 && !smooth;
      if (!holds) found.limitIsSmooth = smooth, held = false;
      return holds;
    };
    found.limit = limitOf(problem, start, options, straightAt);
    Eigen::Index most = 0;
    compression = last.compression.maxCoeff(&most);
    rigidity = measure.rigidity()[at(static_cast<int>(most))];
    double clearance = 0.0;
    for (const double r : measure.clearance()) clearance = std::max(clearance, r);
    found.crookedness = settings.crookedness * clearance;
  }
  found.pitch = settings.pitch.value_or(
      compression > 0.0 ? constants::twoPi * std::sqrt(2.0 * rigidity / compression)
                        : found.depth.back());
  if (found.crookedness > 0.0) model.bend(found.crookedness, found.pitch, options, start);

  followBranches(model, settings, options, start, found, store, 0);
  return found;
}

}  // namespace tooljoint::drillstring
