// SPDX-License-Identifier: BSD-3-Clause
#include "estimate/MotionEstimate.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <utility>

#include "common/Error.hpp"
#include "common/Interrupt.hpp"
#include "common/Text.hpp"
#include "estimate/PartResidual.hpp"
#include "estimate/StateErrors.hpp"
#include "estimate/TruncatedStart.hpp"
#include "linalg/blocks/BlockFactor.hpp"
#include "transient/compiled/CompiledModel.hpp"

namespace tooljoint::estimate {

namespace {

/// Fewest samples before a motion is stopped, because its start does not show which part causes the
/// error.
constexpr long fewSamples = 10;

/// LU of a matrix on the pattern of a compiled model; vectors in positions.
class Factor {
 public:
  explicit Factor(const linalg::BlockPattern& pattern)
      : factor_(pattern), storage_(pattern.storage()) {}
  /// The matrix to fill, set to zero.
  double* clear() {
    std::fill(factor_.values(), factor_.values() + storage_, 0.0);
    return factor_.values();
  }
  int factor() { return factor_.factor(); }
  Vector solve(Vector b) const {
    factor_.solve(b.data());
    return b;
  }

 private:
  linalg::BlockFactor factor_;
  std::size_t storage_;
};

}  // namespace

struct MotionEstimator::Impl {
  Impl(const std::vector<model::Substructure>& parts_, const coupling::Synthesis& synthesis_,
       Vector rest_, MotionOptions options_)
      : parts(parts_),
        model(synthesis_.coupled.model),
        rest(std::move(rest_)),
        options(std::move(options_)),
        compiled(model),
        mass(compiled.pattern()),
        step(compiled.pattern()) {
    requireRitz(synthesis_);
    if (synthesis_.coupled.interfaceModes >= 0 || synthesis_.coupled.dependent > 0 ||
        !synthesis_.coupled.multipliers.empty())
      throw ModelError(
          "The error of the motion is not estimated with interface reduction, dependent "
          "coordinates (\"Residual Coordinates\" = \"Tied\") or dual assembly. Set \"Error "
          "Estimate\" to \"Frequencies\".");
    for (std::size_t p = 0; p < parts.size(); ++p) {
      residuals.emplace_back(parts[p], synthesis_.parts[p], synthesis_.coupled.maps[p],
                             synthesis_.coupled.offsets[p]);
      const Sparse& turn = synthesis_.coupled.recoveryTurns[p];
      recovery.push_back(turn.size() > 0 ? Sparse(turn * parts[p].model.recovery)
                                         : Sparse(parts[p].model.recovery));
      for (const auto& points : parts[p].model.points)
        pointSets.push_back({p, &points.rows, {}, {}, nullptr});
    }
    const auto batches = compiled.points().size();
    while (pointSets.size() < batches) pointSets.push_back({joint, nullptr, {}, {}, nullptr});
    for (std::size_t b = 0; b < batches; ++b)
      if (compiled.points()[b].states() != nullptr)
        pointSets[b].states = std::make_unique<StateErrors>(compiled.points()[b]);
    energies.assign(parts.size(), 0.0);
    w.assign(parts.size(), Vector());
    starts.resize(parts.size());
    values.resize(compiled.pattern().storage());
    compiled.combine(1, 0, 0, mass.clear());
    const int bad = mass.factor();
    if (bad >= 0)
      throw ModelError(
          "The error of the motion cannot be estimated: the mass matrix of the coupled model is "
          "singular at " +
          compiled.dofName(bad) + ". Set \"Error Estimate\" to \"Frequencies\".");
    mapRecovery();
    u = uDot = s = Vector::Zero(model.size());
  }

  /// Row of the coupled recovery of every recovered row of a part.
  void mapRecovery() {
    const auto width = static_cast<int>(model.componentNames.size());
    std::map<std::int64_t, int> first;
    for (std::size_t i = 0; i < model.recoveryNodes.size(); ++i)
      first[model.recoveryNodes[i]] = static_cast<int>(i) * width;
    for (const auto& part : parts) {
      std::vector<int> rows;
      for (auto node : part.model.recoveryNodes)
        for (int c = 0; c < width; ++c) rows.push_back(first.at(node) + c);
      recovered.push_back(rows);
    }
  }

