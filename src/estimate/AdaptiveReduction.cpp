// SPDX-License-Identifier: BSD-3-Clause
#include "estimate/AdaptiveReduction.hpp"

#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <numeric>
#include <utility>

#include "common/Error.hpp"
#include "common/Index.hpp"
#include "common/Text.hpp"
#include "reduction/selection/ModeSelection.hpp"

namespace tooljoint::estimate {

namespace {

/// Number of modes at the start, for every part.
constexpr int firstModes = 2;
/// An estimate times its safety factor stays below the tolerance. Estimates of the motion are less
/// sharp than those of the frequencies.
constexpr double frequencySafety = 1.5;
constexpr double motionSafety = 2.0 * frequencySafety;
/// A motion is stopped when its error is this many times the allowed error.
constexpr double hopeless = 2.0;
/// Largest error of a model that gives the size of the motion.
constexpr double known = 0.5;
/// A part that would get this fraction of its modes is not reduced.
constexpr double nearlyAll = 0.75;
/// The same for a part whose full reduced matrices would have this many times the entries of its
/// own stiffness: the longer steps of an explicit integrator without the highest modes do not
/// compensate for more.
constexpr double tooFull = 10.0;
/// Limit of the number of rounds: each adds at least two modes and half of the present ones to some
/// part.
constexpr int mostRounds = 60;

double since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The largest contributions such that the others sum to at most `rest`, largest first.
std::vector<std::size_t> mark(const Vector& shares, double rest) {
  std::vector<std::size_t> order(static_cast<std::size_t>(shares.size()));
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return shares[static_cast<Eigen::Index>(a)] > shares[static_cast<Eigen::Index>(b)];
  });
  double left = shares.sum();
  std::size_t taken = 0;
  while (taken < order.size() && left > rest && shares[static_cast<Eigen::Index>(order[taken])] > 0)
    left -= shares[static_cast<Eigen::Index>(order[taken++])];
  order.resize(taken);
  return order;
}

/// Entries of the sum of all stiffness terms.
double entries(const model::Substructure& part) {
  Sparse sum(part.model.size(), part.model.size());
  for (const auto& term : part.model.stiffness) sum = Sparse(sum + term.matrix.cwiseAbs());
  return static_cast<double>(sum.nonZeros());
}

/// The rounds of a tolerance.
class Rounds {
 public:
  Rounds(const std::vector<model::Substructure>& parts, const reduction::ReductionMethod& basis,
         const reduction::ReductionOptions& options, const EstimateOptions& estimates,
         const MotionProbe& probe, const coupling::CouplingOptions& coupling)
      : parts_(parts),
        basis_(basis),
        rule_(options.modes),
        options_(options),
        estimates_(estimates),
        probe_(probe),
        coupling_(coupling) {
    options_.modes.kind = reduction::ModeRule::Kind::PerPart;
    options_.modes.counts.assign(parts.size(), firstModes);
    for (const auto& part : parts) interiors_.push_back(sizeOf(part.interior()));
  }

  Outcome run() {
    for (int round = 0; round < mostRounds; ++round) {
      outcome_.synthesis = coupling::synthesise(parts_, basis_, options_, cache_, coupling_);
      outcome_.rounds.emplace_back();
      outcome_.rounds.back().modes = modes();
      outcome_.rounds.back().whole = static_cast<int>(std::count(
          options_.modes.counts.begin(), options_.modes.counts.end(), reduction::ModeRule::whole));
      std::vector<char> wanted(parts_.size(), 0);
      if (rule_.frequencyTolerance > 0) lookAtFrequencies(wanted);
      if (rule_.motionTolerance > 0 && std::count(wanted.begin(), wanted.end(), 1) == 0)
        lookAtMotion(wanted);
      if (std::count(wanted.begin(), wanted.end(), 1) == 0) return std::move(outcome_);
      if (!grow(wanted)) refuse();
    }
    refuse();
  }

 private:
  /// Whether this part has more modes to add.
  bool canGrow(std::size_t p) const {
    const int count = options_.modes.counts[p];
    return count != reduction::ModeRule::whole && count < interiors_[p];
  }

  /// Modes of a part, including interior dofs that are masters.
  int modesOf(std::size_t p) const {
    const auto& part = outcome_.synthesis.parts[p];
    return part.modes + interiors_[p] - part.report.interior;
  }

