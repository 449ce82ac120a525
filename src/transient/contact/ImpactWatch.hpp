// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Impacts that a step does not resolve. A point of mass 1/W = 1/(n' R M^-1 R' n) that meets a wall
/// of stiffness k along n vibrates there with w = sqrt(k W), and a step of length h changes its
/// velocity by
///
///     dv = h W n'(f_{n+1} - f_n).
///
/// A rebound in steps of length h loses the part `loss` of its energy, and misplaces up to the part
/// `scatter`, depending on where in a step the wall is met. A step resolves it where
///
///     loss(w h) dv^2 <= 4 a <v^2>   and   scatter(w h) dv^2 / (2 W) <= 4 b <v'M v / 2>
///
/// with means over the run so far, or the values of now where they are larger: what is lost is
/// small beside what a point of the string has, and what is misplaced beside what the whole has. A
/// full reversal is dv = 2 v, which explains the 4.
#pragma once

#include <vector>

#include "linalg/blocks/BlockFactor.hpp"
#include "transient/accuracy/StepControl.hpp"
#include "transient/compiled/CompiledModel.hpp"

namespace tooljoint::transient {

struct State;

class ImpactWatch {
 public:
  /// Unit pivots stand in the factor of the mass matrix where there is no mass.
  struct Mass {
    const linalg::BlockFactor* factor;
    const double* perUnit;             ///< 1 / M_ii
    const std::vector<char>* missing;  ///< per position: no mass
  };
  /// For the scheme of spectral radius r; the mass must outlive the watch.
  void bind(CompiledModel& model, const Mass& mass, double radius);

  /// Halvings of the step from `from` to `to` of length h, just taken, that resolve its impacts; 0
  /// where it does so itself.
  int halvings(const State& from, const State& to, double h);
  /// Time for which contact that is closed at `to` must have been without motion before a step of
  /// length h may follow: half a period of its vibration, since it also rests where it is pressed
  /// in furthest; infinite where it moves, 0 where none is closed that h does not resolve.
  double calmNeeded(const State& to, double h);
  /// The step that ended at `to` counts.
  void keep(const State& to, double h);

  void save(std::vector<double>& memory) const;
  void restore(const double*& memory);

 private:
  struct Set {
    std::vector<double> force;     ///< rows, at the end of the last step kept
    std::vector<double> mobility;  ///< R M^-1 R' per point, width x width, row-major
    std::vector<char> known;       ///< per point: its mobility
  };
  /// Where a point meets its wall.
  struct Wall {
    double frequency = 0;  ///< w [rad/s]; 0 where nothing is met
    double mobility = 0;   ///< W [1/kg]
    double damping = 0;    ///< -W n' df/dv n [1/s]
    double push = 0;       ///< n'f [N]
  };
  const double* mobility(int batch, int point);
  Wall wall(int batch, int point, double t, double speed, double h);
  bool resolves(const Wall& wall, double change, double h) const;
  double square() const;
  bool matters(double change) const;
  /// Component along the normal of the last wall().
  double along(int batch, int point, const Vector& v) const;

  CompiledModel* model_ = nullptr;
  Mass mass_{};
  double radius_ = 1;
  std::vector<Set> sets_;
  MassNorm norm_;
  double squares_ = 0, time_ = 0;  ///< integral of v'M v over the time looked at [J s]
  double unseen_ = 0;              ///< time since the last look
  double now_ = 0;                 ///< v'M v of the step looked at, once it is asked for
  long kept_ = 0;                  ///< steps
  Vector column_;
  std::vector<int> blocks_;
  std::vector<double> f_, dfdd_, dfdv_;
  std::vector<double> normal_, deeper_;  ///< n of the last wall() and a place behind it, in rows
};

}  // namespace tooljoint::transient
