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
#include "linalg/trilinos/EigenSolver.hpp"
#include "substructures/beam/NodalDofs.hpp"
#include "substructures/drillstring/buckling/BucklingState.hpp"
#include "substructures/drillstring/scene/RestProblem.hpp"
#include "substructures/equilibrium/Equilibrium.hpp"
#include "substructures/equilibrium/LoadPath.hpp"
#include "substructures/equilibrium/Settling.hpp"

namespace tooljoint::drillstring {

namespace nodal = beam::nodal;

namespace {

const std::string listName = "Buckling";

/// Jumps after which a path is given up.
constexpr int mostJumps = 100;
/// Half waves of a string that has buckled: one is the deflection of a well that turns, two that of
/// a torque at an end.
constexpr int buckledHalfWaves = 3;
/// A jump takes place under a weight that is larger by this part of the last weight: where the
/// states turn there is none just before. Where no state is found, the next one is tried.
constexpr double beyondLimit[] = {1e-4, 1e-3, 1e-2};
/// Relative size of the last Newton step of a state after a jump.
constexpr double smallUpdate = 1e-8;
/// Steps over bifurcations, as a part of the largest step.
constexpr double bifurcationShare = 1.0 / 64.0;
/// Steps in which a string may become crooked, before the weight grows.
constexpr int stepsOfBending = 1000;

/// The scene without what moves, and without the weight on bit.
Scene atRest(const Scene& scene) {
  Scene still = scene;
  Teuchos::ParameterList list = scene.list().sublist("Loads");
  list.set("Weight On Bit", 0.0);
  list.remove("Unbalance", false);
  still.loads = loads::readLoads(list);
  still.rotary = {};
  still.statics.friction = equilibrium::FrictionRule::None;
  still.bit.reset();
  still.topDrive = {};
  return still;
}

void check(const Scene& scene) {
  const auto refuse = [&](const std::string& path, const std::string& sentence) {
    throw DeckError(scene.deck.error(path, sentence));
  };
  if (!scene.contact || scene.contactPoints.size() == 0)
    throw DeckError(scene.deck.file() +
                    ": buckling needs contact with the wall of the hole. Add the list Contact.");
  if (!scene.list().isSublist("Loads"))
    throw DeckError(
        scene.deck.file() +
        ": the string has no loads. Add the list Loads; with Gravity 0 it has no weight.");
  if (!scene.statics.geometricStiffness)
    refuse("Static/Geometric Stiffness",
           "is false, but buckling needs geometric stiffness. Leave it out.");
  if (scene.held[at(nodal::perNode * (scene.string.nodeCount() - 1) + nodal::w)] != 0)
    refuse("Supports/Bit",
           "holds w, so that the weight on bit cannot move the bit. Release w of the bit and hold "
           "that of Top.");
}

/// Everything that the path is made of.
class Model {
 public:
  Model(const Scene& scene, double last)
      : scene_(atRest(scene)),
        path_(bendIntoWell(scene_)),
        input_(restProblem(scene_, path_, equationsOnPath(scene_, path_), {}, scene_.contactPoints,
                           scene_.statics.reference)) {
    load_.direction = Vector::Zero(nodal::perNode * input_.nodes);
    load_.direction(nodal::perNode * (input_.nodes - 1) + nodal::w) = -1.0;
    load_.contained = load_.scale = last;  // the largest load is the scale of the residual
    load_.pathWeights = pathWeights();
    input_.load += last * load_.direction;
  }

  /// Dofs of the static state of the straight string without weight on bit, as exact as states of
  /// the path: relative to the largest load of the path.
  Vector start(const equilibrium::LoadPath& problem) const {
    auto input = input_;
    input.load -= load_.contained * load_.direction;
    auto options = scene_.statics;
    options.tolerance *= std::max(
        1.0, problem.problem().largestLoad() / equilibrium::StaticProblem(input).largestLoad());
    return problem.problem().restrict(
        equilibrium::solveStatic(input, options, staticSolver(scene_)).displacement);
  }

  /// Makes the string crooked, and its state without weight on bit one of the crooked string: x
  /// from the straight one, in a path of its own. ConvergenceError.
  void bend(double amplitude, double pitch, statics::PathOptions options, Vector& x) {
    const Vector lateral = crooked(amplitude, pitch);
    auto input = input_;
    input.load += lateral - load_.contained * load_.direction;
    auto growing = load_;
    growing.direction = lateral;
    growing.contained = growing.scale = 1.0;
    options.from = 0.0, options.to = 1.0;
    options.maxSteps = stepsOfBending;  // those of the deck are of the weight on bit
    const equilibrium::LoadPath bending(input, growing);
    options.tolerance *= std::max(1.0, scaleOfPath() / bending.problem().largestLoad());
    const auto report =
        statics::followPath(bending, x, options, [&](const statics::PathPoint& point) {
          x = point.x;
          return true;
        });
    if (report.end != statics::PathEnd::Reached)
      throw ConvergenceError(
          "The state of the crooked string without weight on bit was not found: " +
          report.explanation + " Reduce Buckling/Crookedness.");
    input_.load += lateral;
  }

