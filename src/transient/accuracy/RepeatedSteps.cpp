// SPDX-License-Identifier: BSD-3-Clause
#include "transient/accuracy/RepeatedSteps.hpp"

#include <cmath>
#include <utility>

namespace tooljoint::transient {
namespace {

/// Both halves by a second object of the integrator.
class IntegratorHalves final : public HalvedStep {
 public:
  IntegratorHalves(std::unique_ptr<Integrator> integrator, const Window& window)
      : integrator_(std::move(integrator)), window_(window) {}

  void prepare(CompiledModel& model, const State& state, double h) override {
    middle_ = state;
    window_.step = 0.5 * h;
    integrator_->prepare(model, window_, middle_);
  }
  bool take(const State& from, State& end) override {
    middle_.t = from.t + 0.5 * (end.t - from.t);
    return integrator_->repeat(from, middle_) && integrator_->repeat(middle_, end);
  }
  void save(std::vector<double>& memory) const override { integrator_->save(memory); }
  void restore(const double*& memory) override { integrator_->restore(memory); }

 private:
  std::unique_ptr<Integrator> integrator_;
  Window window_;
  State middle_;
};

}  // namespace

RepeatedSteps::RepeatedSteps(CompiledModel& model, std::unique_ptr<Integrator> second,
                             const Window& window, const State& state, double h)
    : difference_(state.q), h_(h) {
  size_.bind(model);
  doubling_.bind(model, std::make_unique<IntegratorHalves>(std::move(second), window), state, h,
                 std::lround((window.end - window.begin) / h));
}

void RepeatedSteps::look(long steps, const State& from, const State& to) {
  if (!doubling_.isDue(steps) || !doubling_.look(from, to)) return;
  difference_ = to.q - doubling_.end().q;
  const double error = size_(difference_);
  difference_ = to.q - from.q;
  local_.add(error, size_(difference_), size_(to.q));
}

void RepeatedSteps::save(std::vector<double>& memory) const {
  local_.save(memory);
  doubling_.save(memory);
}

void RepeatedSteps::restore(const double*& memory) {
  local_.restore(memory);
  doubling_.restore(memory);
}

}  // namespace tooljoint::transient
