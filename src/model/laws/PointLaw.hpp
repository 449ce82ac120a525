// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Nonlinear forces at points (contact, friction, springs, stops), evaluated for a whole batch of
/// points at once.
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace tooljoint::model {

/// A quantity a point law can report for output, one value per point (normal force, gap ...).
struct Channel {
  std::string name;      ///< dataset name, e.g. "normal_force"
  std::string unit;      ///< SI unit, e.g. "N"
  std::string longName;  ///< sentence for the results file
};

/// A batch of `size()` points with `width()` coordinates each, all obeying one law.
///
/// All arrays are point-major: coordinate c of point p stands at p*width()+c; tangents at
/// (p*width()+row)*width()+column. `active` lists the points to evaluate (0-based, increasing); the
/// others are left untouched in the outputs. Virtual calls happen once per batch, never per point.
/// Implementations allocate nothing in evaluate*().
class PointLaw {
 public:
  virtual ~PointLaw() = default;
  virtual int size() const = 0;
  virtual int width() const = 0;

  /// Force on the points, f [N, N m], for positions d [m, rad] and velocities v at time t [s].
  virtual void evaluate(double t, const std::vector<int>& active, const double* d, const double* v,
                        double* f) const = 0;

  /// Force and its exact derivatives dfdd = df/dd, dfdv = df/dv.
  virtual void evaluateWithTangent(double t, const std::vector<int>& active, const double* d,
                                   const double* v, double* f, double* dfdd,
                                   double* dfdv) const = 0;

  /// Distance a point can still move before its force may exceed the law's negligible tail [m], per
  /// point; <= 0 means it must be evaluated now; for the points given, the others are left
  /// untouched. Used to evaluate only points that can act before the next look.
  virtual void clearanceLeft(const std::vector<int>& points, const double* d,
                             double* gap) const = 0;
  /// The first so many coordinates decide about it: it changes by no more than the length of their
  /// change.
  virtual int reach() const { return width(); }
  /// Whether it may turn a point as a wall does, in an impact that steps are halved for. What acts
  /// all the time without a wall, such as a spring, is followed as the stiffness and damping of the
  /// model are.
  virtual bool hasWalls() const { return true; }

  /// Stored energy [J] and dissipated power [W >= 0: normal damping, friction] summed over the
  /// points given, for the energy ledger.
  struct Power {
    double stored = 0;    ///< potential of the conservative part [J]
    double damping = 0;   ///< power lost in normal damping [W]
    double friction = 0;  ///< power lost in friction [W]
    double drive = 0;  ///< power fed in through prescribed motion (the rotary drive acting through
                       ///< friction) [W]
  };
  virtual Power power(double t, const std::vector<int>& points, const double* d,
                      const double* v) const = 0;

  /// What can be recorded; `record` fills out[channel*size()+point].
  virtual std::vector<Channel> channels() const = 0;
  virtual void record(double t, const double* d, const double* v, double* out) const = 0;

  /// The same law for some of the points (0-based positions in this batch).
  virtual std::shared_ptr<const PointLaw> subset(const std::vector<int>& points) const = 0;
};

/// Beside PointLaw for laws whose points turn with the rotary speed: friction at a wall.
class Turning {
 public:
  virtual ~Turning() = default;
  /// The same law at a constant rotary speed [rad/s].
  virtual std::shared_ptr<const PointLaw> atSpeed(double speed) const = 0;
};

/// The law itself where it does not depend on the rotary speed.
inline std::shared_ptr<const PointLaw> atSpeed(const std::shared_ptr<const PointLaw>& law,
                                               double speed) {
  const auto* turning = dynamic_cast<const Turning*>(law.get());
  return turning != nullptr ? turning->atSpeed(speed) : law;
}

}  // namespace tooljoint::model
