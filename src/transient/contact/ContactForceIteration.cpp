// SPDX-License-Identifier: BSD-3-Clause
#include "transient/contact/ContactForceIteration.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "common/Index.hpp"
#include "transient/Tuned.hpp"
#include "transient/compiled/PointWidth.hpp"

namespace tooljoint::transient {
namespace {

/// B = A^-1 for A 3 x 3, row-major, by cofactors; false when A is singular to rounding.
bool invertThree(const double* A, double* B) {
  const double c0 = A[4] * A[8] - A[5] * A[7], c1 = A[5] * A[6] - A[3] * A[8],
               c2 = A[3] * A[7] - A[4] * A[6];
  const double determinant = A[0] * c0 + A[1] * c1 + A[2] * c2;
  const double size = std::abs(A[0] * c0) + std::abs(A[1] * c1) + std::abs(A[2] * c2);
  if (!(std::abs(determinant) > Tuned::rounding * size)) return false;
  const double r = 1.0 / determinant;
  B[0] = r * c0, B[1] = r * (A[2] * A[7] - A[1] * A[8]), B[2] = r * (A[1] * A[5] - A[2] * A[4]);
  B[3] = r * c1, B[4] = r * (A[0] * A[8] - A[2] * A[6]), B[5] = r * (A[2] * A[3] - A[0] * A[5]);
  B[6] = r * c2, B[7] = r * (A[1] * A[6] - A[0] * A[7]), B[8] = r * (A[0] * A[4] - A[1] * A[3]);
  return true;
}

/// The same for up to six rows.
bool invertFew(int n, const double* A, double* B) {
  if (n == 3) return invertThree(A, B);
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor, 6, 6>;
  const Rows matrix = Eigen::Map<const Rows>(A, n, n);
  const Rows inverse = matrix.partialPivLu().inverse();
  if (!inverse.allFinite()) return false;
  std::copy_n(inverse.data(), n * n, B);
  return true;
}

void setIdentity(int n, double* B) {
  for (int i = 0; i < n * n; ++i) B[i] = i % (n + 1) == 0 ? 1.0 : 0.0;
}

/// -tr(J G): above 1 where a wall gives way less than what meets it.
double yielding(int n, const double* J, const double* G) {
  double trace = 0;
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) trace -= J[i * n + k] * G[k * n + i];
  return trace;
}

}  // namespace

void ContactForceIteration::bind(CompiledModel& model, Strategies& strategies) {
  model_ = &model;
  strategies_ = problem_.strategies = &strategies;
  sets_.clear();
  blocks_.assign(at(model.pattern().blocks()), 0);
  for (const auto& batch : model.points()) {
    Set set;
    const std::size_t rows = at(batch.points()) * at(batch.width());
    for (auto* array : {&set.d, &set.y, &set.p, &set.defect, &set.weight, &set.target, &set.change})
      array->assign(rows, 0.0);
    set.compliance.assign(rows * at(batch.width()), 0.0);
    set.answer.assign(rows * at(batch.width()), 0.0);
    set.started.assign(at(batch.points()), 0);
    set.known.assign(at(batch.points()), 0);
    set.stiffness.assign(at(batch.points()), 0.0);
    set.error.assign(at(batch.points()), 0.0);
    set.exact.assign(at(batch.points()), 0);
    set.moved.assign(at(batch.points()), 1);
    set.listed.assign(at(batch.points()), 0);
    set.points.reserve(at(batch.points()));
    sets_.push_back(std::move(set));
    batch.markBlocks(blocks_);
  }
  near_.setZero(model.size());
  live_.clear();
  live_.reserve(4 * blocks_.size());
}

void ContactForceIteration::setWeights(const Vector& weight) {
  weight_ = weight;
  for (std::size_t b = 0; b < sets_.size(); ++b)
    for (std::size_t r = 0; r < sets_[b].weight.size(); ++r)
      sets_[b].weight[r] = model_->points()[b].rowWeight(static_cast<int>(r), weight.data());
}

void ContactForceIteration::setImpacts(double h, double impact) {
  h_ = h;
  impact_ = impact;
  for (std::size_t b = 0; b < sets_.size(); ++b)
    for (int p = 0; p < model_->points()[b].points(); ++p)
      model_->points()[b].setScale(p, sets_[b].stiffness[at(p)] * h * h > 1.0 ? impact : 1.0);
}

