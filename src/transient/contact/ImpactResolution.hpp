// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Steps short enough for the impacts in them. A point of mass 1/W = 1/(n' R M^-1 R' n) that meets
/// a wall of stiffness k along n vibrates there with w = sqrt(k W), and a step of length h changes
/// its velocity by
///
///     dv = h W n'(f_{n+1} - f_n).
///
/// A rebound in steps of length h loses the part reboundLoss() of its energy, and misplaces up to
/// the part `scatter`, depending on where in a step the wall is met. With a full reversal of the
/// speed v, dv = 2 v, this is loss dv^2 / (8 W) of energy. A step resolves its impacts where
///
///     loss(w h) dv^2 / 4 <= a <v^2>   and   sum scatter(w h) dv^2 / (8 W) <= b <v'M v / 2>
///
/// with means over the run so far, or those of the step where they are larger: what one loses is
/// small beside what a point of the string has, and what all misplace beside what the whole has.
/// 1/W is there at least the mass of a coordinate of the model on average. Nodes in a borehole move
/// alike. A point of one row, such as a stop, may move far less than the rest of the model and is
/// seen by itself: the speed v at which it meets its wall stands for the mean, from a tenth of that
/// on, and what it misplaces, scatter dv^2 / 4, is at most b of v^2.
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

/// Mean part of its energy that a rebound from an elastic wall loses in steps of w h < 2, with
/// spectral radius r: a fit to single masses, within 20 % or 0.03 from w h = 0.15 to 1.2. Beyond,
/// contact is an impact without rebound (PointImpacts), and 1.
double reboundLoss(double wh, double r);

class ImpactResolution {
 public:
  /// For the scheme of spectral radius r and a mass that is inverted.
  void bind(CompiledModel& model, const MassFactor& mass, double radius);
  /// Impacts are resolved by steps of half the length that do so else.
  void halve() { counted_ = 2; }

  /// Halvings of the step from `from` to `to` of length h, just taken, that resolve its impacts; 0
  /// where it does so itself.
  int halvings(const State& from, const State& to, double h);
  /// The same for a first step of length h: halvings that resolve contact which is closed at the
  /// start and opens. In contact of force f, out of balance by a_n along it and moving at v_n, a
  /// point leaves its wall where hypot(a_n, w v_n) > W f - a_n, and reverses 2 hypot(a_n / w, v_n).
  int halvingsAtStart(const State& state, double h);
  /// The step that ended at `to` counts.
  void keep(const State& to, double h);
  /// Level that the next step may have. After an impact steps grow, at most by Tuned::atATime
  /// halvings at once, when closed contact has been without motion for half a period of its
  /// vibration.
  int nextLevel(const State& to, double h, const StepGrid& grid);
  /// The step was lengthened: the wait begins anew.
  void lengthened() { calm_ = 0; }

  /// Append / take back what belongs to no point, alike on all ranks.
  void carry(std::vector<double>& numbers) const;
  void takeUp(const double*& numbers);
  void save(std::vector<double>& memory) const;
  void restore(const double*& memory);

 private:
  struct Set {
    std::vector<double> force;     ///< rows, at the end of the last step kept
    std::vector<double> mobility;  ///< R M^-1 R' per point, width x width, row-major
  };
  /// What a step can do to a point, from the rows its wall pushes along [m/s].
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
  double counted_ = 1;  ///< length that counts over that of a step
  std::vector<Set> sets_;
  MassNorm norm_;
  double share_ = 0;               ///< mass of a coordinate on average [kg]
  double squares_ = 0, time_ = 0;  ///< integral of v'M v over the time measured [J s]
  double unseen_ = 0;              ///< time since the last look
  double current_ = 0;             ///< v'M v of the present step, once it is needed
  double reference_ = 0;           ///< <v^2> that a point is measured by [m2/s2]
  bool alone_ = false;             ///< it is seen by itself
  long kept_ = 0;                  ///< steps
  bool recovering_ = false;        ///< steps are short because of an impact
  double calm_ = 0;                ///< time for which closed contact has been without motion [s]
  MetWall met_;
  std::array<double, Tuned::mostHalvings + 1>
      sums_{};  ///< misplaced() after halvings, of all points
};

}  // namespace tooljoint::transient
