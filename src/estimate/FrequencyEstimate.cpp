// SPDX-License-Identifier: BSD-3-Clause
#include "estimate/FrequencyEstimate.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "common/Index.hpp"
#include "common/report/StageTimes.hpp"
#include "coupling/CoupledModes.hpp"
#include "coupling/ModeCount.hpp"
#include "estimate/ModeMatching.hpp"
#include "estimate/PartResidual.hpp"
#include "estimate/ResidualFlexibility.hpp"
#include "linalg/trilinos/EigenSolver.hpp"
#include "reduction/project/SharedWork.hpp"

namespace tooljoint::estimate {

using constants::twoPi;

namespace {

/// A mode is a rigid-body mode if its frequency is below this part of the frequency of its dofs,
/// each on its own: sum K_ii D_i^2 over D' M D. Masses of single dofs do not count, because they
/// may be zero up to rounding.
constexpr double rigid = 1e-7;
/// Additional modes with whole interfaces, among which a shape is searched.
constexpr int more = 6;
/// Modes at once: enough for products and solutions by blocks. Each mode needs about ten vectors,
/// for which there is little memory beside the factors of a large part.
constexpr Eigen::Index blockOfModes = 16;

/// Contribution of one part to the estimate of one mode.
struct Share {
  ResidualFlexibility::Step step;
  double work = 0;      ///< D' r
  double mass = 0;      ///< D' M D
  double diagonal = 0;  ///< sum K_ii D_i^2

