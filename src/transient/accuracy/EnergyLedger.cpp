// SPDX-License-Identifier: BSD-3-Clause
#include "transient/accuracy/EnergyLedger.hpp"

#include <algorithm>
#include <cmath>

#include "transient/Integrator.hpp"

namespace tooljoint::transient {

double EnergyAccount::numerical() const {
  double dissipated = friction + contactDamping + circulatory;
  for (double each : damping) dissipated += each;
  return initial + loads + drive - dissipated - (kinetic + strain + contact);
}

double EnergyAccount::residual() const {
  const double scale = std::max(
      {exchanged, std::abs(initial), std::abs(kinetic) + std::abs(strain) + std::abs(contact)});
  return scale > 0 ? numerical() / scale : 0.0;
}

void EnergyLedger::allocate(CompiledModel& model) {
  const int n = model.size();
  for (Vector* x : {&q_, &v_, &step_, &change_, &product_, &internal_, &load_}) x->setZero(n);
  dissipative_.clear();
  account_.dampingNames.clear();
  for (std::size_t i = 0; i < model.timed().damping().terms().size(); ++i) {
    if (model.timed().damping().terms()[i].skew) continue;
    dissipative_.push_back(i);
    account_.dampingNames.push_back(model.timed().damping().terms()[i].name);
  }
  account_.damping.resize(dissipative_.size(), 0.0);
  sums_.assign(fewestSums + dissipative_.size(), 0.0);
  conservative_ = !model.cut().any(!model.timed().stiffness().isConservative());
}

template <class Power>
EnergyLedger::Powers EnergyLedger::sumPowers(CompiledModel& model, const Power& power, Powers sum) {
  for (auto& batch : model.points()) {
    const auto each = power(batch);
    sum.stored += each.stored;
    sum.damping += each.damping;
    sum.friction += each.friction;
    sum.drive += each.drive;
  }
  double sums[4] = {sum.stored, sum.damping, sum.friction, sum.drive};
  model.cut().reduce(nullptr, 0, sums, 4);
  return {sums[0], sums[1], sums[2], sums[3]};
}

void EnergyLedger::start(CompiledModel& model, const State& state, int stride) {
  account_ = {};
  stride_ = stride;
  skipped_ = unwatched_ = 0;
  allocate(model);
  model.setTime(state.t);
  model.addStiffness(state.q.data(), internal_.data());
  load_ = Eigen::Map<const Vector>(model.timed().load(), model.size());
  q_ = state.q;
  v_ = state.v;
  x_ = middle_ = rate_ = state.x;
  time_ = reached_ = state.t;
  longest_ = 0;
  strain_ = 0.5 * model.dot(state.q, internal_);
  model.states().bind(state.x.data());
  const auto everyPoint = [&](auto& batch) {
    return batch.power(state.t, state.q.data(), state.v.data(), batch.everyPoint());
  };
  stored_ = sumPowers(model, everyPoint, {}).stored;
  sliding_.start(model, state);
  EnergyAccount now = account(model, state);
  now.contact = stored_;
  account_.initial = now.kinetic + now.strain + now.contact;
  account_.supplied = std::abs(now.kinetic) + std::abs(now.strain) + std::abs(now.contact);
}

void EnergyLedger::book(CompiledModel& model, const State& to) {
  constexpr double equal = 0.75;
  ++unwatched_;
  sliding_.step(model, to);
  const double h = to.t - reached_;
  reached_ = to.t;
  longest_ = std::max(longest_, h);
  if (++skipped_ < stride_ && h > equal * longest_) return;
  enter(model, to);
}

/// Stiffness: q'K q / 2 now, and its work since the last entry, (K_n q_n + K_{n+1} q_{n+1}) / 2 .
/// dq. For a constant symmetric K this work is the change of q'K q / 2; any difference is
/// circulatory work. Damping: dq' C_i dq for each term. Results go to sums_, after `loads`.
void EnergyLedger::formWorks(const CompiledModel& model, const State& to, double loads) {
  const auto& terms = model.timed().damping().terms();
  double strain = 0, work = 0;
  std::fill(sums_.begin(), sums_.end(), 0.0);
  double* dissipated = sums_.data() + fewestSums;
  for (const auto& run : model.runs()) {
    const int begin = model.pattern().start(run.begin),
              length = model.pattern().start(run.end) - begin;
    if (conservative_) {
      strain += 0.5 * model.timed().stiffness().form(to.q.data(), run);
    } else {
      const auto step = step_.segment(begin, length);
      auto product = product_.segment(begin, length);
      product.setZero();
      model.addStiffness(to.q.data(), product_.data(), run);
      strain += 0.5 * to.q.segment(begin, length).dot(product);
      work += 0.5 * (internal_.segment(begin, length).dot(step) + product.dot(step));
      internal_.segment(begin, length) = product;
    }
    for (std::size_t i = 0; i < dissipative_.size(); ++i) {
      const auto& term = terms[dissipative_[i]];
      if (model.timed().damping().factor(dissipative_[i]) != 0.0)
        dissipated[i] += term.product.form(term.values.data(), step_.data(), run);
    }
  }
  sums_[0] = loads, sums_[1] = strain, sums_[2] = work;
  model.cut().reduce(nullptr, 0, sums_.data(), static_cast<int>(sums_.size()));
}

/// (F_n + F_{n+1}) / 2 . dq
double EnergyLedger::workOfLoads(CompiledModel& model, double begin, const State& to, bool jumps) {
  const double h = to.t - begin;
  const double* load = model.timed().load();
  double loads = 0;
  for (int i = 0; i < step_.size(); ++i) {
    step_[i] = to.q[i] - q_[i];
    q_[i] = to.q[i];
    loads += 0.5 * (load_[i] + load[i]) * step_[i];
    load_[i] = load[i];
  }
  if (jumps) {
    // velocity varies linearly within the step, up to the one at its end
    model.timed().setMoment(begin, to.t);
    for (int i = 0; i < step_.size(); ++i) loads += 2 * load[i] * (h * to.v[i] - step_[i]);
    model.setTime(to.t);
    load_ = Eigen::Map<const Vector>(model.timed().load(), model.size());
  }
  return loads;
}

void EnergyLedger::enter(CompiledModel& model, const State& to) {
  skipped_ = 0;
  const double h = to.t - time_;
  const double begin = time_;
  const bool jumps = model.timed().setMean(begin, to.t);
  const double given = account_.loads, driven = account_.drive, turned = account_.circulatory;
  double fed = 0;  // by negative damping
  time_ = to.t;
  double exchanged = 0;
  const auto entry = [&exchanged](double& account, double work) {
    account += work;
    exchanged += std::abs(work);
  };
  formWorks(model, to, workOfLoads(model, begin, to, jumps));
  entry(account_.loads, sums_[0]);
  const double strain = sums_[1], work = conservative_ ? strain - strain_ : sums_[2];
  entry(account_.circulatory, work - (strain - strain_));
  exchanged += std::abs(strain - strain_);
  strain_ = strain;
  for (std::size_t i = 0; i < dissipative_.size(); ++i) {
    const double taken =
        model.timed().damping().factor(dissipative_[i]) * sums_[fewestSums + i] / h;
    entry(account_.damping[i], taken);
    fed += std::max(0.0, -taken);
  }
  // point laws: mean power of the step times h; friction: FrictionWork
  if (!model.points().empty()) {
    if (model.states().size() > 0) bindChord(model, to, h);
    change_ = to.v - v_;
    v_ = to.v;
    const auto power = [&](auto& batch) {
      auto each = batch.meanPower(to.t, h, to.q.data(), to.v.data(), step_.data(), change_.data(),
                                  batch.selected().acted());
      if (sliding_.has(static_cast<std::size_t>(&batch - model.points().data())))
        each.friction = each.drive = 0;
      return each;
    };
    const Powers mean =
        sumPowers(model, power, {0, 0, sliding_.friction() / h, sliding_.drive() / h});
    sliding_.forget();
    entry(account_.friction, h * mean.friction);
    entry(account_.contactDamping, h * mean.damping);
    entry(account_.drive, h * mean.drive);
    for (auto& batch : model.points()) batch.selected().book();
    exchanged += std::abs(mean.stored - stored_);
    stored_ = mean.stored;
  }
  account_.exchanged += exchanged;
  account_.supplied += std::abs(account_.loads - given) + std::abs(account_.drive - driven) +
                       std::abs(account_.circulatory - turned) + fed;
}

/// Binds the states in the middle of the chord, and their rates along it.
void EnergyLedger::bindChord(CompiledModel& model, const State& to, double h) {
  model.states().blend(x_, to.x, 0.5, to.x, middle_);
  rate_ = (to.x - x_) / h;
  x_ = to.x;
  model.states().bind(middle_.data(), 0.0, rate_.data());
}

/// Inactive points store no energy.
double EnergyLedger::storedNow(CompiledModel& model, const State& state) {
  model.states().bind(state.x.data());
  const auto active = [&](auto& batch) {
    return batch.power(state.t, state.q.data(), state.v.data(), batch.active());
  };
  return sumPowers(model, active, {}).stored;
}

const EnergyAccount& EnergyLedger::look(CompiledModel& model, const State& state) {
  unwatched_ = 0;
  if (skipped_ > 0) enter(model, state);
  account_.kinetic = 0.5 * model.massForm(state.v.data());
  account_.strain = strain_;
  account_.contact = storedNow(model, state);
  return account_;
}

EnergyAccount EnergyLedger::account(CompiledModel& model, const State& state) {
  if (skipped_ > 0) enter(model, state);
  EnergyAccount result = account_;
  result.kinetic = 0.5 * model.massForm(state.v.data());
  result.strain = strain_;
  result.contact = storedNow(model, state);
  return result;
}

void EnergyLedger::save(std::vector<double>& memory) const {
  memory.insert(
      memory.end(),
      {static_cast<double>(skipped_), static_cast<double>(unwatched_), time_, reached_, longest_,
       strain_, stored_, account_.initial, account_.loads, account_.drive, account_.friction,
       account_.contactDamping, account_.circulatory, account_.exchanged, account_.supplied});
  memory.insert(memory.end(), account_.damping.begin(), account_.damping.end());
  for (const Vector* x : {&q_, &v_, &internal_, &load_, &x_})
    memory.insert(memory.end(), x->begin(), x->end());
  sliding_.save(memory);
}

void EnergyLedger::restore(CompiledModel& model, int stride, const double*& memory) {
  account_ = {};
  stride_ = stride;
  allocate(model);
  skipped_ = static_cast<int>(*memory++);
  unwatched_ = static_cast<int>(*memory++);
  for (double* x : {&time_, &reached_, &longest_, &strain_, &stored_, &account_.initial,
                    &account_.loads, &account_.drive, &account_.friction, &account_.contactDamping,
                    &account_.circulatory, &account_.exchanged, &account_.supplied})
    *x = *memory++;
  for (double& x : account_.damping) x = *memory++;
  x_.setZero(model.states().size());
  middle_ = rate_ = x_;
  for (Vector* vector : {&q_, &v_, &internal_, &load_, &x_})
    for (double& x : *vector) x = *memory++;
  sliding_.restore(model, memory);
}

}  // namespace tooljoint::transient