/// After an evaluation of set.points with tangents: those that turn out to be stiff are impacts
/// from now on.
///
///     G0 = G (I + P G)^-1,   stiffness = -tr(df/dd G0) / h^2
void ContactForceIteration::findImpacts(Set& set, PointBatch& batch, double t) {
  if (impact_ == 1.0) return;
  const int w = batch.width();
  double A[widest * widest], B[widest * widest], G0[widest * widest];
  for (int p : set.points) {
    const double* J = batch.dfdd() + p * w * w;
    const double* P = batch.frozen() + p * w * w;
    const double* G = &set.compliance[at(p * w * w)];
    if (yielding(w, J, G) < 0.5) continue;  // with J = P that is a stiffness of 1/h^2
    for (int i = 0; i < w; ++i)
      for (int j = 0; j < w; ++j) {
        A[i * w + j] = i == j ? 1.0 : 0.0;
        for (int k = 0; k < w; ++k) A[i * w + j] += P[i * w + k] * G[k * w + j];
      }
    if (!invertFew(w, A, B)) continue;
    for (int i = 0; i < w; ++i)
      for (int j = 0; j < w; ++j) {
        G0[i * w + j] = 0;
        for (int k = 0; k < w; ++k) G0[i * w + j] += G[i * w + k] * B[k * w + j];
      }
    const double unit = batch.scale(p) * h_ * h_, here = yielding(w, J, G0);
    if (here / unit <= set.stiffness[at(p)]) continue;
    set.stiffness[at(p)] =
        std::max(set.stiffness[at(p)], std::min(here, yieldingDeeper(batch, p, t, G0)) / unit);
    if (batch.scale(p) == 1.0 && set.stiffness[at(p)] * h_ * h_ > 1.0) {
      batch.setScale(p, impact_);
      batch.rescale(p);
      strategies_->count(Strategy::RestingImpacts);
    }
  }
}

/// -tr(df/dd G0) as far beyond a point as its force moves it in the step: what is steep there too
/// is the wall, and not the depth in which a regularised law begins.
double ContactForceIteration::yieldingDeeper(PointBatch& batch, int point, double t,
                                             const double* G0) {
  using Rows =
      Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;
  const int w = batch.width();
  const auto local = [&](const double* rows) -> PointSolve::Local {
    return Eigen::Map<const Vector>(rows + point * w, w);
  };
  const PointSolve::Local d = local(batch.d()), v = local(batch.v()),
                          deeper = d - Rows(G0, w, w).lazyProduct(local(batch.force()));
  PointSolve::Local f = d;
  double dfdd[widest * widest] = {}, dfdv[widest * widest];
  batch.evaluateElsewhere(t, point, deeper.data(), v.data(), f.data(), dfdd, dfdv);
  return yielding(w, dfdd, G0);
}

void ContactForceIteration::setCompliance(linalg::BlockFactor& factor) {
  factor.invert(blocks_);
  inverse_ = factor.inverse();
  for (auto& set : sets_) std::fill(set.known.begin(), set.known.end(), 0);
}

void ContactForceIteration::save(std::vector<double>& memory) const {
  for (const auto& set : sets_)
    memory.insert(memory.end(), set.stiffness.begin(), set.stiffness.end());
}

void ContactForceIteration::restore(const double*& memory) {
  for (auto& set : sets_)
    for (double& stiffness : set.stiffness) stiffness = *memory++;
}

void ContactForceIteration::start(const Vector& q, const Vector& residual) {
  q_ = &q;
  residual_ = &residual;
  for (std::size_t b = 0; b < sets_.size(); ++b) {
    std::fill(sets_[b].started.begin(), sets_[b].started.end(), 0);
    sets_[b].points = model_->points()[b].active();
    start(sets_[b], model_->points()[b]);
  }
}

/// Of set.points.
void ContactForceIteration::start(Set& set, PointBatch& batch) {
  const int w = batch.width();
  batch.gatherPositions(set.points, q_->data());
  for (int p : set.points) {
    std::copy_n(batch.d() + p * w, w, &set.d[at(p * w)]);
    set.started[at(p)] = 1;
    set.exact[at(p)] = 0;
    set.moved[at(p)] = 1;
    set.error[at(p)] = std::numeric_limits<double>::infinity();
    if (set.known[at(p)]) continue;
    batch.project(p, inverse_, &set.compliance[at(p * w * w)]);
    set.known[at(p)] = 1;
  }
}