  int modes() const {
    int sum = 0;
    for (std::size_t p = 0; p < parts_.size(); ++p) sum += modesOf(p);
    return sum;
  }

  void lookAtFrequencies(std::vector<char>& wanted) {
    const auto start = std::chrono::steady_clock::now();
    outcome_.frequencies = estimateFrequencies(parts_, outcome_.synthesis, estimates_.window);
    const double allowed = rule_.frequencyTolerance / frequencySafety;
    // Fewer frequencies than requested, although parts have more.
    bool missing =
        estimates_.window.belowHz <= 0 && sizeOf(outcome_.frequencies) < estimates_.window.count;
    for (const auto& e : outcome_.frequencies) {
      missing = missing || !e.definite;
      if (!e.definite || std::abs(e.error) > allowed)
        for (std::size_t p : mark(e.byPart, 0.5 * allowed)) wanted[p] = 1;
    }
    // No part contributes to the error of a mode that the coupled model does not have.
    if (missing && std::count(wanted.begin(), wanted.end(), 1) == 0)
      for (std::size_t p = 0; p < parts_.size(); ++p) wanted[p] = canGrow(p);
    outcome_.rounds.back().frequencyError = largestError(outcome_.frequencies);
    outcome_.wall += since(start);
  }

  void lookAtMotion(std::vector<char>& wanted) {
    auto& round = outcome_.rounds.back();
    if (round.whole == static_cast<int>(parts_.size())) {
      round.motionError = 0;
      return;
    }
    const auto start = std::chrono::steady_clock::now();
    const double allowed = rule_.motionTolerance / motionSafety;
    MotionLimit limit;
    if (motion_ > 0) limit = {hopeless * allowed, motion_};
    const auto estimate = probe_(outcome_.synthesis, limit);
    round.motionError = estimate.error;
    round.reached = estimate.reached;
    if (estimate.reached >= 1 && estimate.error <= known) motion_ = estimate.motion;
    outcome_.wall += since(start);
    if (estimate.error <= allowed) return;
    const auto marked = mark(estimate.byPart, 0.1 * estimate.byPart.sum());
    if (marked.empty())
      std::fill(wanted.begin(), wanted.end(),
                1);  // it comes from the initial state, or is not a number
    for (std::size_t p : marked) wanted[p] = 1;
  }

  /// Adds half as many modes (as many as present if the error is ten times too large, three times
  /// as many if it is a hundred times), at least two; the part is kept whole if that is nearly all.
  /// False if no wanted part can grow.
  bool grow(const std::vector<char>& wanted) {
    const auto& round = outcome_.rounds.back();
    const double off = std::max(round.frequencyError / std::max(rule_.frequencyTolerance, 1e-300),
                                round.motionError / std::max(rule_.motionTolerance, 1e-300));
    bool grown = false;
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      const int present = modesOf(p);
      if (!wanted[p] || present >= interiors_[p]) continue;
      const int more = std::max(2, off > 100  ? 3 * present
                                   : off > 10 ? present
                                              : (present + 1) / 2);
      const int next = std::min(interiors_[p], present + more);
      options_.modes.counts[p] =
          rule_.motionTolerance > 0 && dearerThanWhole(p, next) ? reduction::ModeRule::whole : next;
      grown = true;
    }
    return grown;
  }

  /// Whether a part with this many modes is more expensive to integrate than the whole part.
  bool dearerThanWhole(std::size_t p, int count) const {
    const double size =
        outcome_.synthesis.parts[p].report.interface + sizeOf(parts_[p].retained) + count;
    return count >= nearlyAll * interiors_[p] || size * size > tooFull * entries(parts_[p]);
  }

  [[noreturn]] void refuse() const {
    const auto& round = outcome_.rounds.back();
    std::string what;
    if (round.frequencyError >= 0)
      what += "of the frequencies " + formatNumber(round.frequencyError);
    if (round.motionError >= 0)
      what += std::string(what.empty() ? "" : ", ") + "of the motion " +
              formatNumber(round.motionError);
    throw ConvergenceError(
        "The tolerance of the reduction is not met with all available modes: errors " + what +
        " with " + std::to_string(round.modes) + " modes after " +
        std::to_string(outcome_.rounds.size()) +
        " rounds. Increase the tolerance, or retain more nodes.");
  }

  const std::vector<model::Substructure>& parts_;
  const reduction::ReductionMethod& basis_;
  const reduction::ModeRule rule_;
  reduction::ReductionOptions options_;
  const EstimateOptions estimates_;
  const MotionProbe& probe_;
  const coupling::CouplingOptions& coupling_;
  std::vector<int> interiors_;  ///< interior dofs of each part
  reduction::ReductionCache cache_;
  Outcome outcome_;
  double motion_ = 0;  ///< MotionEstimate::motion of the last completed model with an error up to
                       ///< `known`; 0 before
};

}  // namespace

