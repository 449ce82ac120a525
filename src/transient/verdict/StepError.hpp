// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Measured accuracy of fixed steps. Windows of some steps of a run are repeated in steps of half
/// the length (RetakenWindow). With e the difference of the displacements at the end of a window
/// that starts at q_0, the estimate of the step error is
///
///     S = N sqrt(<|e|^2> / <max_k |q_k - q_0|^2>)
///
/// Means are over the windows. |.| is the norm over the translations of the nodes and that of the
/// mass (MotionNorm.hpp); S is the larger value. A phase error grows with time: N = T sqrt(<|v|^2>
/// / <|q - q(0)|^2>), at least 1, is about the number of radians of the motion in T, the duration
/// of the run but at most 3 s. S does not include damping common to steps and halves;
/// DampingSamples measures it.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "transient/Integrator.hpp"
#include "transient/accuracy/MotionNorm.hpp"
#include "transient/verdict/BusiestSpan.hpp"
#include "transient/verdict/DampingSamples.hpp"
#include "transient/verdict/RetakenWindow.hpp"

namespace tooljoint::transient {

class StepError {
 public:
  /// \param run     prepared, with equal steps (Integrator::equalStep() > 0)
  /// \param second  made from the same parameters
  /// \param start   state at the start of the run
  StepError(CompiledModel& model, const Integrator& run, std::unique_ptr<Integrator> second,
            const Window& window, const State& start);
  /// Call before the step of `run` from `from`.
  void before(const Integrator& run, const State& from);
  /// Call after that step.
  void after(const State& from, const State& to);
  /// S; 0 without motion or if the run is too short for an estimate.
  double value() const;
  /// Fraction of the amplitude that vibration loses in T by the scheme; 0 if not known.
  double damped() const;
  /// Numerical damping of the scheme.
  const DampingSamples& damping() const { return damping_; }
  double span() const { return turning_; }  ///< T [s]
  /// State from which the motion is compared: the start of the run or, if the motion begins after
  /// half of T, the last window before.
  const State& beginning() const { return calm_; }
  /// The span that is hardest for the steps, if it is later and far harder than this motion; else
  /// null.
  const BusiestSpan* later() const {
    return busiest_ && busiest_->isLater() && busiest_->end() > calm_.t + turning_ ? &*busiest_
                                                                                   : nullptr;
  }

  void save(std::vector<double>& memory) const;
  void restore(const double*& memory);

 private:
  void plan();
  long windowNow() const;
  void watchCalm(const State& from);
  double of(int norm) const;
  double time(long step) const { return begin_ + static_cast<double>(step) * h_; }

  MotionNorm norm_;
  RetakenWindow window_;
  DampingSamples damping_;
  std::optional<BusiestSpan> busiest_;  ///< of a run much longer than T
  double begin_, h_, turning_;          ///< start of the run, step, T [s]
  Vector start_;                        ///< q(0)
  Vector difference_;
  bool followsPhase_;  ///< of the scheme, in this model
  long steps_;         ///< in the run
  long stride_;        ///< mean distance of windows in steps

  long seen_ = 0;      ///< windows started
  long next_ = 0;      ///< first step of the next window
  long end_ = -1;      ///< last step of the current window, -1 for none
  long inWindow_ = 0;  ///< steps in the current window
  Norms most_{0, 0};   ///< max_k |q_k - q_0|^2 in the current window
  struct Sums {
    double windows = 0, duration = 0;   ///< 1, integral of 1
    Norms errors{0, 0}, moved{0, 0};    ///< |e|^2, max_k |q_k - q_0|^2
    Norms sizes{0, 0};                  ///< |q|^2 at the ends of the windows
    Norms speeds{0, 0}, offsets{0, 0};  ///< integrals of |v|^2, |q - q(0)|^2
  } sums_;                              ///< over all windows
  State last_;                          ///< at the start of the last window
  State calm_;                          ///< beginning()
  double level_ = 0;  ///< offset'M offset at the last window where the motion began anew
};

}  // namespace tooljoint::transient
