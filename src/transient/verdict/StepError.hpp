// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Accuracy of fixed steps, measured: windows of some steps of a run are taken again in steps of
/// half the length (RetakenWindow). With e the difference of the displacements at the end of a
/// window that begins at q_0, the estimate of the step error is
///
///     S = N sqrt(<|e|^2> / <max_k |q_k - q_0|^2>)
///
/// Means are over the windows, |.| is the norm over the translations of the nodes. A phase error
/// grows with the time: N = T sqrt(<|v|^2> / <|q - q(0)|^2>), but at least 1, is about how many
/// radians the motion turns through in T, the duration of the run but at most 3 s. S does not see
/// what steps and halves damp alike: DampingSamples do.
#pragma once

#include <memory>
#include <vector>

#include "transient/Integrator.hpp"
#include "transient/accuracy/TranslationNorm.hpp"
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

  void save(std::vector<double>& memory) const;
  void restore(const double*& memory);

 private:
  void plan();
  double time(long step) const { return begin_ + static_cast<double>(step) * h_; }

  TranslationNorm norm_;
  RetakenWindow window_;
  DampingSamples damping_;
  double begin_, h_, turning_;  ///< start of the run, step, T [s]
  Vector start_;                ///< q(0)
  Vector difference_;
  long steps_;   ///< in the run
  long stride_;  ///< mean distance of windows in steps

  long seen_ = 0;    ///< windows begun
  long next_ = 0;    ///< first step of the next one
  long end_ = -1;    ///< last step of the one under way, -1 for none
  double most_ = 0;  ///< max_k |q_k - q_0|^2 in it
  struct Sums {
    double windows = 0, errors = 0, moved = 0;     ///< 1, |e|^2, max_k |q_k - q_0|^2
    double sizes = 0;                              ///< |q|^2 at their ends
    double speeds = 0, offsets = 0, duration = 0;  ///< integrals of |v|^2, |q - q(0)|^2 and 1
  } sums_;                                         ///< over windows
};

}  // namespace tooljoint::transient
