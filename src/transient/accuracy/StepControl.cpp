// SPDX-License-Identifier: BSD-3-Clause
#include "transient/accuracy/StepControl.hpp"

#include <algorithm>
#include <cmath>

#include "coupling/input/ComponentAxes.hpp"

namespace tooljoint::transient {
namespace {

/// Target error of a changed step, as part of the tolerance.
constexpr double aim = 0.5;
/// Local errors of second-order schemes decrease by this factor when the step is halved.
constexpr double perHalving = 0.125;
/// Calm steps before a longer one is tried: first value and largest value. A change costs about
/// three steps.
constexpr int shortestPatience = 4;
constexpr int longestPatience = 256;
/// A lengthened step counts as a success only if it lasts this many times the patience.
constexpr int proof = 4;
/// Doublings at once; few, so that the wait for a multiple of the longer step stays short.
constexpr int longestJump = 2;

}  // namespace

void MassNorm::bind(const CompiledModel& model) {
  model_ = &model;
  const auto& source = model.source();
  const auto components = static_cast<Eigen::Index>(source.componentNames.size());
  std::vector<char> moves;
  for (const auto& name : source.componentNames)
    moves.push_back(coupling::kindOf(name) == coupling::ComponentKind::Translation ? 1 : 0);
  double moved = 0;
  for (Eigen::Index row = 0; row < source.recovery.rows(); ++row) {
    if (!moves[static_cast<std::size_t>(row % components)]) continue;
    for (model::SharedSparse::InnerIterator it(source.recovery, row); it; ++it)
      moved += it.value() * it.value();
  }
  double mass = source.mass.diagonal().sum();
  double sums[2] = {moved, mass};
  model.cut().reduce(nullptr, 0, sums, 2);
  moved = sums[0], mass = sums[1];
  if (components > 0 && source.recovery.rows() > 0) {
    const auto nodes = source.recovery.rows() / components;
    moved /= static_cast<double>(nodes);
  }
  mass_ = moved > 0 ? mass / moved : mass;
}

double MassNorm::operator()(const Vector& e) const {
  return std::sqrt(std::max(0.0, model_->massForm(e.data()) / mass_));
}

void StepControl::set(double tolerance, int deepest, int finest) {
  tolerance_ = tolerance;
  deepest_ = deepest;
  finest_ = finest;
  patience_ = shortestPatience;
  tried_ = false;
  since_ = 0;
  forget();
}

int StepControl::shorter(double error, int level) {
  if (tried_) patience_ = std::min(2 * patience_, longestPatience);
  tried_ = false;
  forget();
  // error * perHalving^k <= aim * tolerance
  const double halvings = std::log(error / (aim * tolerance_)) / -std::log(perHalving);
  if (!(halvings < deepest_)) return level < deepest_ ? deepest_ : deepest_ + 1;
  const int wanted = level + std::max(1, static_cast<int>(std::ceil(halvings)));
  return level < deepest_ ? std::min(wanted, deepest_) : deepest_ + 1;
}

int StepControl::next(double error, int level, long done) {
  largest_ = std::max(largest_, error);
  ++calm_;
  if (tried_ && ++since_ >= proof * patience_) {
    tried_ = false;
    patience_ = std::max(shortestPatience, patience_ / 2);
  }
  if (level == 0 || calm_ < patience_) return level;
  int jump = 0;
  double expected = largest_;
  while (jump < std::min(level, longestJump) && expected <= aim * perHalving * tolerance_)
    ++jump, expected /= perHalving;
  if (jump == 0) {
    forget();
    return level;
  }
  const int target = level - jump;
  return done % (1L << (finest_ - target)) == 0 ? target : level;
}

void StepControl::lengthened() {
  tried_ = true;
  since_ = 0;
  forget();
}

void StepControl::save(std::vector<double>& memory) const {
  memory.insert(memory.end(), {static_cast<double>(patience_), static_cast<double>(calm_), largest_,
                               tried_ ? 1.0 : 0.0, static_cast<double>(since_)});
}

void StepControl::restore(const double*& memory) {
  patience_ = static_cast<int>(*memory++);
  calm_ = static_cast<int>(*memory++);
  largest_ = *memory++;
  tried_ = *memory++ != 0.0;
  since_ = static_cast<int>(*memory++);
}

}  // namespace tooljoint::transient
