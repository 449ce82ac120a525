// SPDX-License-Identifier: BSD-3-Clause
#include "transient/compiled/CompiledModel.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "common/Index.hpp"
#include "model/DofNames.hpp"
#include "transient/Integrator.hpp"
#include "transient/Tuned.hpp"
#include "transient/accuracy/LawResolution.hpp"
#include "transient/compiled/ModelPattern.hpp"

namespace tooljoint::transient {
namespace {

/// Ten vectors of this length (160 kB) fit into a second-level cache, and matrices are still read
/// in long runs.
constexpr int positionsPerRun = 2048;

bool isSkew(const Sparse& matrix) {
  const Sparse transposed = matrix.transpose();
  const Sparse sum = matrix + transposed;
  double largest = 0;
  for (int k = 0; k < matrix.outerSize(); ++k)
    for (Sparse::InnerIterator it(matrix, k); it; ++it)
      largest = std::max(largest, std::abs(it.value()));
  for (int k = 0; k < sum.outerSize(); ++k)
    for (Sparse::InnerIterator it(sum, k); it; ++it)
      if (std::abs(it.value()) > Tuned::rounding * largest) return false;
  return true;
}

/// act(batch, states, offset) for every batch with states and with points on this rank.
template <class Batches, class Act>
void forStates(Batches& batches, const Act& act) {
  int offset = 0;
  for (auto& batch : batches)
    if (PointStates* states = batch.states()) {
      if (!batch.everyPoint().empty()) act(batch, *states, offset);
      offset += states->size();
    }
}

}  // namespace

MatrixSum::MatrixSum(const std::vector<model::MatrixTerm>& terms,
                     const std::vector<model::ScalarLaw>& laws, const linalg::BlockPattern& pattern,
                     const linalg::BlockProduct& like) {
  std::map<std::string, std::size_t> byLaw;  // laws of the same name are the same law
  std::vector<Sparse> matrices;
  for (const auto& term : terms) {
    const auto& law = laws[at(term.law)].name;
    const auto [it, fresh] = byLaw.emplace(law, terms_.size());
    if (fresh) {
      terms_.push_back({term.name, term.law, {}, {}, false});
      matrices.push_back(term.matrix);
    } else {
      terms_[it->second].name += " + " + term.name;
      matrices[it->second] += term.matrix;
    }
  }
  std::vector<const linalg::BlockValues*> samples;
  for (std::size_t i = 0; i < terms_.size(); ++i) {
    terms_[i].values.assign(pattern.storage(), 0.0);
    pattern.add(matrices[i], 1.0, terms_[i].values);
    terms_[i].product = linalg::BlockProduct(pattern, {&terms_[i].values}, &like);
    terms_[i].skew = !pattern.cut().any(!isSkew(matrices[i]));
  }
  for (const auto& term : terms_) samples.push_back(&term.values);
  product_ = linalg::BlockProduct(pattern, samples, &like);
  constant_ = terms_.size() == 1 && laws[at(terms_[0].law)].isOne();
  if (!constant_ && !terms_.empty()) sum_.assign(pattern.storage(), 0.0);
  last_.assign(terms_.size(), std::numeric_limits<double>::quiet_NaN());
}

bool MatrixSum::update(const std::vector<double>& lawValues) {
  if (terms_.empty()) return false;
  bool changed = false;
  for (std::size_t i = 0; i < terms_.size(); ++i) {
    const double value = lawValues[at(terms_[i].law)];
    if (!(value == last_[i])) changed = true;
    last_[i] = value;
  }
  if (changed)
    formed_ = false;
  else if (!constant_ && !formed_)
    form();
  return changed;
}

void MatrixSum::comeBack(const Snapshot& snapshot) {
  const bool still = formed_ && last_ == snapshot.last;
  last_ = snapshot.last;
  formed_ = snapshot.formed;
  if (formed_ && !still) form();
}

void MatrixSum::setFormed(bool formed) {
  if (formed && !formed_ && !constant_ && !terms_.empty()) form();
  formed_ = formed;
}

/// A = sum_i c_i A_i: the first term is assigned, terms with zero law are skipped.
void MatrixSum::form() const {
  const std::size_t n = sum_.size();
  double* sum = sum_.data();
  bool assigned = false;
  for (std::size_t i = 0; i < terms_.size(); ++i) {
    const double c = last_[i];
    const double* values = terms_[i].values.data();
    if (c == 0.0) continue;
    if (!assigned)
      for (std::size_t k = 0; k < n; ++k) sum[k] = c * values[k];
    else
      for (std::size_t k = 0; k < n; ++k) sum[k] += c * values[k];
    assigned = true;
  }
  if (!assigned) std::fill(sum_.begin(), sum_.end(), 0.0);
  formed_ = true;
}

void MatrixSum::addTo(const double* x, double* y, linalg::BlockRange rows) const {
  if (terms_.empty()) return;
  if (constant_ || formed_) {
    product_.addTo(current(), x, y, 1.0, rows);
    return;
  }
  for (std::size_t i = 0; i < terms_.size(); ++i)
    if (last_[i] != 0.0) terms_[i].product.addTo(terms_[i].values.data(), x, y, last_[i], rows);
}

void MatrixSum::addChangeSince(const std::vector<double>& then, double factor, const double* x,
                               double* y) const {
  for (std::size_t i = 0; i < terms_.size(); ++i) {
    const double difference = factor * (last_[i] - then[at(terms_[i].law)]);
    if (difference != 0.0) terms_[i].product.addTo(terms_[i].values.data(), x, y, difference);
  }
}

void MatrixSum::combine(double factor, double* values, std::size_t storage) const {
  if (terms_.empty()) return;
  const double* mine = current();
  for (std::size_t k = 0; k < storage; ++k) values[k] += factor * mine[k];
}

CompiledModel::CompiledModel(const model::SecondOrderModel& model)
    : CompiledModel(model, nullptr) {}

CompiledModel::CompiledModel(const RankShare& share) : CompiledModel(share.model(), &share) {}

CompiledModel::CompiledModel(const model::SecondOrderModel& model, const RankShare* share)
    : model_(model), share_(share) {
  model.validate();
  const int n = model.size();
  pattern_ = share != nullptr ? share->pattern() : modelPattern(model);
  wholeSize_ = share != nullptr ? share->wholeSize() : n;
  runs_ = linalg::blockRuns(pattern_, positionsPerRun);

  mass_.assign(pattern_.storage(), 0.0);
  pattern_.add(model.mass, 1.0, mass_);
  massProduct_ = linalg::BlockProduct(pattern_, {&mass_});
  damping_ = MatrixSum(model.damping, model.laws, pattern_, massProduct_);
  stiffness_ = MatrixSum(model.stiffness, model.laws, pattern_, massProduct_);
  diagonalAddress_.resize(at(n));
  for (int p = 0; p < n; ++p) diagonalAddress_[at(p)] = pattern_.address(p, p);

  std::map<std::string, std::size_t> byLaw;
  for (const auto& term : model.loads) {
    const Vector vector = inOrder(term.vector);
    const auto [it, fresh] = byLaw.emplace(model.laws[at(term.law)].name, loads_.size());
    if (fresh)
      loads_.push_back({term.law, vector});
    else
      loads_[it->second].vector += vector;
  }
  loadLaws_.resize(loads_.size());
  lastLoadLaws_.assign(loads_.size(), std::numeric_limits<double>::quiet_NaN());
  load_ = Vector::Zero(n);
  lawValues_.assign(model.laws.size(), 0.0);
  points_ = makePoints();
  for (auto& batch : points_)
    if (const auto* states = batch.states()) stateSize_ += states->size();
}

std::vector<PointBatch> CompiledModel::makePoints() const {
  std::vector<PointBatch> batches;
  for (std::size_t s = 0; s < model_.points.size(); ++s)
    batches.emplace_back(model_.points[s], pattern_,
                         share_ != nullptr ? &share_->points()[s] : nullptr);
  return batches;
}

bool CompiledModel::addMissed(const double* q, double t) {
  bool missed = false;
  for (auto& batch : points_) missed = batch.addMissed(q, t) || missed;
  return cut().any(missed);
}

bool CompiledModel::meetsOrLeavesWall(const double* q) {
  bool any = false;
  for (auto& batch : points_) any = batch.meetsOrLeavesWall(q) || any;
  return cut().any(any);
}

void CompiledModel::toPositions(const Vector& dofs, Vector& positions) const {
  positions = share_ != nullptr ? share_->pick(dofs) : inOrder(dofs);
}

/// Own dofs, sorted by position.
Vector CompiledModel::inOrder(const Vector& dofs) const {
  Vector positions(size());
  for (int p = 0; p < size(); ++p) positions[p] = dofs[pattern_.partition().dof[at(p)]];
  return positions;
}

void CompiledModel::toDofs(const Vector& positions, Vector& dofs) const {
  if (share_ != nullptr) return share_->gather(positions, dofs);
  dofs.resize(positions.size());
  for (int p = 0; p < size(); ++p) dofs[pattern_.partition().dof[at(p)]] = positions[p];
}

std::string CompiledModel::dofName(int position) const {
  return model::dofName(model_, pattern_.partition().dof[at(position)]);
}

std::string CompiledModel::worstName(const Vector& x) const {
  const int worst = worstPosition(x);
  return pattern_.cut().ofLargest(std::abs(x[worst]), dofName(worst));
}

std::string CompiledModel::pivotName(int position) const {
  const bool mine = position >= 0 && position < size();
  return pattern_.cut().ofLargest(mine ? 1.0 : 0.0, mine ? dofName(position) : "");
}

double CompiledModel::dot(const Vector& x, const Vector& partial) const {
  return pattern_.cut().sum(x.dot(partial));
}

double CompiledModel::squaredNorm(const Vector& x) const {
  const int interior = cut().interior(size());
  double sum = x.head(interior).squaredNorm();
  for (int i = interior; i < size(); ++i) sum += cut().owns(i) ? x[i] * x[i] : 0.0;
  return cut().sum(sum);
}

double CompiledModel::largest(const Vector& x) const {
  return pattern_.cut().largest(x.cwiseAbs().maxCoeff());
}

double CompiledModel::nextCorner(double t, double end) const {
  const double after = t + Tuned::rounding * std::max(std::abs(t), std::abs(end));
  for (const auto& law : model_.laws) {
    const auto next = std::upper_bound(law.corners.begin(), law.corners.end(), after);
    if (next != law.corners.end()) end = std::min(end, *next);
  }
  return end;
}

void CompiledModel::setTime(double t) {
  if (timeSet_ && t == time_ && plainLoads_) return;
  time_ = t;
  plainLoads_ = true;
  timeSet_ = true;
  for (std::size_t i = 0; i < lawValues_.size(); ++i) lawValues_[i] = model_.laws[i].value(t);
  const bool c = damping_.update(lawValues_);
  const bool k = stiffness_.update(lawValues_);
  if (c || k) ++stamp_;
  for (std::size_t i = 0; i < loads_.size(); ++i) loadLaws_[i] = lawValues_[at(loads_[i].law)];
  sumLoads();
}

/// load_ = sum_i f_i F_i if an f_i has changed
void CompiledModel::sumLoads() {
  bool changed = false;
  for (std::size_t i = 0; i < loads_.size(); ++i) {
    if (!(loadLaws_[i] == lastLoadLaws_[i])) changed = true;
    lastLoadLaws_[i] = loadLaws_[i];
  }
  if (!changed) return;
  load_.setZero();
  for (std::size_t i = 0; i < loads_.size(); ++i)
    if (lastLoadLaws_[i] != 0.0) load_ += lastLoadLaws_[i] * loads_[i].vector;
}

/// Replaces laws of loads that have a corner by value(law).
template <class Value>
void CompiledModel::crossCorners(double begin, double end, const Value& value) {
  for (std::size_t i = 0; i < loads_.size(); ++i) {
    const auto& law = model_.laws[at(loads_[i].law)];
    if (!hasCorner(law, begin, end)) continue;
    loadLaws_[i] = value(law);
    plainLoads_ = false;
  }
  if (!plainLoads_) sumLoads();
}

/// The same for matrices.
template <class Value>
void CompiledModel::crossCornersOfMatrices(double begin, double end, const Value& value) {
  bool crossed = false;
  for (std::size_t i = 0; i < lawValues_.size(); ++i) {
    if (!hasCorner(model_.laws[i], begin, end)) continue;
    lawValues_[i] = value(model_.laws[i]);
    crossed = true;
  }
  if (!crossed) return;
  plainLoads_ = false;
  const bool c = damping_.update(lawValues_), k = stiffness_.update(lawValues_);
  if (c || k) ++stamp_;
}

void CompiledModel::setStepEnd(double begin, double end) {
  setTime(end);
  const double next = end + (end - begin);
  const auto around = [=](const model::ScalarLaw& law) {
    const auto ahead = momentsOf(law, end, next);
    return momentsOf(law, begin, end).first + ahead.mean - ahead.first;
  };
  crossCorners(begin, next, around);
  crossCornersOfMatrices(begin, next, around);
}

void CompiledModel::setStart(double t, double h) {
  setTime(t);
  crossCorners(t, t + h, [=](const model::ScalarLaw& law) {
    const auto ahead = momentsOf(law, t, t + h);
    return 2 * (ahead.mean - ahead.first);
  });
}

void CompiledModel::setStage(double t, double begin, double h) {
  setTime(t);
  const auto stage = [=](const model::ScalarLaw& law) {
    const auto [mean, moment] = momentsOf(law, begin, begin + h);
    const double first = law.value(begin), second = 3 * (mean - moment) - 0.5 * first;
    const double left = begin + h - t;
    return 2 * left > 0.5 * h ? second : 6 * mean - first - 4 * second;
  };
  crossCorners(begin, begin + h, stage);
  crossCornersOfMatrices(begin, begin + h, stage);
}

bool CompiledModel::setMean(double begin, double end) {
  setTime(end);
  crossCorners(begin, end, [=](const model::ScalarLaw& law) {
    return 2 * momentsOf(law, begin, end).mean - law.value(begin);
  });
  return !plainLoads_;
}

void CompiledModel::setMoment(double begin, double end) {
  std::fill(loadLaws_.begin(), loadLaws_.end(), 0.0);
  plainLoads_ = false;
  crossCorners(begin, end, [=](const model::ScalarLaw& law) {
    const auto [mean, moment] = momentsOf(law, begin, end);
    return moment - 0.5 * mean;
  });
}

void CompiledModel::remember(Snapshot& snapshot) const {
  snapshot.time = time_, snapshot.timeSet = timeSet_, snapshot.stamp = stamp_;
  snapshot.lawValues = lawValues_, snapshot.loadLaws = lastLoadLaws_, snapshot.load = load_;
  snapshot.plain = plainLoads_;
  damping_.remember(snapshot.damping);
  stiffness_.remember(snapshot.stiffness);
}

void CompiledModel::comeBack(const Snapshot& snapshot) {
  time_ = snapshot.time, timeSet_ = snapshot.timeSet, stamp_ = snapshot.stamp;
  lawValues_ = snapshot.lawValues, lastLoadLaws_ = snapshot.loadLaws, load_ = snapshot.load;
  plainLoads_ = snapshot.plain;
  damping_.comeBack(snapshot.damping);
  stiffness_.comeBack(snapshot.stiffness);
}

void CompiledModel::save(std::vector<double>& memory) const {
  memory.insert(memory.end(),
                {time_, damping_.isFormed() ? 1.0 : 0.0, stiffness_.isFormed() ? 1.0 : 0.0});
}

void CompiledModel::restore(const double*& memory) {
  setTime(*memory++);
  for (MatrixSum* sum : {&damping_, &stiffness_}) sum->setFormed(*memory++ != 0.0);
}

void CompiledModel::addChangeSince(const std::vector<double>& then, double c, const double* x,
                                   double* y) {
  damping_.addChangeSince(then, c, x, y);
  stiffness_.addChangeSince(then, 1.0, x, y);
}

void CompiledModel::combine(double m, double c, double k, double* values) const {
  const std::size_t n = pattern_.storage();
  for (std::size_t i = 0; i < n; ++i) values[i] = m * mass_[i];
  if (c != 0.0) damping_.combine(c, values, n);
  if (k != 0.0) stiffness_.combine(k, values, n);
}

void CompiledModel::diagonal(double m, double c, double k, double* out) const {
  for (std::size_t p = 0; p < diagonalAddress_.size(); ++p) {
    const std::size_t a = diagonalAddress_[p];
    out[p] = m * mass_[a] + c * damping_.entry(a) + k * stiffness_.entry(a);
  }
  pattern_.cut().complete(out);
}

void CompiledModel::initialStates(double t, const double* q, const double* v, double* x) {
  forStates(points_, [&](auto& batch, PointStates& states, int offset) {
    batch.gatherAll(q, v);
    states.initial(t, batch.d(), batch.v(), x + offset);
  });
  keepOwnStates(x);
}

void CompiledModel::bindStates(const double* base, double factor, const double* rate) {
  forStates(points_, [&](auto&, PointStates& states, int offset) {
    states.bind(base + offset, factor, rate != nullptr ? rate + offset : nullptr);
  });
}

void CompiledModel::bindKnownStates(const double* x, double factor) {
  forStates(points_,
            [&](auto&, PointStates& states, int offset) { states.bindKnown(x + offset, factor); });
}

void CompiledModel::stateRates(double* xDot) const {
  forStates(points_, [&](auto&, PointStates& states, int offset) { states.rates(xDot + offset); });
}

void CompiledModel::completeStates(double t, const double* q, const double* v, double* x,
                                   double* xDot) {
  forStates(points_, [&](auto& batch, PointStates& states, int offset) {
    batch.gatherAll(q, v);
    states.complete(t, batch.everyPoint(), batch.d(), batch.v(), x + offset, xDot + offset);
  });
  keepOwnStates(x);
}

void CompiledModel::acceptStates(double t, const double* q, const double* v, double* x) {
  forStates(points_, [&](auto& batch, PointStates& states, int offset) {
    batch.gatherAll(q, v);
    states.accept(t, batch.d(), batch.v(), x + offset);
  });
  keepOwnStates(x);
}

void CompiledModel::joinStates(Vector& x) const {
  if (cut().isDivided() && stateSize_ > 0) cut().sumAll(x.data(), at(stateSize_));
}

void CompiledModel::keepOwnStates(double* x) const {
  if (!cut().isDivided()) return;
  for (const auto& batch : points_) {
    const PointStates* states = batch.states();
    if (states == nullptr) continue;
    auto own = batch.everyPoint().begin();
    for (int p = 0; p < states->points(); ++p, x += states->states()) {
      const bool isOwn = own != batch.everyPoint().end() && *own == p;
      if (isOwn)
        ++own;
      else
        std::fill_n(x, states->states(), 0.0);
    }
  }
}

void CompiledModel::blendStates(const Vector& from, const Vector& to, double s, const Vector& held,
                                Vector& out) const {
  out = held;
  forStates(points_, [&](auto&, PointStates& states, int offset) {
    for (int i = 0; i < states.size(); ++i)
      if (states.isRated(i))
        out[offset + i] = from[offset + i] + s * (to[offset + i] - from[offset + i]);
  });
}

double CompiledModel::stateDistance(const Vector& a, const Vector& b) const {
  double square = 0;
  forStates(points_, [&](auto&, PointStates& states, int offset) {
    for (int i = 0; i < states.size(); ++i)
      if (states.isRated(i)) square += std::pow(a[offset + i] - b[offset + i], 2);
  });
  return std::sqrt(stateSize_ > 0 ? cut().sum(square) : 0.0);
}

void CompiledModel::addPointForces(double t, const double* q, const double* v, double* y) {
  for (auto& batch : points_) {
    batch.evaluate(t, q, v);
    batch.addForce(y);
  }
}

}  // namespace tooljoint::transient
