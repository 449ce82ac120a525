// SPDX-License-Identifier: BSD-3-Clause
#include "cases/ReducedCase.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "common/Constants.hpp"
#include "common/Index.hpp"
#include "reduction/selection/ModeSelection.hpp"
#include "reduction/vectors/FixedInterfaceModes.hpp"
#include "transient/CostModel.hpp"

namespace tooljoint::cases {

namespace {

/// Largest factor of refined sampling for a motion faster than its samples. The samples cannot be
/// closer than the steps.
constexpr double mostSamples = 1024;

/// Another cut is pursued only if its cost is below this fraction of the best cost so far.
constexpr double worthTrying = 0.98;

/// Number of watched modes of a part without modes: both planes of bending, torsion and tension of
/// a beam.
constexpr int watchedModes = 4;

/// Modes of a part that are not in its basis; rows in the coordinates of the reduced part.
std::vector<transient::MissingMode> modesBeyond(const model::Substructure& part,
                                                const reduction::Basis& basis, double time) {
  const auto view =
      reduction::PartView(part).withBoundary(basis.partition.interface, basis.partition.retained);
  reduction::ModeRequest request;
  request.kind = reduction::ModeRequest::Kind::Count;
  request.count = watchedModes;
  const auto found =
      reduction::fixedInterfaceModes(view, request, "modes that the basis does not have");
  const Sparse damping = part.model.dampingAt(time);
  std::vector<transient::MissingMode> out;
  for (int k = 0; k < found.kept; ++k) {
    const double eigenvalue = found.vectors[at(k)].shown();
    if (!(eigenvalue > 0.0)) continue;
    const Vector shape = found.columns({k}, part.model.size());
    out.push_back({std::sqrt(eigenvalue), shape.dot(damping * shape),
                   basis.vectors.sparse().transpose() * Vector(part.model.mass * shape)});
  }
  return out;
}

estimate::MotionOptions motionOptions(const RestingCase& rest) {
  estimate::MotionOptions options;
  options.components = rest.measures().vibration();
  return options;
}

/// Reduces the parts as cut by the deck.
ReducedCase reduceAsGiven(const Case& one, const RestingCase& rest, bool progress) {
  ReducedCase out;
  out.unreduced = rest.parts();
  const auto& parts = out.unreduced.parts;
  double& sampling = out.sampling;
  const auto probe = [&](const coupling::Synthesis& synthesis, const estimate::MotionLimit& limit) {
    auto options = transient::readOptions(one.transient());
    options.progress = options.progress && progress;
    const double finest = std::max(options.step, options.sampling / mostSamples);
    if (sampling > 0) options.sampling = sampling;
    for (;; options.sampling *= 0.5) {
      sampling = options.sampling;
      estimate::MotionEstimator estimator(parts, synthesis, rest.rest(), motionOptions(rest));
      const auto found = estimate::watchMotion(estimator, synthesis.coupled.model, options, limit);
      if (found.reached < 1.0 || !found.isTooFast() || sampling <= finest) return found;
      if (found.roughness > estimate::MotionEstimate::roughest) options.sampling *= 0.5;
    }
  };
  out.outcome = estimate::synthesise(parts, one.reduction(), probe, out.unreduced.options);
  return out;
}

Overrides joined(Overrides all, const Overrides& more) {
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

/// Makes the choices in turn, each with the best of the previous ones. Alternatives are tried while
/// they are cheaper. Choices after the first are made only if the reduced model is hardly faster
/// than the full one.
ReducedCase reduceCheapest(const Case& one, const RestingCase& rest, bool progress) {
  const auto options = transient::readOptions(one.transient());
  const double full = transient::costModel(rest.full().model, options).total();
  ReducedCase best;
  best.cut.cost = std::numeric_limits<double>::infinity();
  std::vector<TriedCut> tried;
  for (const auto& choice : one.openChoices()) {
    if (best.cut.cost < transient::worthReducing) break;
    const Overrides before = best.cut.overrides;
    for (const auto& alternative : choice) {
      const Overrides own = joined(before, alternative);
      const auto other = one.with(joined(one.deck().overrides(), own));
      auto found = reduceAsGiven(*other, *other->solveStatic(), progress);
      found.cut = {own, transient::costModel(found.model(), options).total() / full};
      tried.push_back(found.cut);
      if (!(found.cut.cost < worthTrying * best.cut.cost)) break;
      best = std::move(found);
    }
  }
  best.tried = std::move(tried);
  return best;
}

}  // namespace

std::vector<double> ReducedCase::cutOffs() const {
  std::vector<double> ends;
  for (const auto& part : parts()) {
    const auto& basis = part.report;
    // fewer candidates than dofs if some dofs have no mass
    const bool all = part.basis && part.basis->complete &&
                     part.basis->modes() == static_cast<int>(part.basis->candidates.size());
    const bool whole = all || basis.modes >= basis.interior;
    ends.push_back(whole ? std::numeric_limits<double>::infinity()
                         : constants::twoPi * basis.cutOffHz());
  }
  return ends;
}

double ReducedCase::watchInterval(const Case& one) const {
  return sampling > 0.0 ? sampling : one.transient().get<double>("Sampling Interval");
}

ReducedCase reduce(const Case& one, const RestingCase& rest, bool progress) {
  return one.openChoices().empty() ? reduceAsGiven(one, rest, progress)
                                   : reduceCheapest(one, rest, progress);
}

std::vector<transient::MissingMode> missingModes(const Case& one, const ReducedCase& reduced) {
  const double start = one.transient().get<double>("Start Time");
  std::map<const reduction::Basis*, std::vector<transient::MissingMode>> known;
  std::vector<transient::MissingMode> out;
  for (std::size_t p = 0; p < reduced.parts().size(); ++p) {
    const auto& part = reduced.parts()[p];
    const bool physical = part.modes == 0 && !part.derivedInterface;
    if (!physical || part.report.interior == 0) continue;
    const auto [place, isNew] = known.try_emplace(part.basis.get());
    if (isNew) place->second = modesBeyond(reduced.unreduced.parts[p], *part.basis, start);
    for (auto mode : place->second) {
      mode.row = reduced.coupled().maps[p].transpose() * mode.row;  // to the coupled model
      out.push_back(std::move(mode));
    }
  }
  return out;
}

bool estimatesMotion(const Case& one) {
  return estimate::readEstimateOptions(one.reduction()).motion ||
         reduction::selectsModesBy(one.reduction(), "Motion Tolerance");
}

std::unique_ptr<estimate::MotionEstimator> motionEstimator(const RestingCase& rest,
                                                           const ReducedCase& reduced) {
  return std::make_unique<estimate::MotionEstimator>(
      reduced.unreduced.parts, reduced.outcome.synthesis, rest.rest(), motionOptions(rest));
}

}  // namespace tooljoint::cases