double ContactForceIteration::join(double t, double c, const Vector& delta, double small,
                                   double& force) {
  double worst = 0;
  for (std::size_t b = 0; b < sets_.size(); ++b) {
    Set& set = sets_[b];
    PointBatch& batch = model_->points()[b];
    set.points.clear();
    for (int p : batch.active())
      if (!set.started[at(p)]) set.points.push_back(p);
    start(set, batch);
    batch.gather(set.points, delta.data(), set.y.data());
    prepare(set, batch, t, c);
    for (int p : set.points) std::fill_n(&set.p[at(p * batch.width())], batch.width(), 0.0);
    measure(set, batch, small, force);
    for (int p : set.points)
      if (!(set.error[at(p)] <= worst)) worst = set.error[at(p)];  // keeps a NaN
  }
  return largestOfAll(worst, force);
}

double ContactForceIteration::largestOfAll(double worst, double& force) const {
  double both[2] = {worst, force};
  model_->cut().reduce(both, 2, nullptr, 0);
  force = both[1];
  return both[0];
}

void ContactForceIteration::place(Set& set, PointBatch& batch, double t, double c, bool tangent) {
  const double* y = set.y.data();
  double* d = batch.position();
  double* v = batch.velocity();
  withWidth(batch.width(), [&](auto width) {
    const int w = width;
    for (int p : set.points)
      for (int r = p * w; r < (p + 1) * w; ++r) d[r] = set.d[at(r)] + y[r], v[r] = c * y[r];
  });
  batch.evaluateHere(t, set.points, tangent);
}

double ContactForceIteration::evaluate(double t, double c, const Vector& delta, double small,
                                       double& force) {
  double worst = 0;
  for (std::size_t b = 0; b < sets_.size(); ++b) {
    Set& set = sets_[b];
    PointBatch& batch = model_->points()[b];
    if (isNear_)
      listMoved(set, batch);
    else
      set.points = batch.active();
    batch.gather(set.points, delta.data(), set.y.data());
    place(set, batch, t, c, false);
    measure(set, batch, small, force);
    for (int p : isNear_&& allMoved_ ? set.points : batch.active())
      if (!(set.error[at(p)] <= worst)) worst = set.error[at(p)];  // keeps a NaN
  }
  return largestOfAll(worst, force);
}

/// The points corrected, whose small change may have ended where it began, and those that
/// solveNear() reached.
void ContactForceIteration::listMoved(Set& set, const PointBatch& batch) const {
  for (int p : set.points) set.listed[at(p)] = 1;
  for (int block : live_)
    batch.forActiveIn(block, [&](int p) {
      if (!set.listed[at(p)]) set.points.push_back(p);
      set.listed[at(p)] = 1;
    });
  for (int p : set.points) set.listed[at(p)] = 0;
}

/// defect = f - P y - p of the points evaluated, and their errors.
void ContactForceIteration::measure(Set& set, PointBatch& batch, double small, double& force) {
  const double* f = batch.force();
  const double* P = batch.frozen();
  const double* y = set.y.data();
  const double* weight = set.weight.data();
  double largest = force;
  withWidth(batch.width(), [&](auto width) {
    const int w = width;
    for (int p : set.points) {
      double wrong = 0;
      for (int r = p * w; r < (p + 1) * w; ++r) {
        double known = set.p[at(r)];
        for (int k = 0; k < w; ++k) known += P[r * w + k] * y[p * w + k];
        const double defect = set.defect[at(r)] = f[r] - known;
        const double size =
            set.exact[at(p)] ? std::abs(y[r] - set.target[at(r)]) : weight[r] * std::abs(defect);
        if (!(size <= wrong)) wrong = size;  // keeps a NaN
        largest = std::max(largest, weight[r] * std::abs(f[r]));
      }
      if (set.moved[at(p)] && wrong > small && wrong > Tuned::slowestRate * set.error[at(p)] &&
          !set.exact[at(p)])
        set.exact[at(p)] = strategies_->use(Strategy::PointsAlone) ? 1 : 0;
      set.error[at(p)] = wrong;
    }
  });
  force = largest;
}

