// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The steps of a run once more: the first T seconds of its motion, from where it begins
/// (StepError.hpp), are integrated twice more, side by side, in the steps of the run and otherwise:
///
///     D^2 = sum |q - q'|^2 / sum |q' - q(0)|^2        over the steps of the run in T
///     V^2 = sum |v - v'|^2 / sum |v'|^2
///     r^2 = sum |q_k - q_k-1|^2 / sum |q'_k - q'_k-1|^2     over those in the second half of T
///
/// |.| is the norm over the translations of the nodes, and that of the mass (MotionNorm.hpp); q'
/// and v' are displacement and velocity of the other motion. The other steps are halves without
/// numerical damping, also of the steps that impacts need, or shorter where halves do not resolve
/// contact that rests on a wall (NumericalDamping.hpp). Beside halves D is the vibration error less
/// that of the halves: half of it where the steps are of first order, most of it else. Of the other
/// steps beside themselves with a velocity that is disturbed by a thousandth, D is the sensitivity:
/// where it is of the size of the first, the motion parts from any neighbour and only means like r
/// say whether the steps are right.
///
/// Objects, points and states are its own; the model is left as it was.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "transient/Integrator.hpp"
#include "transient/accuracy/MotionNorm.hpp"

namespace tooljoint::transient {

/// The ratio of speeds that is farther from 1, up or down.
double farthest(const Norms& ratios);

class StepComparison {
 public:
  struct Difference {
    Norms sizes{0, 0};        ///< D in both norms
    double size = 0;          ///< the larger one
    Norms ratios{1, 1};       ///< r in both norms; 1 where nothing moves
    double speeds = 1;        ///< the one farther from 1
    double velocities = 0;    ///< V, the larger one
    bool still = false;       ///< nothing moves: the others say nothing
    bool whole = false;       ///< the run ends within T
    bool unresolved = false;  ///< contact rests on walls too stiff for the shorter steps, too
  };

  /// \param make    objects made from the parameters of the run
  /// \param window  that of the run, with the length of its equal steps
  /// \param span    T [s]
  /// \param start   q, v and states where the compared motion begins
  /// \param stop    true to end with an InterruptedError
  StepComparison(CompiledModel& model, std::function<std::unique_ptr<Integrator>()> make,
                 const Window& window, double span, const State& start, std::function<bool()> stop);
  /// The other steps become a quarter as long; false where they are a 32nd of a step already.
  bool shorten();
  double shorterStep() const { return window_.step / parts_; }
  /// Beside the shorter steps without numerical damping; nothing where these have no solution.
  /// Collective.
  std::optional<Difference> withShorter();
  /// These beside a disturbed motion of their own. Collective.
  std::optional<Difference> withDisturbed();

 private:
  /// A motion of its own on the model.
  struct Motion {
    std::unique_ptr<Integrator> scheme;
    std::vector<PointBatch> points;
    CompiledModel::Snapshot model;
    State state, next;
  };
  void begin(Motion& motion, std::unique_ptr<Integrator> scheme, double step);
  void advance(Motion& motion, double t);
  std::unique_ptr<Integrator> sharpened() const;
  /// Over the steps of the run in T.
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
  int parts_ = 2;  ///< of a step, that the other steps are
  State start_;
  std::function<bool()> stop_;
  MotionNorm norm_;
};

}  // namespace tooljoint::transient
