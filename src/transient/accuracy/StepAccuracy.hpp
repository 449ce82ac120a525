// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Whether fixed steps follow the motion. Two measures: R, the local error of the scheme beside
/// what moves in a step, in mean squares over the run,
///
///     R^2 = sum |e|^2 / sum |q_{n+1} - q_n|^2
///
/// which knows nothing of contact and iterations (vibration of frequency w gives R of about (w h)^2
/// / 10), and D, by how much two steps of half the length end elsewhere (StepDoublingError), which
/// knows both. D counts where something moves. Its bounds and those of R are empirical:
/// docs/theory.md has the figures.
#pragma once

#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "transient/Integrator.hpp"

namespace tooljoint::transient {

/// R of steps looked at one by one.
class StepAccuracy {
 public:
  /// Every so many steps one is looked at.
  static constexpr long stride = 8;

  /// Lengths [m]: local error, change of the displacement, displacement.
  void add(double error, double change, double size) {
    error_ += error * error;
    change_ += change * change;
    size_ += size * size;
    ++count_;
  }
  /// R; 0 for a run too short to say, and where all that moves is rounding.
  double ratio() const {
    if (count_ < 8) return 0.0;
    const double noise = 1e-12 * std::sqrt(static_cast<double>(count_)) + 1e-9 * std::sqrt(size_);
    return std::sqrt(error_) > noise ? std::sqrt(error_ / change_) : 0.0;
  }

  /// Root of the mean square of the change [m].
  double change() const {
    return count_ > 0 ? std::sqrt(change_ / static_cast<double>(count_)) : 0.0;
  }

  void save(std::vector<double>& memory) const {
    memory.insert(memory.end(), {error_, change_, size_, static_cast<double>(count_)});
  }
  void restore(const double*& memory) {
    for (double* sum : {&error_, &change_, &size_}) *sum = *memory++;
    count_ = static_cast<long>(*memory++);
  }

 private:
  double error_ = 0, change_ = 0, size_ = 0;
  long count_ = 0;
};

enum class StepVerdict { Good, Coarse, TooLarge };

/// What R and D say of a run: Coarse is worth a warning, TooLarge is no result.
inline StepVerdict assess(const StepErrors& errors) {
  constexpr double moving = 0.001;  ///< R of a motion for which D counts
  constexpr double lost = 0.025, coarse = 0.01;
  constexpr double lostHalves = 0.04, coarseHalves = 0.0033;
  /// D is suspect where contact and iterations are most of it, or where R is large as well.
  constexpr double suspectHalves = 0.02, mostOfIt = 4.2, large = 0.02;
  const double r = errors.local, d = errors.stepDoubling;
  const bool astray = d > lostHalves || (d > suspectHalves && (d > mostOfIt * r || r > large));
  if (r > lost || (r > moving && astray)) return StepVerdict::TooLarge;
  return r > coarse || (r > moving && d > coarseHalves) ? StepVerdict::Coarse : StepVerdict::Good;
}

/// "The time step (0.01 s) is too large: local error 3 % per step, step-doubling difference 4 %."
inline std::string describe(StepVerdict verdict, const StepErrors& errors, double step) {
  const auto percent = [](double part) { return std::round(1000 * part) / 10; };
  std::ostringstream text;
  text << "The time step (" << step << " s) is "
       << (verdict == StepVerdict::TooLarge ? "too large" : "coarse") << ": local error "
       << percent(errors.local) << " % per step";
  if (errors.stepDoubling > 0)
    text << ", step-doubling difference " << percent(errors.stepDoubling) << " %";
  text << ".";
  return text.str();
}

}  // namespace tooljoint::transient
