// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Accuracy of fixed steps, measured: windows of some steps of a run are taken again in steps of
/// half the length by a second object of the integrator. With e the difference of the displacements
/// at the end of a window that begins at q_0, the step error is
///
///     S = N sqrt(<|e|^2> / <max_k |q_k - q_0|^2>)
///
/// Means are over the windows, |.| is the norm over the translations of the nodes. A phase error
/// grows with the time: N = T sqrt(<|v|^2> / <|q - q(0)|^2>), but at least 1, is about how many
/// radians the motion turns through in T, the duration of the run but at most 3 s.
///
/// A scheme has a velocity of its own for a motion, which depends on the step: a window taken again
/// with the velocity of the run would begin with an error of the scheme's order that the run does
/// not have. The velocity is corrected until the first step ends where that of the run does.
///
/// In the first 64 steps and one in eleven after them the energy e that the scheme itself
/// takes in a step (NumericalDamping) is set beside the energy of vibration, twice its kinetic
/// energy: at the rate <e / h> / (2 E) of its energy the amplitude falls in T by exp(-d), d = T <e
/// / h> / (4 <v'M v / 2>), v'M v from the speeds of the nodes. S does not see what steps and halves
/// damp alike.
///
/// In the same steps it is asked whether contact rests on walls too stiff for them: vibration of
/// such contact is held down by steps and halves alike.
///
/// The second object has points, factor, counters and memory of its own and leaves the model as it
/// was: the run does not notice it.
#pragma once

#include <memory>
#include <vector>

#include "transient/Integrator.hpp"
#include "transient/accuracy/NumericalDamping.hpp"
#include "transient/accuracy/TranslationNorm.hpp"

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
  /// 1 - exp(-d): part of its amplitude that vibration loses in T by the scheme; 0 where it is not
  /// known.
  double damped() const;
  /// Contact rests on walls too stiff for the steps in more than a tenth of them.
  bool hasUnresolvedContact() const;
  double span() const { return turning_; }  ///< T [s]
  /// Of a scheme that damps; null for others.
  const NumericalDamping* damping() const { return damping_; }

  void save(std::vector<double>& memory) const;
  void restore(const double*& memory);

 private:
  template <class Work>
  void withModel(const Work& work);
  void plan();
  double time(long step) const { return begin_ + static_cast<double>(step) * h_; }
  long nextLook() const;
  void lookAtDamping(const State& from, const State& to);
  bool retake();
  void retakeUntil(double t);

  CompiledModel* model_;
  const NumericalDamping* damping_;
  std::unique_ptr<Integrator> second_;
  std::vector<PointBatch> points_;    ///< of the second object
  CompiledModel::Snapshot snapshot_;  ///< of the run
  TranslationNorm norm_;
  double begin_, h_, turning_;  ///< start of the run, step, T [s]
  Vector start_;                ///< q(0)
  long steps_;                  ///< in the run
  long stride_;                 ///< mean distance of windows in steps

  long seen_ = 0;  ///< windows begun
  long next_ = 0;  ///< first step of the next one
  long end_ = -1;  ///< last step of the one under way, -1 for none
  // the window under way
  State from_;                   ///< where it began
  Vector first_;                 ///< displacement at the end of its first step
  std::vector<double> history_;  ///< of the integrator where it began
  std::vector<double> scales_;   ///< of all points there
  double most_ = 0;              ///< max_k |q_k - q_0|^2
  State state_, to_;
  Vector difference_;
  // sums over windows
  long count_ = 0;
  double errors_ = 0, moved_ = 0;  ///< |e|^2, max_k |q_k - q_0|^2
  double sizes_ = 0;               ///< |q|^2 at their ends
  // over all steps, from some of them
  double lost_ = 0, vibrated_ = 0;  ///< sum of e [J], integral of |v|^2
  long taken_ = 0;                  ///< steps, those of cut ones one by one
  long looks_ = 0;                  ///< at steps after the first ones
  double rested_ = 0;               ///< steps with unresolved contact
  // over windows
  double speeds_ = 0, offsets_ = 0, looked_ = 0;  ///< integrals of |v|^2, |q - q(0)|^2 and 1
};

}  // namespace tooljoint::transient