  template <class Archive>
  void serialize(Archive& archive) {
    archive(step.residual, step.inertia, step.stiffness, step.mass, work, mass, diagonal);
  }
};

/// For modes with these coordinates in the basis.
std::vector<Share> shares(const model::Substructure& part, const reduction::Basis& basis,
                          const Matrix& coordinates, const Vector& eigenvalues,
                          parallel::Ranks ranks) {
  const Stage stage("errors of the coupled modes");
  const model::SharedSparse K = coupling::undampedStiffness(part.model);
  const ResidualFlexibility flexibility(part, basis, K, ranks);
  const auto& interior = flexibility.interior();
  const Vector stiffnesses = K.diagonal();
  std::vector<Share> result;
  for (Eigen::Index first = 0; first < coordinates.cols(); first += blockOfModes) {
    const Eigen::Index count = std::min(blockOfModes, coordinates.cols() - first);
    const Matrix shapes = basis.vectors * coordinates.middleCols(first, count);
    const Matrix inertia = part.model.mass * shapes;
    const Matrix residual = K * shapes - inertia * eigenvalues.segment(first, count).asDiagonal();
    const auto steps = flexibility.steps(Matrix(residual(interior, Eigen::all)),
                                         Matrix(inertia(interior, Eigen::all)));
    for (Eigen::Index j = 0; j < count; ++j)
      result.push_back({steps[at(j)], shapes.col(j).dot(residual.col(j)),
                        shapes.col(j).dot(inertia.col(j)),
                        stiffnesses.dot(shapes.col(j).cwiseAbs2())});
  }
  return result;
}

/// The root mu < lambda of m (lambda - mu) = sum_p excess_p(lambda, mu) below every pole:
/// Rayleigh-Ritz on the mode and the Krylov vectors of all parts. The difference of the sides falls
/// from positive to negative there.
double improvedEigenvalue(double lambda, double mass,
                          const std::vector<ResidualFlexibility::Step>& steps) {
  double pole = std::numeric_limits<double>::infinity();
  double first = 0;
  for (const auto& step : steps) pole = std::min(pole, step.pole());
  const auto surplus = [&](double mu) {
    double value = mass * (lambda - mu);
    for (const auto& step : steps) value -= step.excess(lambda, mu);
    return value;
  };
  double high = std::min(lambda, pole - 1e-12 * std::abs(pole));
  if (surplus(high) >= 0) return high;
  first = std::max(1e-300, std::abs(surplus(high)) / mass);
  double low = high - first;
  while (surplus(low) < 0) low -= (first *= 2.0);
  for (int i = 0; i < 200 && high - low > 1e-15 * std::abs(low); ++i) {
    const double middle = 0.5 * (low + high);
    (surplus(middle) < 0 ? high : low) = middle;
  }
  return low;
}

/// f / f_full - 1 from the eigenvalues; if they differ in sign, their difference over twice the
/// size of `lambda`.
double signedRatio(double lambda, double full) {
  if (lambda * full > 0)
    return std::copysign(1.0, lambda) * (std::expm1(0.5 * std::log1p((lambda - full) / full)));
  return (lambda - full) / (2.0 * std::abs(lambda));
}

/// Whether the j-th mode is a rigid-body mode, which has no relative error.
bool isRigid(double eigenvalue, Eigen::Index j, const std::vector<std::vector<Share>>& all) {
  double mass = 0, diagonal = 0;
  for (const auto& part : all) {
    mass += part[at(j)].mass;
    diagonal += part[at(j)].diagonal;
  }
  return std::abs(eigenvalue) * mass <= rigid * rigid * diagonal;
}

/// z' K z per mode for point laws between parts, which are not in the stiffness of any part.
Vector workOfConnectors(const std::vector<model::Substructure>& parts,
                        const model::SecondOrderModel& coupled, const Matrix& modes) {
  std::size_t own = 0;
  for (const auto& part : parts) own += part.model.points.size();
  if (own >= coupled.points.size()) return Vector::Zero(modes.cols());
  const Sparse K = coupling::normalStiffness(coupled, own);
  return modes.cwiseProduct(Matrix(K * modes)).colwise().sum().transpose();
}

/// Error and its shares of the j-th mode; returns the estimate of the full eigenvalue.
/// \param work D' K D of terms that belong to no part
double assess(FrequencyEstimate& e, Eigen::Index j, const std::vector<std::vector<Share>>& all,
              double work) {
  const double lambda = e.eigenvalue;
  double mass = 0;
  std::vector<ResidualFlexibility::Step> steps;
  for (const auto& part : all) {
    const Share& share = part[static_cast<std::size_t>(j)];
    mass += share.mass;
    work += share.work;
    steps.push_back(share.step);
    e.definite = e.definite && share.step.pole() > lambda;
  }
  const double mu = improvedEigenvalue(lambda, mass, steps);
  double sum = 0;
  for (std::size_t p = 0; p < steps.size(); ++p)
    sum += e.byPart[static_cast<Eigen::Index>(p)] = steps[p].excess(lambda, mu);
  // f = sqrt(lambda): f / f_full - 1 with lambda_full = mu + D' (K - lambda M) D / D' M D
  const double full = mu + work / mass;
  const double truncation = signedRatio(lambda, mu);
  if (sum > 0) e.byPart *= truncation / sum;
  e.error = signedRatio(lambda, full);
  return full;
}

/// Counts of the full model at bounds between its eigenvalues. With a Ritz basis the coupled
/// eigenvalues are never below the full ones of the same number. So below a bound that is not
/// between the estimate and the coupled value of a mode, there are as many full eigenvalues as
/// coupled ones, and more only if modes are missing.
class ModeCounts {
 public:
  /// \param full estimated eigenvalues, one for each coupled mode
  /// \param smallest upper bound of rigid-body eigenvalues: no bound lies between two of them
  ModeCounts(const std::vector<model::Substructure>& parts, const coupling::Synthesis& synthesis,
             std::vector<double> full, const std::vector<FrequencyEstimate>& estimates,
             double smallest)
      : parts_(parts), synthesis_(synthesis), full_(std::move(full)) {
    std::vector<std::size_t> order(full_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return full_[a] < full_[b]; });
    double below = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 1; i < order.size(); ++i) {
      below = std::max({below, full_[order[i - 1]], estimates[order[i - 1]].eigenvalue});
      const double above = full_[order[i]];
      const bool bothRigid = std::max(std::abs(below), std::abs(above)) <= smallest;
      if (!bothRigid && above - below > closest * std::abs(above))
        gaps_.push_back({below, above, std::abs(estimates[order[i]].error) > sure});
    }
    // Just below the last eigenvalue.
    const auto& last = estimates[order.back()];
    const double above = full_[order.back()];
    const double margin = std::max(closest, std::abs(last.error)) * std::abs(above);
    if (!gaps_.empty() && above - margin > gaps_.back().middle() && gaps_.back().above == above)
      gaps_.push_back({std::max(gaps_.back().middle(), above - 2.0 * margin), above, true});
  }

