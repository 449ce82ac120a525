// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Accuracy of fixed steps, measured: windows of some steps of a run are taken again in steps of
/// half the length (RetakenWindow). With e the difference of the displacements at the end of a
/// window that begins at q_0, the estimate of the step error is
///
///     S = N sqrt(<|e|^2> / <max_k |q_k - q_0|^2>)
///
/// Means are over the windows, |.| is the norm over the translations of the nodes, and that of the
/// mass (MotionNorm.hpp): S is the larger of both. A phase error
/// grows with the time: N = T sqrt(<|v|^2> / <|q - q(0)|^2>), but at least 1, is about how many
/// radians the motion turns through in T, the duration of the run but at most 3 s. S does not see
/// what steps and halves damp alike: DampingSamples do.
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
  /// Before the step of `run` from `from`.
  void before(const Integrator& run, const State& from);
  /// After it.
  void after(const State& from, const State& to);
  /// S; 0 where nothing moves, and for a run too short to say.
  double value() const;
  /// Part of its amplitude that vibration loses in T by the scheme; 0 where it is not known.
  double damped() const;
  /// Of a scheme that damps.
  const DampingSamples& damping() const { return damping_; }
  double span() const { return turning_; }  ///< T [s]
  /// From where the motion is worth comparing: the start of the run, or, where the motion begins
  /// after half of T, its state at the last window before.
  const State& beginning() const { return calm_; }
  /// Where the run has most to follow, when that is later and far more than there; null else.
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

  long seen_ = 0;      ///< windows begun
  long next_ = 0;      ///< first step of the next one
  long end_ = -1;      ///< last step of the one under way, -1 for none
  long inWindow_ = 0;  ///< steps of it
  Norms most_{0, 0};   ///< max_k |q_k - q_0|^2 in it
  struct Sums {
    double windows = 0, duration = 0;   ///< 1, integral of 1
    Norms errors{0, 0}, moved{0, 0};    ///< |e|^2, max_k |q_k - q_0|^2
    Norms sizes{0, 0};                  ///< |q|^2 at their ends
    Norms speeds{0, 0}, offsets{0, 0};  ///< integrals of |v|^2, |q - q(0)|^2
  } sums_;                              ///< over windows
  State last_;                          ///< at the start of the last window
  State calm_;                          ///< where the motion begins
  double level_ = 0;  ///< offset'M offset at the last window where the motion had risen
};

}  // namespace tooljoint::transient