  const std::vector<model::Substructure>& parts;
  const model::SecondOrderModel& model;
  Vector rest;
  MotionOptions options;
  std::vector<PartResidual> residuals;
  std::vector<std::vector<int>> recovered;
  std::vector<Sparse> recovery;  ///< of the parts, in the common frame
  static constexpr auto joint = static_cast<std::size_t>(-1);
  /// A batch of the coupled model (points of every part, then points between parts), and the
  /// truncated motion at its points: R s - w.
  struct PointErrors {
    std::size_t part;    ///< joint: between parts
    const Sparse* rows;  ///< of the part
    Vector motion, rate;
    std::unique_ptr<StateErrors> states;  ///< of a law with states
  };
  std::vector<PointErrors> pointSets;
  Vector pointStates;  ///< of the run, at the next sample
  transient::CompiledModel compiled;
  Factor mass, step;
  linalg::BlockValues values;

  std::vector<TruncatedStart> starts;
  double startTime = 0;
  double time = 0;
  Vector q, qDot;         ///< at the last sample, dofs
  Vector lastRate;        ///< rate of the recovered displacement there
  Vector u, uDot;         ///< error equation, positions
  std::vector<Vector> w;  ///< truncated motion of each part, mean of the last interval
  Vector s;               ///< P w of the last interval, positions
  std::vector<double> energies;
  /// Squares summed over the measured components of all samples.
  struct Sums {
    double errors = 0, motions = 0;
    double worst = 0;  ///< errors of one sample
    long samples = 0;
    double ways = 0, rates = 0;  ///< (x(t + h) - x(t))^2 and (h x')^2
    double wall = 0;             ///< time spent on them [s]
  } sums;

  void begin(double t);
  void advance(double t, const Vector& qNew, const Vector& qDotNew);
  void measure(double h, const Vector& moved);
  Vector positions(const Vector& dofs) const {
    Vector x(dofs.size());
    compiled.toPositions(dofs, x);
    return x;
  }
  Vector pull(double t, double h, const std::vector<Vector>& wNew, const Vector& sNew);
  Vector pointForce(std::size_t part);
  void evaluatePoints(double t, double h, const Vector& at, const Vector& rate);
  void beginStates(double t);
  void followStates(double t, const Vector& qNew, const Vector& qDotNew, const Vector& middle,
                    const Vector& middleRate);
};

MotionEstimator::MotionEstimator(const std::vector<model::Substructure>& parts,
                                 const coupling::Synthesis& synthesis, Vector rest,
                                 MotionOptions options)
    : impl_(std::make_unique<Impl>(parts, synthesis, rest, options)),
      coarse_(std::make_unique<Impl>(parts, synthesis, std::move(rest), std::move(options))) {}
MotionEstimator::~MotionEstimator() = default;

void MotionEstimator::states(const Vector& x) {
  impl_->pointStates = x;
  if (coarse_) coarse_->pointStates = x;
}

void MotionEstimator::sample(double t, const Vector& q, const Vector& qDot,
                             const Vector& /*qDDot*/) {
  const auto start = std::chrono::steady_clock::now();
  const bool second = coarse_ && impl_->sums.samples % 2 == 0;
  look(*impl_, t, q, qDot);
  if (second) try {
      look(*coarse_, t, q, qDot);
    } catch (const ConvergenceError&) {
      coarse_.reset();
    }
  impl_->sums.wall +=
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void MotionEstimator::look(Impl& m, double t, const Vector& q, const Vector& qDot) {
  if (m.pointStates.size() != m.compiled.states().size())
    throw Error(ExitCode::Internal, "The states of the point laws were not given to the estimate.");
  const bool first = m.sums.samples == 0;
  const double h = first ? 0.0 : t - m.time;
  const Vector moved = first ? Vector(Vector::Zero(q.size())) : Vector(q - m.q);
  if (h > 0.0) m.advance(t, q, qDot);
  m.time = t;
  m.q = q;
  m.qDot = qDot;
  if (first) m.begin(t);
  m.measure(h, moved);
}

/// Error of the initial state: u = P e, u' = P e'. The part of it outside the modes vibrates in the
/// interiors.
void MotionEstimator::Impl::begin(double t) {
  compiled.setTime(t);
  Vector g = Vector::Zero(model.size()), gDot = g;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const auto& part = parts[p].model;
    const PartMotion state = residuals[p].motion(q, qDot, qDot);
    residuals[p].scatter(part.mass * (part.initialDisplacement - state.displacement), g);
    residuals[p].scatter(part.mass * (part.initialVelocity - state.velocity), gDot);
  }
  u = mass.solve(positions(g));
  uDot = mass.solve(positions(gDot));
  startTime = t;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    if (residuals[p].complete()) continue;
    const auto& part = parts[p].model;
    const PartMotion state = residuals[p].motion(q, qDot, qDot);
    starts[p].begin(residuals[p], part.initialDisplacement - state.displacement,
                    part.initialVelocity - state.velocity);
  }
  beginStates(t);
}