double ContactForceIteration::wrongShare() const {
  double wrong = 0, whole = 0;
  for (std::size_t b = 0; b < sets_.size(); ++b) {
    const Set& set = sets_[b];
    const PointBatch& batch = model_->points()[b];
    for (int p : batch.active())
      for (int r = p * batch.width(); r < (p + 1) * batch.width(); ++r) {
        const double error = set.weight[at(r)] * set.defect[at(r)],
                     force = set.weight[at(r)] * batch.force()[r];
        wrong += error * error, whole += force * force;
      }
  }
  double sums[2] = {wrong, whole};
  model_->cut().reduce(nullptr, 0, sums, 2);
  return sums[0] == 0
             ? 0.0
             : std::sqrt(sums[0] / sums[1]);  // infinite where all that was expected is gone
}

void ContactForceIteration::guess(double t, double c, const Vector& v) {
  for (std::size_t b = 0; b < sets_.size(); ++b) {
    Set& set = sets_[b];
    PointBatch& batch = model_->points()[b];
    set.points = batch.active();
    batch.gather(set.points, v.data(), set.y.data());
    const std::size_t w = at(batch.width());
    for (int p : set.points)
      for (std::size_t r = at(p) * w; r < at(p + 1) * w; ++r) set.y[r] /= c;
    prepare(set, batch, t, c);
  }
}

/// Laws, impacts and answers at y.
void ContactForceIteration::prepare(Set& set, PointBatch& batch, double t, double c) {
  if (set.points.empty()) return;
  place(set, batch, t, c, true);
  findImpacts(set, batch, t);
  withWidth(batch.width(), [&](auto width) {
    for (int p : set.points) answer(set, batch, p, c, width);
  });
}

/// Consistent forces p = f - P y of a point, and B = (I - (J - P) G)^-1.
template <class Width>
void ContactForceIteration::answer(Set& set, const PointBatch& batch, int point, double c,
                                   Width width) {
  const int w = width, first = point * w;
  const double* P = batch.frozen() + first * w;
  const double* f = batch.force() + first;
  for (int i = 0; i < w; ++i) {
    double known = 0;
    for (int k = 0; k < w; ++k) known += P[i * w + k] * set.y[at(first + k)];
    set.p[at(first + i)] = f[i] - known;
  }
  double A[widest * widest], change[widest * widest];
  const double* dfdd = batch.dfdd() + first * w;
  const double* dfdv = batch.dfdv() + first * w;
  const double* G = &set.compliance[at(first * w)];
  double* B = &set.answer[at(first * w)];
  bool changes = false;
  for (int i = 0; i < w * w; ++i) {
    change[i] = dfdd[i] + c * dfdv[i] - P[i];
    changes = changes || change[i] != 0;
  }
  if (!changes) return setIdentity(w, B);
  for (int i = 0; i < w; ++i)
    for (int j = 0; j < w; ++j) {
      double sum = i == j ? 1.0 : 0.0;
      for (int k = 0; k < w; ++k) sum -= change[i * w + k] * G[k * w + j];
      A[i * w + j] = sum;
    }
  if (!invertFew(w, A, B)) setIdentity(w, B);
}

void ContactForceIteration::solve(const linalg::BlockFactor& factor, const Vector* force,
                                  Vector& delta) {
  if (force != nullptr)
    delta = *force - *residual_;
  else
    delta = -*residual_;
  for (std::size_t b = 0; b < sets_.size(); ++b) {
    const PointBatch& batch = model_->points()[b];
    batch.scatter(batch.active(), sets_[b].p.data(), delta.data());
  }
  factor.solve(delta.data());
  isNear_ = false;
}

/// delta += S^-1 R' (change of p)
void ContactForceIteration::solveNear(const linalg::BlockFactor& factor, double small,
                                      Vector& delta) {
  live_.clear();
  for (std::size_t b = 0; b < sets_.size(); ++b) {
    const PointBatch& batch = model_->points()[b];
    batch.scatter(sets_[b].points, sets_[b].change.data(), near_.data());
    for (int p : sets_[b].points) batch.appendBlocks(p, live_);
  }
  factor.solveNear(near_.data(), live_, weight_.data(), Tuned::dropped * small);
  const auto& pattern = model_->pattern();
  double reached = 0;
  for (int b : live_) {
    for (int i = pattern.start(b); i < pattern.start(b + 1); ++i)
      delta[i] += near_[i], near_[i] = 0;
    reached += model_->cut().owns(pattern.start(b)) ? 1 : 0;
  }
  nearShare_ = model_->cut().sum(reached) / model_->wholeBlocks();
  isNear_ = true;
}

