// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Repeats the steps of a run. The first T seconds of its motion, from its beginning
/// (StepError.hpp), are integrated twice, side by side, in the steps of the run and in other steps:
///
///     D^2 = sum |q - q'|^2 / sum |q' - q(0)|^2        over the steps of the run in T
///     V^2 = sum |v - v'|^2 / sum |v'|^2
///     r^2 = sum |q_k - q_k-1|^2 / sum |q'_k - q'_k-1|^2     over those in the second half of T
///
/// |.| is the norm over the translations of the nodes, and that of the mass (MotionNorm.hpp). q'
/// and v' are displacement and velocity of the other motion. Its steps are halves without numerical
/// damping, also of the steps that impacts need, or shorter ones where halves do not resolve
/// contact that rests on a wall (NumericalDamping.hpp). Against halves, D is the vibration error
/// less that of the halves: half of it for steps of first order, most of it otherwise. Comparing
/// the other steps with themselves after a disturbance of the velocity by a thousandth, D is the
/// sensitivity. If it is about as large as the first D, neighbouring motions diverge, and only
/// means like r show whether the steps are right.
///
/// It has its own objects, points and states; the model is unchanged afterwards.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "transient/Integrator.hpp"
#include "transient/accuracy/MotionNorm.hpp"

namespace tooljoint::transient {

/// The speed ratio farther from 1, up or down.
double farthest(const Norms& ratios);

class StepComparison {
 public:
  struct Difference {
    Norms sizes{0, 0};        ///< D in both norms
    double size = 0;          ///< the larger one
    Norms ratios{1, 1};       ///< r in both norms; 1 without motion
    double speeds = 1;        ///< the one farther from 1
    double velocities = 0;    ///< V, the larger one
    bool still = false;       ///< no motion: the other values mean nothing
    bool whole = false;       ///< the run ends within T
    bool unresolved = false;  ///< contact rests on walls too stiff even for the shorter steps
  };

  /// \param make    objects made from the parameters of the run
  /// \param window  that of the run, with the length of its equal steps
  /// \param span    T [s]
  /// \param start q, v and states at the start of the compared motion
  /// \param stop true: end with an InterruptedError
  StepComparison(CompiledModel& model, std::function<std::unique_ptr<Integrator>()> make,
                 const Window& window, double span, const State& start, std::function<bool()> stop);
  /// Reduces the other steps to a quarter; false if they are already a 32nd of a step.
  bool shorten();
  double shorterStep() const { return window_.step / parts_; }
  /// Compares with the shorter steps without numerical damping; empty if these have no solution.
  /// Collective.
  std::optional<Difference> withShorter();
  /// Compares the shorter steps with their own disturbed motion. Collective.
  std::optional<Difference> withDisturbed();

 private:
  /// A separate motion on the model.
  struct Motion {
    std::unique_ptr<Integrator> scheme;
    std::vector<PointBatch> points;
    TimedTerms::Snapshot model;
    State state, next;
  };
  void begin(Motion& motion, std::unique_ptr<Integrator> scheme, double step);
  void advance(Motion& motion, double t);
  std::unique_ptr<Integrator> sharpened() const;
  /// Sums over the steps of the run in T.
  struct Sums {
    Norms apart{0, 0}, moved{0, 0}, size{0, 0};  ///< |q - q'|^2, |q' - q(0)|^2, |q'|^2
    Norms v{0, 0}, otherV{0, 0};                 ///< |v - v'|^2, |v'|^2
    Norms otherPath{0, 0};                       ///< |q'_k - q'_k-1|^2
    Norms latePath{0, 0}, otherLatePath{0, 0};   ///< of q and q' in the second half
    bool isFinite() const { return (apart + moved + v + otherPath + latePath).allFinite(); }
  };
  std::optional<Difference> compare(std::unique_ptr<Integrator> first, double step, double kick);
  Difference differenceOf(const Sums& sums) const;

  CompiledModel* model_;
  std::function<std::unique_ptr<Integrator>()> make_;
  Window window_;
  bool whole_;     ///< the run ends within T
  int parts_ = 2;  ///< number of other steps per step
  State start_;
  std::function<bool()> stop_;
  MotionNorm norm_;
};

}  // namespace tooljoint::transient