/// States at an initial state with an error.
void MotionEstimator::Impl::beginStates(double t) {
  int offset = 0;
  const Vector at = positions(q), rate = positions(qDot);
  for (std::size_t b = 0; b < pointSets.size(); ++b) {
    auto& points = pointSets[b];
    if (points.states == nullptr) continue;
    auto& batch = compiled.points()[b];
    const auto rows = static_cast<Eigen::Index>(batch.points()) * batch.width();
    Vector e = Vector::Zero(rows), eDot = e;
    if (points.part != joint) {
      const auto& part = parts[points.part].model;
      const PartMotion state = residuals[points.part].motion(q, qDot, qDot);
      e = *points.rows * (part.initialDisplacement - state.displacement);
      eDot = *points.rows * (part.initialVelocity - state.velocity);
    } else {
      batch.gather(batch.everyPoint(), u.data(), e.data());
      batch.gather(batch.everyPoint(), uDot.data(), eDot.data());
    }
    batch.gatherAll(at.data(), rate.data());
    points.states->begin(t, pointStates.data() + offset, e, eDot);
    offset += batch.states()->size();
  }
}

/// Errors of the states over the interval that ends at t, and the motion accepted there.
void MotionEstimator::Impl::followStates(double t, const Vector& qNew, const Vector& qDotNew,
                                         const Vector& middle, const Vector& middleRate) {
  const Vector at = positions(qNew), rate = positions(qDotNew);
  for (std::size_t b = 0; b < pointSets.size(); ++b) {
    auto& points = pointSets[b];
    if (points.states == nullptr) continue;
    auto& batch = compiled.points()[b];
    // R u - (R s - w)
    const auto errorOf = [&](const Vector& x, const Vector& truncated) {
      Vector e(truncated.size());
      batch.gather(batch.everyPoint(), x.data(), e.data());
      return Vector(e - truncated);
    };
    points.states->follow(errorOf(middle, points.motion), errorOf(middleRate, points.rate),
                          options.damping);
    batch.gatherAll(at.data(), rate.data());
    points.states->accept(t, errorOf(u, points.motion), errorOf(uDot, points.rate));
  }
}

/// Evaluates the points with tangents in the middle of an interval, with the states of the run
/// there.
void MotionEstimator::Impl::evaluatePoints(double t, double h, const Vector& at,
                                           const Vector& rate) try {
  int offset = 0;
  for (std::size_t b = 0; b < pointSets.size(); ++b) {
    auto& batch = compiled.points()[b];
    if (pointSets[b].states != nullptr) {
      pointSets[b].states->bind(pointStates.data() + offset, options.damping * h);
      offset += batch.states()->size();
    }
    batch.look(t, h, at.data());
    batch.evaluateWithTangent(t, at.data(), rate.data());
  }
} catch (const ConvergenceError& error) {  // mostly a delay line: it ends at the last sample
  throw ConvergenceError("The error of the motion cannot be estimated: at t = " + formatNumber(t) +
                         " s a point law cannot be evaluated, usually because its delay is shorter "
                         "than the sampling interval. Reduce Transient/Sampling Interval, or set "
                         "\"Error Estimate\" to \"Frequencies\". " +
                         error.what());
}

/// R' f of the points of a part, from the last evaluation.
Vector MotionEstimator::Impl::pointForce(std::size_t part) {
  Vector force = Vector::Zero(parts[part].model.size());
  for (std::size_t b = 0; b < pointSets.size(); ++b) {
    if (pointSets[b].part != part) continue;
    const auto& batch = compiled.points()[b];
    Vector f = Vector::Zero(static_cast<Eigen::Index>(batch.points()) * batch.width());
    for (int point : batch.active())
      for (int i = point * batch.width(); i < (point + 1) * batch.width(); ++i)
        f[i] = batch.force()[i];
    force += pointSets[b].rows->transpose() * f;
  }
  return force;
}

