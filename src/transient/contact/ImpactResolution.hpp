// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Step size for impacts. A point of mass 1/W = 1/(n' R M^-1 R' n) that meets a wall of stiffness k
/// along n vibrates there with w = sqrt(k W), and a step of length h changes its velocity by
///
///     dv = h W n'(f_{n+1} - f_n).
///
/// In steps of length h a rebound loses the part reboundLoss() of its energy and misplaces up to
/// the part `scatter`, depending on when within a step the wall is met. For a full reversal of the
/// speed v, dv = 2 v, this is an energy of loss dv^2 / (8 W). A step resolves its impacts if
///
///     loss(w h) dv^2 / 4 <= a <v^2>   and   sum scatter(w h) dv^2 / (8 W) <= b <v'M v / 2>
///
/// with means over the run so far, or values of the step if they are larger: the loss of one impact
/// is small compared with the energy of a point, and the sum of the misplaced energies compared
/// with the energy of the model. 1/W in the sum is at least the mean mass of a coordinate. Nodes in
/// a borehole all move alike. A point of one row, such as a stop, may move far less than the rest
/// of the model and is judged on its own: the speed v at which it meets its wall replaces the mean,
/// down to a tenth of the mean, and its misplaced part, scatter dv^2 / 4, is at most b of v^2.
#pragma once

#include <array>
#include <vector>

#include "transient/Tuned.hpp"
#include "transient/accuracy/StepControl.hpp"
#include "transient/accuracy/StepGrid.hpp"
#include "transient/compiled/CompiledModel.hpp"
#include "transient/compiled/MassFactor.hpp"
#include "transient/contact/MetWall.hpp"

namespace tooljoint::transient {

struct State;

/// Mean part of its energy that a rebound from an elastic wall loses in steps of w h < 2 with
/// spectral radius r: a fit to single masses, within 20 % or 0.03 for w h from 0.15 to 1.2. Above w
/// h = 2 contact is an impact without rebound (PointImpacts): 1.
double reboundLoss(double wh, double r);

class ImpactResolution {
 public:
  /// Binds for the scheme of spectral radius r and an inverted mass.
  void bind(CompiledModel& model, const MassFactor& mass, double radius);
  /// Impacts then need steps of half the usual length.
  void halve() { counted_ = 2; }

  /// Halvings of the step from `from` to `to` of length h, just taken, that resolve its impacts; 0
  /// if the step resolves them.
  int halvings(const State& from, const State& to, double h);
  /// The same for a first step of length h: halvings that resolve contact closed at the start that
  /// opens. With contact force f, acceleration a_n by its imbalance and velocity v_n, a point
  /// leaves its wall if hypot(a_n, w v_n) > W f - a_n, and reverses 2 hypot(a_n / w, v_n).
  int halvingsAtStart(const State& state, double h);
  /// Accepts the step that ended at `to`.
  void keep(const State& to, double h);
  /// Level of the next step. After an impact steps are lengthened, by at most Tuned::atATime
  /// halvings at once, when closed contact has been without motion for half a period of its
  /// vibration.
  int nextLevel(const State& to, double h, const StepGrid& grid);
  /// The step has been lengthened: restarts the waiting time.
  void lengthened() { calm_ = 0; }

  /// Append / restore the data that belong to no point and are equal on all ranks.
  void carry(std::vector<double>& numbers) const;
  void takeUp(const double*& numbers);
  void save(std::vector<double>& memory) const;
  void restore(const double*& memory);

 private:
  struct Set {
    std::vector<double> force;     ///< rows, at the end of the last accepted step
    std::vector<double> mobility;  ///< R M^-1 R' per point, width x width, row-major
  };
  /// Bound of the effect of a step on a point, from the rows in which its wall acts [m/s].
  struct Bound {
    double change = 0;  ///< h W |f_{n+1} - f_n|
    double speed = 0;
  };
  const double* mobility(int batch, int point) const;
  Bound bound(int batch, int point, double t, double h, const double* before);
  bool isFast(const MetWall& wall, double change, double h) const;
  bool losesMuch(const MetWall& wall, double change, double h) const;
  double misplaced(const MetWall& wall, double change, double h) const;
  double calmNeeded(const State& to, double h);
  double square() const;
  double mostMisplaced() const;
  double impactSpeed(double speed) const;
  void measureBy(int batch, double speed);
  bool matters(double change) const;
  template <class Visit>
  void visitTurned(const State& from, const State& to, double h, const Visit& visit);
  template <class Visit>
  void visitReleased(const State& state, double h, const Visit& visit);
  template <class Points>
  int halvingsOf(double h, const Points& visitPoints);
  bool isCoarse(const State& from, const State& to, double h);

  CompiledModel* model_ = nullptr;
  double radius_ = 1;
  double counted_ = 1;  ///< effective over actual step length
  std::vector<Set> sets_;
  MassNorm norm_;
  double share_ = 0;               ///< mean mass of a coordinate [kg]
  double squares_ = 0, time_ = 0;  ///< integral of v'M v, measured time [J s], [s]
  double unseen_ = 0;              ///< time since the last measurement
  double current_ = 0;             ///< v'M v of the current step, on demand
  double reference_ = 0;           ///< <v^2> to compare a point with [m2/s2]
  bool alone_ = false;             ///< the point is judged on its own
  long kept_ = 0;                  ///< accepted steps
  bool recovering_ = false;        ///< steps are short because of an impact
  double calm_ = 0;                ///< time for which closed contact has been without motion [s]
  MetWall met_;
  std::array<double, StepGrid::mostHalvings + 1>
      sums_{};  ///< misplaced() after halvings, of all points
};

}  // namespace tooljoint::transient