double largestError(const std::vector<FrequencyEstimate>& estimates) {
  double largest = 0;
  for (const auto& e : estimates)
    largest = std::max({largest, std::abs(e.error), e.definite ? 0.0 : 1.0});
  return largest;
}

EstimateOptions readEstimateOptions(const Teuchos::ParameterList& list) {
  EstimateOptions options;
  const auto& choice = list.get<std::string>("Error Estimate");
  options.frequencies = choice == "Frequencies" || choice == "Both";
  options.motion = choice == "Transient" || choice == "Both";
  const bool tolerance = reduction::selectsModesByTolerance(list);
  if ((options.motion || tolerance) && list.isParameter("Interface Reduction") &&
      list.get<std::string>("Interface Reduction") != "None")
    throw DeckError("Reduction gives \"Interface Reduction\" together with " +
                    std::string(tolerance ? "a tolerance, but the search for modes"
                                          : "\"Error Estimate\", but the estimate of a motion") +
                    " leaves out the error of the interface reduction. Give one of the two.");
  options.window.count = list.get<int>("Estimated Frequencies");
  if (list.isParameter("Estimated Below")) {
    options.window.belowHz = list.get<double>("Estimated Below");
    if (!options.frequencies && !reduction::selectsModesBy(list, "Frequency Tolerance"))
      throw DeckError(
          "Reduction gives \"Estimated Below\", but frequencies are not estimated. Set \"Error "
          "Estimate\" to \"Frequencies\", give a \"Frequency Tolerance\", or remove it.");
  }
  return options;
}

Outcome synthesise(const std::vector<model::Substructure>& parts,
                   const reduction::ReductionMethod& basis,
                   const reduction::ReductionOptions& options, const EstimateOptions& estimates,
                   const MotionProbe& probe, const coupling::CouplingOptions& coupling) {
  Outcome outcome;
  if (options.modes.kind == reduction::ModeRule::Kind::Tolerance) {
    if (options.modes.motionTolerance > 0 && !probe)
      throw DeckError(
          "\"Motion Tolerance\" needs a motion. Add a Transient list, or give \"Frequency "
          "Tolerance\".");
    outcome = Rounds(parts, basis, options, estimates, probe, coupling).run();
  } else {
    outcome.synthesis = coupling::synthesise(parts, basis, options, coupling);
  }
  if (!estimates.frequencies || !outcome.frequencies.empty()) return outcome;
  const auto start = std::chrono::steady_clock::now();
  outcome.frequencies = estimateFrequencies(parts, outcome.synthesis, estimates.window);
  outcome.wall += since(start);
  return outcome;
}

Outcome synthesise(const std::vector<model::Substructure>& parts,
                   const Teuchos::ParameterList& list, const MotionProbe& probe,
                   const coupling::CouplingOptions& coupling) {
  const auto options = reduction::readOptions(list, static_cast<int>(parts.size()));
  return synthesise(parts, *reduction::makeBasis(options.basis, list), options,
                    readEstimateOptions(list), probe, coupling);
}

std::string roundTable(const std::vector<Round>& rounds) {
  std::string text =
      "Modes by tolerance:\n  round   modes    unreduced parts   error of frequencies   error of "
      "motion\n";
  const auto number = [](double value) { return value < 0 ? "-" : fmt::format("{:.2e}", value); };
  for (std::size_t i = 0; i < rounds.size(); ++i) {
    const Round& round = rounds[i];
    text += fmt::format("  {:5}  {:6}  {:17}  {:>21}  {:>16}", i + 1, round.modes, round.whole,
                        number(round.frequencyError), number(round.motionError));
    if (round.reached < 1)
      text += fmt::format(", stopped after {:.2g} of the window", round.reached);
    text += "\n";
  }
  return text;
}

}  // namespace tooljoint::estimate