/// Phi' (K_t s + C_t s') with s = Phi P w - w; tangents of the points from the last evaluation.
Vector MotionEstimator::Impl::pull(double t, double h, const std::vector<Vector>& wNew,
                                   const Vector& sNew) {
  const bool rated = sums.samples > 1;  // there is a previous interval
  const Vector sDot = rated ? Vector((sNew - s) / h) : Vector(Vector::Zero(s.size()));
  Vector own = Vector::Zero(model.size());
  for (std::size_t p = 0; p < parts.size(); ++p) {
    if (residuals[p].complete()) continue;
    Vector local = residuals[p].stiffnessTimes(t, wNew[p]);
    if (rated) local += residuals[p].dampingTimes(t, (wNew[p] - w[p]) / h);
    residuals[p].scatter(local, own);
  }
  Vector force = -positions(own);
  compiled.addStiffness(sNew.data(), force.data());
  compiled.addDamping(sDot.data(), force.data());
  for (std::size_t b = 0; b < pointSets.size(); ++b) {
    auto& points = pointSets[b];
    auto& batch = compiled.points()[b];
    points.motion.setZero(static_cast<Eigen::Index>(batch.points()) * batch.width());
    points.rate.setZero(points.motion.size());
    batch.gather(batch.active(), sNew.data(), points.motion.data());
    batch.gather(batch.active(), sDot.data(), points.rate.data());
    if (points.part != joint && !residuals[points.part].complete()) {
      points.motion -= *points.rows * wNew[points.part];
      if (rated) points.rate -= *points.rows * (wNew[points.part] - w[points.part]) / h;
    }
    const int width = batch.width();
    Vector f = Vector::Zero(points.motion.size());
    for (int point : batch.active())
      for (int i = 0; i < width; ++i)
        for (int j = 0; j < width; ++j) {
          const int entry = (point * width + i) * width + j;
          f[point * width + i] -= batch.dfdd()[entry] * points.motion[point * width + j] +
                                  batch.dfdv()[entry] * points.rate[point * width + j];
        }
    if (points.states != nullptr) f += points.states->force(t);
    batch.scatter(batch.active(), f.data(), force.data());
  }
  return force;
}

void MotionEstimator::Impl::advance(double t, const Vector& qNew, const Vector& qDotNew) {
  const double h = t - time;
  const double middle = 0.5 * (time + t);
  // Means over the interval: acceleration and velocity exactly, displacement by the Hermite cubic.
  const Vector acceleration = (qDotNew - qDot) / h;
  const Vector velocity = (qNew - q) / h;
  const Vector displacement = 0.5 * (q + qNew) - h / 12.0 * (qDotNew - qDot);

  compiled.setTime(middle);
  const Vector at = positions(displacement), rate = positions(velocity);
  evaluatePoints(middle, h, at, rate);

  // w of all parts, s = P w
  std::vector<Vector> wNew(parts.size());
  Vector g = Vector::Zero(model.size());
  for (std::size_t p = 0; p < parts.size(); ++p) {
    if (residuals[p].complete()) continue;
    wNew[p] = residuals[p].truncated(
        middle, residuals[p].motion(displacement, velocity, acceleration), pointForce(p));
    starts[p].add(middle - startTime, wNew[p]);
    if (w[p].size() == 0) w[p] = wNew[p];
    energies[p] += h * residuals[p].energy(wNew[p]);
    residuals[p].scatter(parts[p].model.mass * wNew[p], g);
  }
  const Vector sNew = mass.solve(positions(g));

  Vector force = pull(middle, h, wNew, sNew);

  // M (u1' - u0')/h + C u' + K u = force with u' = (1-a) u0' + a u1', u = u0 + a h u'
  const double a = options.damping;
  double* A = step.clear();
  compiled.combine(1.0 / (a * h), 1.0, a * h, A);
  for (auto& batch : compiled.points()) {
    batch.freezeTangent(a * h, 1.0);
    batch.subtractTangent(A);
  }
  const int bad = step.factor();
  if (bad >= 0)
    throw ConvergenceError("The error equation of the motion is singular at t = " +
                           formatNumber(t) + " s, " + compiled.dofName(bad) + ".");
  Vector minus = -u;
  compiled.addStiffness(minus.data(), force.data());
  for (auto& batch : compiled.points()) {
    batch.freezeTangent(1.0, 0.0);
    batch.addTangentTimes(u.data(), force.data());
  }
  const Vector momentum = uDot / (a * h);
  compiled.addMass(momentum.data(), force.data());
  const Vector mean = step.solve(force);
  const Vector middleError = u + a * h * mean;
  u += h * mean;
  uDot += (mean - uDot) / a;
  followStates(t, qNew, qDotNew, middleError, mean);
  w = wNew;
  s = sNew;
}

