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

/// A batch of `size()` points with `width()` coordinates each and the same law.
///
/// All arrays are point-major: coordinate c of point p is at p*width()+c; tangents at
/// (p*width()+row)*width()+column. `active` lists the points to evaluate (0-based, increasing); the
/// outputs of the others are not changed. There is one virtual call per batch, not per point.
/// Implementations do not allocate in evaluate*().
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

  /// Distance that each of the given points can still move before its force may exceed the law's
  /// negligible tail [m]; <= 0: it must be evaluated now. The values of other points are not
  /// changed. Used to evaluate only points that may be in contact before the next check.
  virtual void clearanceLeft(const std::vector<int>& points, const double* d,
                             double* gap) const = 0;
  /// The clearance depends only on this many first coordinates, and changes by no more than the
  /// norm of their change.
  virtual int reach() const { return width(); }
  /// Whether the law may reverse a point like a wall, in an impact for which steps are halved. A
  /// force that acts all the time, such as a spring, is integrated like the stiffness and damping
  /// of the model.
  virtual bool hasWalls() const { return true; }

  /// Stored energy [J] and dissipated power [W >= 0: normal damping, friction], summed over the
  /// given points, for the energy ledger.
  struct Power {
    double stored = 0;    ///< potential of the conservative part [J]
    double damping = 0;   ///< power lost in normal damping [W]
    double friction = 0;  ///< power lost in friction [W]
    double drive = 0;     ///< power of the prescribed motion (rotary drive acting through friction)
                          ///< [W]
  };
  virtual Power power(double t, const std::vector<int>& points, const double* d,
                      const double* v) const = 0;

  /// Quantities that can be recorded; `record` fills out[channel*size()+point].
  virtual std::vector<Channel> channels() const = 0;
  virtual void record(double t, const double* d, const double* v, double* out) const = 0;

  /// The same law for some of the points (0-based positions in this batch).
  virtual std::shared_ptr<const PointLaw> subset(const std::vector<int>& points) const = 0;
};

/// Added to PointLaw for laws that depend on the rotary speed: friction at a wall.
class Turning {
 public:
  virtual ~Turning() = default;
  /// The same law at a constant rotary speed [rad/s].
  virtual std::shared_ptr<const PointLaw> atSpeed(double speed) const = 0;
};

/// The law at this speed; the law itself if it does not depend on the rotary speed.
inline std::shared_ptr<const PointLaw> atSpeed(const std::shared_ptr<const PointLaw>& law,
                                               double speed) {
  const auto* turning = dynamic_cast<const Turning*>(law.get());
  return turning != nullptr ? turning->atSpeed(speed) : law;
}

}  // namespace tooljoint::model