  /// The bound above which modes are missing, if any. No mode is missing below it; -infinity if
  /// there is no such bound.
  std::optional<double> missingAbove() const {
    std::size_t bad = 0;
    while (bad < gaps_.size() &&
           !((gaps_[bad].doubtful || bad + 1 == gaps_.size()) && missing(gaps_[bad].middle())))
      ++bad;
    if (bad == gaps_.size()) return {};
    std::size_t good = 0;  // the first `good` gaps have no missing modes, as far as computed
    while (good < bad) {
      const std::size_t middle = (good + bad) / 2;
      if (missing(gaps_[middle].middle()))
        bad = middle;
      else
        good = middle + 1;
    }
    const double above = gaps_[bad].at(justAbove);
    if (!missing(above)) return above;
    return good > 0 ? gaps_[good - 1].middle() : -std::numeric_limits<double>::infinity();
  }

 private:
  /// Relative distance of eigenvalues that counts do not separate.
  static constexpr double closest = 1e-4;
  /// With a smaller estimated error the full eigenvalue is the one next to the coupled one. With a
  /// larger error the estimate may belong to another mode, and the full model is solved.
  static constexpr double sure = 1e-3;
  /// Position in a gap of a bound close to the mode below it.
  static constexpr double justAbove = 0.02;
  /// Relative distance of the second bound if the first has no count.
  static constexpr double beside = 1e-7;

  struct Gap {
    double below, above;
    bool doubtful;  ///< must be counted in any case
    double at(double share) const { return below + share * (above - below); }
    double middle() const { return at(0.5); }
  };

  bool missing(double bound) const {
    const auto expected =
        std::count_if(full_.begin(), full_.end(), [&](double x) { return x < bound; });
    return count(bound) > expected;
  }

  /// A bound that is an eigenvalue of an interior has no count; then a slightly larger one is used.
  int count(double bound) const {
    try {
      return coupling::fullEigenvaluesBelow(parts_, synthesis_, bound);
    } catch (const ConvergenceError&) {
      return coupling::fullEigenvaluesBelow(parts_, synthesis_, bound + beside * std::abs(bound));
    }
  }

  const std::vector<model::Substructure>& parts_;
  const coupling::Synthesis& synthesis_;
  std::vector<double> full_;
  std::vector<Gap> gaps_;
};

/// Errors of `pairs`, modes of a coupled model with whole interfaces.
std::vector<FrequencyEstimate> assessAll(const std::vector<model::Substructure>& parts,
                                         const coupling::Synthesis& synthesis,
                                         const linalg::EigenPairs& pairs) {
  const auto& coupled = synthesis.coupled.model;
  const auto all = reduction::shareOut<std::vector<Share>>(parts, [&](std::size_t p,
                                                                      parallel::Ranks ranks) {
    return shares(parts[p], *synthesis.parts[p].basis,
                  synthesis.coupled.local(static_cast<int>(p), pairs.vectors), pairs.values, ranks);
  });

  double smallest = 0;  // upper bound of rigid-body eigenvalues
  const Vector connectors = workOfConnectors(parts, coupled, pairs.vectors);
  std::vector<FrequencyEstimate> estimates(at(pairs.values.size()));
  std::vector<double> full;
  for (Eigen::Index j = 0; j < pairs.values.size(); ++j) {
    FrequencyEstimate& e = estimates[at(j)];
    e.eigenvalue = e.full = pairs.values[j];
    e.byPart = Vector::Zero(sizeOf(parts));
    e.isRigid = isRigid(e.eigenvalue, j, all);
    if (e.isRigid)
      smallest = std::max(smallest, std::abs(e.eigenvalue));
    else
      e.full = assess(e, j, all, connectors[j]);
    full.push_back(e.full);
  }
  if (estimates.empty()) return estimates;
  if (const auto bound = ModeCounts(parts, synthesis, full, estimates, smallest).missingAbove())
    for (auto& e : estimates)
      if (e.full > *bound) e.definite = false;
  return estimates;
}