/// \param h, moved  since the last sample [s], dofs; 0 at the first
void MotionEstimator::Impl::measure(double h, const Vector& moved) {
  ++sums.samples;
  // e = Phi (u - P w) + w
  Vector correction(u.size());
  compiled.toDofs(u - s, correction);
  Vector error = model.recovery * correction;
  for (std::size_t p = 0; p < w.size(); ++p) {
    if (w[p].size() == 0) continue;
    const Vector local = recovery[p] * w[p];
    for (std::size_t i = 0; i < recovered[p].size(); ++i)
      error[recovered[p][i]] += local[static_cast<Eigen::Index>(i)];
  }
  const Vector motion = model.recoveryOffset + model.recovery * q - rest;
  const Vector way = model.recovery * moved, rateNew = model.recovery * qDot;
  if (lastRate.size() == 0) lastRate = rateNew;
  const auto width = static_cast<Eigen::Index>(model.componentNames.size());
  double e = 0, x = 0;
  for (Eigen::Index node = 0; node < error.size() / width; ++node)
    for (int c : options.components) {
      const Eigen::Index row = node * width + c;
      e += error[row] * error[row];
      x += motion[row] * motion[row];
      sums.ways += way[row] * way[row];
      sums.rates += 0.5 * h * h * (lastRate[row] * lastRate[row] + rateNew[row] * rateNew[row]);
    }
  lastRate = rateNew;
  sums.errors += e;
  sums.motions += x;
  sums.worst = std::max(sums.worst, e);
}

MotionEstimate MotionEstimator::result() const {
  const Impl& m = *impl_;
  MotionEstimate estimate;
  estimate.samples = m.sums.samples;
  estimate.motion = m.sums.motions;
  estimate.wall = m.sums.wall;
  if (m.sums.ways > 0) estimate.roughness = m.sums.rates / m.sums.ways;
  if (coarse_ && coarse_->sums.samples > fewSamples && coarse_->sums.motions > 0)
    estimate.ofEverySecond = std::sqrt(coarse_->sums.errors / coarse_->sums.motions);
  if (m.sums.motions > 0) {
    estimate.error = std::sqrt(m.sums.errors / m.sums.motions);
    estimate.largest =
        std::sqrt(m.sums.worst * static_cast<double>(m.sums.samples) / m.sums.motions);
  } else if (m.sums.errors > 0) {
    estimate.error = estimate.largest = 1;  // the basis contains nothing of the motion
  }
  estimate.byPart =
      Eigen::Map<const Vector>(m.energies.data(), static_cast<Eigen::Index>(m.energies.size()));
  if (estimate.byPart.size() > 0 && estimate.byPart.sum() > 0)
    estimate.byPart /= estimate.byPart.sum();
  return estimate;
}

bool MotionEstimator::exceeds(const MotionLimit& limit) const {
  return std::isfinite(limit.error) && impl_->sums.samples >= fewSamples &&
         impl_->sums.errors >
             limit.error * limit.error * std::max(limit.motion, impl_->sums.motions);
}

MotionEstimate watchMotion(MotionEstimator& estimator, const model::SecondOrderModel& model,
                           const transient::TransientOptions& options, const MotionLimit& limit,
                           const std::string& title) {
  transient::RunHooks hooks;
  hooks.title = title;
  hooks.stop = [&] { return interruptRequested() || estimator.exceeds(limit); };
  const auto report = transient::integrate(model, options, estimator, hooks);
  auto estimate = estimator.result();
  if (!report.interrupted) return estimate;
  if (interruptRequested())
    throw InterruptedError(
        fmt::format("Interrupted at {:g} s of a transient for the mode selection.", report.end));
  estimate.reached = (report.end - options.start) / (options.end - options.start);
  // errors / reached over the motion expected at the end; estimate.error is relative to the motion
  // so far
  const double soFar =
      estimate.motion > 0 ? std::min(1.0, estimate.motion / std::max(limit.motion, estimate.motion))
                          : 1.0;
  estimate.error *= std::sqrt(soFar / estimate.reached);
  return estimate;
}

}  // namespace tooljoint::estimate