  /// The string of bend(), whose state is known.
  void setCrooked(double amplitude, double pitch) { input_.load += crooked(amplitude, pitch); }

  /// The state that a string finds under the weight `weight` when it leaves the unstable state `x`
  /// of the path in the direction `towards`. ConvergenceError: none.
  Vector jump(const equilibrium::LoadPath& problem, const Vector& x, const Vector& towards,
              double weight) const {
    auto input = input_;
    input.load += (weight - load_.contained) * load_.direction;
    equilibrium::StaticProblem rest(input);
    auto switches = problem.problem().switches();
    switches.lateralStepLimit = scene_.statics.lateralStepLimit;
    switches.slideAlongWall = true;
    rest.set(switches);
    Vector found = x;
    equilibrium::settle(input, rest, unstableMode(problem, x, towards), scene_.statics.tolerance,
                        staticSolver(scene_), found);
    // where hardly anything resists a motion, as a turn of a helix about the axis of a vertical
    // hole, the state is not there yet though its residual is small
    model::SolveRequest request;
    request.what = "the state after a jump";
    request.tolerance = scene_.statics.tolerance;
    request.updateTolerance = smallUpdate;
    request.maxIterations = scene_.statics.maxIterations;
    request.search = model::LineSearch::Work;
    const auto outcome = staticSolver(scene_)(rest, found, request);
    if (!outcome.converged)
      throw ConvergenceError("The state after a jump of the string was not found: " +
                             outcome.message);
    return found;
  }

  equilibrium::LoadPath problem() const { return {input_, load_}; }
  BucklingMeasure measure(const equilibrium::LoadPath& problem) const {
    return {scene_, path_, input_, problem.problem()};
  }
  const Scene& scene() const { return scene_; }

 private:
  /// Lateral motion in clearances, root mean square along the string.
  Vector pathWeights() const {
    Vector weights = Vector::Zero(nodal::perNode * input_.nodes);
    const auto& string = scene_.string;
    for (int e = 0; e < string.elementCount(); ++e)
      for (const int n : {e, e + 1}) {
        const double r = string.nodes[at(n)].clearance;
        if (!(r > 0.0)) continue;
        const double share = 0.5 * string.elements[at(e)].length() / (string.length() * r * r);
        weights(nodal::perNode * n + nodal::u) += share;
        weights(nodal::perNode * n + nodal::v) += share;
      }
    return weights;
  }

  /// A lateral load under which a straight string would take the shape, to first order:
  /// E I q^4 A (cos q s, sin q s) per length, q = 2 pi/pitch.
  Vector crooked(double amplitude, double pitch) const {
    Vector load = Vector::Zero(nodal::perNode * input_.nodes);
    const auto depth = scene_.string.depths();
    const double q = constants::twoPi / pitch;
    for (int e = 0; e < scene_.string.elementCount(); ++e) {
      const auto& element = scene_.string.elements[at(e)];
      const auto& section = element.section();
      const double EI = section.youngModulus() * section.inertiaX();
      for (const int n : {e, e + 1}) {
        const double force = 0.5 * element.length() * EI * std::pow(q, 4) * amplitude;
        load(nodal::perNode * n + nodal::u) += force * std::cos(q * depth[at(n)]);
        load(nodal::perNode * n + nodal::v) += force * std::sin(q * depth[at(n)]);
      }
    }
    return load;
  }

  equilibrium::UnstableMode unstableMode(const equilibrium::LoadPath& problem, const Vector& x,
                                         const Vector& towards) const {
    auto equations = equationsOnPath(scene_, path_).model;
    equations.held = input_.held;
    const Sparse mass = assemble(equations).mass;
    const auto modes = linalg::lowestModes(problem.symmetricTangent(x), mass, 2);
    equilibrium::UnstableMode mode;
    const Vector shape = modes.vectors.col(0);
    mode.shape = problem.problem().expand(shape.dot(towards) < 0.0 ? Vector(-shape) : shape);
    mode.mass = problem.problem().expand(mass.diagonal());
    // on the way the string is less stable than here, where it has just become unstable
    mode.growthRate = std::sqrt(modes.values.cwiseAbs().maxCoeff());
    return mode;
  }

  double scaleOfPath() const { return equilibrium::StaticProblem(input_).largestLoad(); }