/// Errors of `pairs`, modes of a model with reduced interfaces.
std::vector<FrequencyEstimate> assessReduced(const std::vector<model::Substructure>& parts,
                                             const coupling::Synthesis& synthesis,
                                             const linalg::EigenPairs& pairs) {
  const coupling::Synthesis whole{synthesis.parts, *synthesis.coupled.wholeInterfaces};
  const auto& model = whole.coupled.model;
  const auto before = coupling::lowestModes(model, std::min(pairs.count() + more, model.size()));
  const auto estimates = assessAll(parts, whole, before);
  const Matrix shapes = synthesis.coupled.interfaceMap * pairs.vectors;
  const auto matches = matchModes(reduction::symmetricPart(model.mass),
                                  before.values.cast<Complex>(), before.vectors.cast<Complex>(),
                                  pairs.values.cast<Complex>(), shapes.cast<Complex>());
  std::vector<FrequencyEstimate> found(at(pairs.values.size()));
  bool noneMissing = true;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    const int j = matches[i].partner;
    noneMissing = noneMissing && j >= 0;
    if (j < 0) continue;
    FrequencyEstimate& e = found[at(j)] = estimates[i];
    e.eigenvalue = pairs.values[j];
    e.definite = e.definite && noneMissing;
    if (e.isRigid) continue;
    e.error = signedRatio(e.eigenvalue, e.full);
    e.interfaces = signedRatio(e.eigenvalue, before.values[static_cast<Eigen::Index>(i)]);
  }
  return found;
}

}  // namespace

double FrequencyEstimate::frequency() const {
  if (isRigid) return 0.0;
  return std::copysign(std::sqrt(std::abs(eigenvalue)) / twoPi, eigenvalue);
}

std::vector<FrequencyEstimate> estimateFrequencies(const std::vector<model::Substructure>& parts,
                                                   const coupling::Synthesis& synthesis,
                                                   const FrequencyWindow& window) {
  requireRitz(synthesis);
  const auto& coupled = synthesis.coupled.model;
  const auto pairs =
      window.belowHz > 0
          ? linalg::lowestModesBelow(coupling::undampedStiffness(coupled),
                                     reduction::symmetricPart(coupled.mass), twoPi * window.belowHz)
          : coupling::lowestModes(coupled, std::min(window.count, coupled.size()));
  return synthesis.coupled.wholeInterfaces ? assessReduced(parts, synthesis, pairs)
                                           : assessAll(parts, synthesis, pairs);
}

std::string frequencyTable(const std::vector<FrequencyEstimate>& estimates,
                           const std::vector<model::Substructure>& parts) {
  std::string text =
      "Estimated errors of the coupled frequencies:\n  mode    coupled [Hz]   estimated error   "
      "most of it from\n";
  for (std::size_t j = 0; j < estimates.size(); ++j) {
    const auto& e = estimates[j];
    Eigen::Index worst = 0;
    if (e.byPart.size() > 0) e.byPart.maxCoeff(&worst);
    const bool known = e.byPart.size() > 0 && e.byPart[worst] > 0;
    const bool joints = e.interfaces > (known ? e.byPart[worst] : 0.0);
    text += fmt::format("  {:4}  {:14.8g}  {:16.2e}   {}{}\n", j + 1, e.frequency(), e.error,
                        joints  ? "interfaces"
                        : known ? parts[at(worst)].name
                                : "-",
                        e.definite ? "" : " (modes are missing below this frequency)");
  }
  return text;
}

}  // namespace tooljoint::estimate
