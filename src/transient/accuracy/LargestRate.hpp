// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A bound of the rates |lambda| at which a model moves, which bounds explicit steps:
///
///     lambda^2 M x + lambda C x + K x = 0,   x*M x = 1:   |lambda|^2 <= g |lambda| + k
///     |lambda| <= g/2 + sqrt(g^2/4 + k),     k = |M^-1 K|_M,  g = |M^-1 C|_M
///
/// Norms rather than eigenvalues: they hold for unsymmetric matrices too (torque, gyroscopic and
/// Coriolis terms, friction), and laws of time take part with their largest size. Points of a wall
/// take part as if they touched it; sqrt(k) of their stiffness alone is the rate of an impact.
///
/// States x' = g(d, v, x) of points, on which their forces f depend, add df/dx dg/dv to K and
///
///     |lambda|^3 <= g |lambda|^2 + k |lambda| + c,   c = |M^-1 df/dx dg/dd|_M,
///
/// as if they did not act on themselves; the largest |dg/dx| is added to that |lambda|.
#pragma once

#include <vector>

#include "linalg/blocks/BlockFactor.hpp"
#include "transient/Integrator.hpp"

namespace tooljoint::transient {

class LargestRate {
 public:
  /// \param mass  factor of the mass matrix; both must outlive this
  LargestRate(CompiledModel& model, const linalg::BlockFactor& mass) : model_(model), mass_(mass) {}
  struct Rates {
    double all;     ///< bound of |lambda| [1/s]
    double impact;  ///< of the points alone, without damping [1/s]
  };
  /// For a motion that starts at `state` and ends at the time `end`. Where points are evaluated,
  /// what a batch holds of its last evaluation is lost.
  Rates operator()(const State& state, double end);
  /// |M^-1 R' df/dv R|_M of the points that meet no wall, such as a bit, as they are at `state`
  /// [1/s]; 0 without such points. The same is lost.
  double ofDampingLaws(const State& state);

 private:
  /// Tangents of all points of a batch, width x width each, row-major.
  struct Tangents {
    std::vector<double> position, velocity;
    std::vector<double> state;  ///< df/dx dg/dd
  };
  using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  enum class Which { All, WithoutWalls };
  void evaluatePoints(const State& state, Which which);
  bool goToWall(const PointBatch& batch, int point, int coordinate, double way, Vector& d);
  void evaluate(PointBatch& batch, int point, double t, const Vector& d);
  void addStates(const PointStates& states, int point);
  void keepNormalDamping();
  void takeLarger(int point, Tangents& tangents) const;
  void subtractPoints(std::vector<double> Tangents::*which, const Vector& x, Vector& y) const;
  std::vector<double> largestLaws(double begin, double end) const;
  double normOfPoints(std::vector<double> Tangents::*points) const;
  template <class Product>
  double norm(const Product& times) const;

  CompiledModel& model_;
  const linalg::BlockFactor& mass_;
  std::vector<Tangents> tangents_;  ///< per batch
  Vector gap_;                      ///< clearances of a batch
  Vector force_;                    ///< of one point, with its tangents
  Square position_, velocity_, state_;
  double ofStates_ = 0;  ///< largest |dg/dx| [1/s]
};

}  // namespace tooljoint::transient