  Scene scene_;
  path::PathState path_;
  equilibrium::StaticInput input_;
  equilibrium::GrowingLoad load_;
};

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

constexpr int storeFormat = 1;  ///< raised when the meaning of a kept path changes

/// How far the path is: where a branch begins.
struct Reached {
  std::size_t done = 0;  ///< states
  BucklingPath path;
  double from = 0.0;  ///< weight on bit [N]
  Vector x;
  int branch = 0;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(done, path, from, x, branch);
  }
};

/// Where it is kept.
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
  /// \param start of the crooked string without weight on bit, or where a later branch begins
  Branches(const Model& model, const BucklingSettings& settings,
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
      const bool ended = report.end == statics::PathEnd::Reached ||
                         report.end == statics::PathEnd::Steps || found_.states.empty();
      if (ended || settings_.atLimit == LimitRule::Follow) return;
      if (branch_ == mostJumps)
        return fail("The string has jumped " + std::to_string(mostJumps) +
                    " times, the most that are computed.");
      if (!jump(report)) return;
    }
  }

 private:
  /// Whether the path goes on: a string that jumps does so where the weight would have to shrink,
  /// or where more pivots are negative than before.
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
    if (jumps && point.parameter <= found_.states.back().weight) return false;
    auto state = measure_.state(point.parameter, problem_.problem().expand(x_));
    state.branch = branch_;
    state.negativePivots = point.negativePivots.value_or(0);
    allowed_ = point.step == 0 ? state.negativePivots : std::min(allowed_, state.negativePivots);
    found_.states.push_back(state);
    return !jumps || state.negativePivots <= allowed_;
  }

  /// To another state under a little more weight; where there is none, under more.
  bool jump(const statics::PathReport& report) {
    const double most = found_.states.back().weight;
    const Vector from = x_, towards = x_ - before_;
    std::string why;
    for (const double beyond : beyondLimit) {
      options_.from = std::min(options_.to, most + beyond * options_.to);
      try {
        x_ = model_.jump(problem_, from, towards, options_.from);
        if (statics::startsPath(problem_, x_, options_)) {
          ++branch_;
          kept_ = found_.states.size();
          cases::keepReached(store_.folder, store_.keys,
                             Reached{kept_, found_, options_.from, x_, branch_});
          return true;
        }
      } catch (const ConvergenceError& error) {
        why = std::string(" ") + error.what();
      }
    }
    fail((report.end == statics::PathEnd::Stopped
              ? fmt::format(
                    "The state becomes unstable under {}, and no other state was found up to {}.",
                    deck::printed(most, "kN", 6), deck::printed(options_.from, "kN", 6))
              : report.explanation) +
         why);
    return false;
  }

  /// The last state is one after a jump.
  void end() {
    add({0, options_.to, x_, problem_.negativePivots(x_, options_.to)});
    found_.report.end = statics::PathEnd::Reached;
    found_.report.parameter = options_.to;
  }

  void fail(const std::string& why) {
    found_.report.end = statics::PathEnd::Failed;
    found_.report.explanation = why;
  }

  const Model& model_;
  const equilibrium::LoadPath problem_;
  const BucklingMeasure measure_;
  const BucklingSettings& settings_;
  statics::PathOptions options_;
  BucklingPath& found_;
  const Store& store_;
  std::size_t kept_;  ///< states that are kept
  Vector x_, before_;
  int branch_ = 0;
  /// Negative pivots that are no reason for a jump, since they were there from the first state of
  /// the branch on: a string that winds about the axis of a vertical hole can come to rest in any
  /// position, and its crookedness makes some of them slightly unstable.
  int allowed_ = 0;
};

}  // namespace

namespace {

/// Share of the limit within which it is found.
constexpr double limitAccuracy = 1e-5;

/// The least parameter at which `holds` is false, by halving of the step of the path that leads
/// over it. Null where it holds up to the end.
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
  return settings;
}

BucklingPath bucklingPath(const Scene& scene, const BucklingSettings& settings,
                          const cases::RowFolder& folder) {
  const Stage stage("path of buckling");
  check(scene);
  BucklingPath found;
  found.depth = scene.string.depths();
  auto options = pathOptions(scene, settings);
  Model model(scene, options.to);
  const auto store = storeOf(folder);
  auto reached = cases::restoreReached<Reached>(folder, store.keys);
  if (reached.done > 0) {
    found = std::move(reached.path);
    options.from = reached.from;
    if (found.crookedness > 0.0) model.setCrooked(found.crookedness, found.pitch);
    Branches(model, settings, options, reached.x, found, store, reached.branch).follow();
    return found;
  }

  // The straight string up to its first negative pivot; or up to where it lies in half waves: a
  // torque, or a well that turns, leads it onto the buckled branch without a pivot.
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

  Branches(model, settings, options, start, found, store, 0).follow();
  return found;
}

}  // namespace tooljoint::drillstring