/// y = free + G p is what the point does for a force p while the others keep theirs.
void ContactForceIteration::solvePoint(Set& set, PointBatch& batch, int point, double t, double c) {
  using Rows =
      Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;
  const int w = batch.width();
  const int first = point * w;
  const auto local = [&](const std::vector<double>& rows) {
    return Eigen::Map<const Vector>(&rows[at(first)], w);
  };
  problem_.point = point;
  problem_.d = local(set.d);
  problem_.v = PointSolve::Local::Zero(w);
  problem_.f0 = PointSolve::Local::Zero(w);
  problem_.P = Rows(batch.frozen() + first * w, w, w);
  problem_.G = Rows(&set.compliance[at(first * w)], w, w);
  y_ = local(set.y);
  phi_ = local(set.p);
  problem_.free = y_;
  problem_.free.noalias() -= problem_.G.lazyProduct(phi_);
  if (!problem_.solve(batch, t, c, y_, phi_)) return;
  for (int i = 0; i < w; ++i) set.p[at(first + i)] = phi_[i], set.target[at(first + i)] = y_[i];
}

/// Not a number counts as wrong.
bool ContactForceIteration::isWrong(const Set& set, int point, double small) const {
  return !(set.error[at(point)] <= Tuned::rightEnough * small);
}

bool ContactForceIteration::isFew(long here) const {
  const long points = std::lround(model_->cut().sum(static_cast<double>(here)));
  return Tuned::positionsPerPoint * points < model_->wholeSize();
}

/// p += B defect, or to where the point is alone in equilibrium.
void ContactForceIteration::move(Set& set, PointBatch& batch, int point, double t, double c) {
  const int w = batch.width(), first = point * w;
  for (int r = first; r < first + w; ++r) set.change[at(r)] = -set.p[at(r)];
  if (set.exact[at(point)]) {
    solvePoint(set, batch, point, t, c);
  } else {
    const double* B = &set.answer[at(first * w)];
    const double* defect = &set.defect[at(first)];
    withWidth(w, [&](auto width) {
      const int n = width;
      for (int i = 0; i < n; ++i)
        for (int k = 0; k < n; ++k) set.p[at(first + i)] += B[i * n + k] * defect[k];
    });
  }
  for (int r = first; r < first + w; ++r) set.change[at(r)] += set.p[at(r)];
}

bool ContactForceIteration::correct(double t, double c, double small, bool all) {
  long wrong = 0;
  for (const Set& set : sets_)  // what was not evaluated is not wrong
    for (int p : set.points) wrong += isWrong(set, p, small) ? 1 : 0;
  const bool few = !all && strategies_->has(Strategy::NearSolves) && isFew(wrong);
  allMoved_ = true;
  for (std::size_t b = 0; b < sets_.size(); ++b) {
    Set& set = sets_[b];
    PointBatch& batch = model_->points()[b];
    if (few) {
      const auto isRight = [&](int p) {
        return (set.moved[at(p)] = isWrong(set, p, small) ? 1 : 0) == 0;
      };
      set.points.erase(std::remove_if(set.points.begin(), set.points.end(), isRight),
                       set.points.end());
    } else {
      set.points = batch.active();
      for (int p : set.points) set.moved[at(p)] = 1;
    }
    for (int p : set.points) move(set, batch, p, t, c);
  }
  return few;
}

bool ContactForceIteration::sweepEveryFourth(double t, double c, double small, int colour) {
  long moved = 0, looked = 0;
  for (const auto& batch : model_->points()) looked += static_cast<long>(batch.active().size());
  long place = std::lround(model_->cut().before(static_cast<double>(looked)));
  allMoved_ = false;
  for (std::size_t b = 0; b < sets_.size(); ++b) {
    Set& set = sets_[b];
    set.points.clear();
    for (int p : model_->points()[b].active()) {
      set.moved[at(p)] = place++ % Tuned::colours == colour && isWrong(set, p, small) ? 1 : 0;
      if (!set.moved[at(p)]) continue;
      set.exact[at(p)] = strategies_->has(Strategy::PointsAlone) ? 1 : 0;
      set.points.push_back(p);
      move(set, model_->points()[b], p, t, c);
      ++moved;
    }
  }
  return strategies_->has(Strategy::NearSolves) && isFew(moved);
}

}  // namespace tooljoint::transient
