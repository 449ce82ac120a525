// SPDX-License-Identifier: BSD-3-Clause
#include "transient/verdict/DampingSamples.hpp"

#include <algorithm>
#include <cmath>

#include "transient/Integrator.hpp"
#include "transient/verdict/SpreadSteps.hpp"

namespace tooljoint::transient {
namespace {

/// The damping of the scheme is measured in this many first steps, where transients of the start
/// decay, and then once every `stride` steps, because a measurement costs some products with M.
constexpr long firstSteps = 64, stride = 11;

}  // namespace

long DampingSamples::next() const {
  return taken_ < firstSteps ? taken_
                             : firstSteps + spreadStep(stride, static_cast<double>(looks_),
                                                       static_cast<double>(looks_));
}

void DampingSamples::look(const MotionNorm& norm, const State& from, const State& to) {
  if (scheme_ == nullptr) return;
  const bool first = taken_ < firstSteps, due = taken_ >= next();
  ++taken_;
  if (!due) return;
  if (!first) ++looks_;
  const double weight = first ? 1.0 : static_cast<double>(stride);
  difference_ = to.q - from.q;
  vibrated_ += weight * norm.translations(difference_) / (to.t - from.t);
  lost_ += weight * scheme_->dissipated(from, to);
  if (scheme_->hasUnresolvedContact()) rested_ += weight;
}

double DampingSamples::damped(const MotionNorm& norm, double span) const {
  const double energy = 0.5 * norm.inertia() * vibrated_;  // integral over the measured time
  if (!(energy > 0)) return 0.0;
  return 1 - std::exp(-std::max(0.0, 0.25 * span * lost_ / energy));
}

bool DampingSamples::hasUnresolvedContact() const {
  return rested_ > oftenUnresolved * static_cast<double>(taken_);
}

void DampingSamples::save(std::vector<double>& memory) const {
  memory.insert(memory.end(), {lost_, vibrated_, rested_, static_cast<double>(taken_),
                               static_cast<double>(looks_)});
}

void DampingSamples::restore(const double*& memory) {
  for (double* sum : {&lost_, &vibrated_, &rested_}) *sum = *memory++;
  for (long* steps : {&taken_, &looks_}) *steps = static_cast<long>(*memory++);
}

}  // namespace tooljoint::transient
