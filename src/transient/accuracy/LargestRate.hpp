// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Bound of the rates |lambda| of a model, which limits explicit steps:
///
///     lambda^2 M x + lambda C x + K x = 0,   x*M x = 1:   |lambda|^2 <= g |lambda| + k
///     |lambda| <= g/2 + sqrt(g^2/4 + k),     k = |M^-1 K|_M,  g = |M^-1 C|_M
///
/// Norms are used because they also hold for unsymmetric matrices (torque, gyroscopic and Coriolis
/// terms, friction). Laws of time enter with their largest absolute value. Points with a wall enter
/// as if they touched it; sqrt(k) of their stiffness alone is the rate of an impact.
///
/// States x' = g(d, v, x) of points with forces f(x) add df/dx dg/dv to K and give
///
///     |lambda|^3 <= g |lambda|^2 + k |lambda| + c,   c = |M^-1 df/dx dg/dd|_M,
///
/// as if the states did not depend on themselves; the largest |dg/dx| is added to |lambda|.
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
    double impact;  ///< of the point stiffness alone, without damping [1/s]
  };
  /// Rates for a motion from `state` to the time `end`. Batches evaluated here lose the results of
  /// their last evaluation.
  Rates operator()(const State& state, double end);
  /// |M^-1 R' df/dv R|_M of the points without walls, such as a bit, at `state` [1/s]; 0 if there
  /// are none. These batches lose the results of their last evaluation.
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
