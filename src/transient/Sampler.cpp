// SPDX-License-Identifier: BSD-3-Clause
#include "transient/Sampler.hpp"

namespace tooljoint::transient {

Sampler::Sampler(const CompiledModel& model, const TransientOptions& options, SampleSink& sink,
                 long done, const RankShare* share)
    : model_(model),
      share_(share),
      begin_(options.start),
      end_(options.end),
      interval_(options.sampling),
      sink_(sink),
      count_(done) {
  if (share != nullptr) gathering_ = dynamic_cast<ShareSink*>(&sink);
  if (gathering_ != nullptr && !gathering_->gathers()) gathering_ = nullptr;
  middle_.resize(model.size(), model.states().size());
  if (gathering_ != nullptr) return;
  for (Vector* x : {&q_, &v_, &a_}) x->setZero(model.wholeSize());
}

void Sampler::step(const State& from, const State& to) {
  const double h = to.t - from.t;
  for (;;) {
    const double t = begin_ + static_cast<double>(count_) * interval_;
    if (t > to.t + 1e-9 * h || t > end_ + 1e-9 * interval_) return;
    if (t > to.t - 1e-9 * h)
      give(t, to);
    else
      give(t, between(from, to, (t - from.t) / h));
  }
}

/// Cubic Hermite interpolation: q from (q, v), v from (v, a), rated states from (x, x'); a is the
/// derivative of v. x in (0, 1) is the position in the step.
const State& Sampler::between(const State& from, const State& to, double x) {
  const double h = to.t - from.t;
  const double h00 = (1 + 2 * x) * (1 - x) * (1 - x), h10 = x * (1 - x) * (1 - x) * h;
  const double h01 = x * x * (3 - 2 * x), h11 = x * x * (x - 1) * h;
  middle_.q = h00 * from.q + h10 * from.v + h01 * to.q + h11 * to.v;
  middle_.v = h00 * from.v + h10 * from.a + h01 * to.v + h11 * to.a;
  middle_.a = 6 * x * (1 - x) / h * (to.v - from.v) + (1 - x) * (1 - 3 * x) * from.a +
              x * (3 * x - 2) * to.a;
  x_ = h00 * from.x + h10 * from.xDot + h01 * to.x + h11 * to.xDot;
  model_.states().blend(x_, x_, 0.0, from.x, middle_.x);
  return middle_;
}

void Sampler::give(double t, const State& state) {
  ++count_;
  x_ = state.x;
  model_.states().join(x_);
  if (gathering_ != nullptr)
    return guard([&] { gathering_->sampleShare({t, *share_, state.q, state.v, state.a, x_}); });
  model_.toDofs(state.q, q_);
  model_.toDofs(state.v, v_);
  model_.toDofs(state.a, a_);
  if (share_ == nullptr) return pass(t);
  if (!failure_) guard([&] { pass(t); });
}

/// Keeps the first exception.
template <class Work>
void Sampler::guard(const Work& work) {
  try {
    work();
  } catch (...) {
    if (!failure_) failure_ = std::current_exception();
  }
}

void Sampler::pass(double t) {
  if (model_.states().size() > 0) sink_.states(x_);
  sink_.sample(t, q_, v_, a_);
}

}  // namespace tooljoint::transient
