// SPDX-License-Identifier: BSD-3-Clause
#include "transient/accuracy/LargestRate.hpp"

#include <algorithm>
#include <cmath>

#include "common/Index.hpp"
#include "linalg/DenseDecompositions.hpp"

namespace tooljoint::transient {
namespace {

/// Arnoldi steps: they give the norm of a string of 1e5 dofs within 1 %.
constexpr int arnoldiSteps = 60;
/// Times at which laws are evaluated to find their largest value.
constexpr int lawSamples = 1000;
/// Depth of contact [m] at which walls are evaluated: laws that stiffen with depth have no
/// stiffness at zero depth.
constexpr double depth = 1e-3;
/// Walls farther away than this [m] are ignored; limit of distance evaluations on the way to a
/// wall.
constexpr double farthest = 1e3;
constexpr int mostLooks = 200;
/// A clearance below this [m] is contact.
constexpr double touching = 1e-9;
/// A residual vector shorter than this, relative to the earlier ones, is zero.
constexpr double negligibleResidual = 1e-12;
/// Newton's method for a rate ends when the relative change is below this, or after this many
/// iterations.
constexpr double rateTolerance = 1e-9;
constexpr int mostRateIterations = 100;

/// Largest root of r^3 = g r^2 + k r + c with non-negative coefficients: Newton's method from
/// above, where it decreases monotonically.
double largestRoot(double g, double k, double c) {
  double r = g + std::sqrt(k) + std::cbrt(c);
  for (int i = 0; r > 0.0 && i < mostRateIterations; ++i) {
    const double step = (((r - g) * r - k) * r - c) / ((3.0 * r - 2.0 * g) * r - k);
    r -= step;
    if (!(step > rateTolerance * r)) break;
  }
  return r;
}

}  // namespace

LargestRate::Rates LargestRate::operator()(const State& state, double end) {
  const auto laws = largestLaws(state.t, end);
  model_.setTime(state.t);
  evaluatePoints(state, Which::All);
  const auto sum = [&](const MatrixSum& matrices, std::vector<double> Tangents::*points) {
    return [this, &matrices, &laws, points](const Vector& x, Vector& y) {
      y.setZero();
      for (const auto& term : matrices.terms())
        term.product.addTo(term.values.data(), x.data(), y.data(), laws[at(term.law)]);
      subtractPoints(points, x, y);
    };
  };
  const double k = norm(sum(model_.timed().stiffness(), &Tangents::position));
  const double g = norm(sum(model_.timed().damping(), &Tangents::velocity));
  const double contact = normOfPoints(&Tangents::position), c = normOfPoints(&Tangents::state);
  return {largestRoot(g, k, c) + model_.cut().largest(ofStates_), std::sqrt(contact)};
}

double LargestRate::ofDampingLaws(const State& state) {
  if (std::all_of(model_.points().begin(), model_.points().end(),
                  [](const PointBatch& batch) { return batch.law().hasWalls(); }))
    return 0.0;
  model_.setTime(state.t);
  evaluatePoints(state, Which::WithoutWalls);
  return normOfPoints(&Tangents::velocity);
}

double LargestRate::normOfPoints(std::vector<double> Tangents::*points) const {
  return norm([this, points](const Vector& x, Vector& y) {
    y.setZero();
    subtractPoints(points, x, y);
  });
}

/// Value of each law at its largest absolute value.
std::vector<double> LargestRate::largestLaws(double begin, double end) const {
  std::vector<double> largest;
  for (const auto& law : model_.source().laws) {
    double value = law.value(begin);
    for (int i = 1; i <= lawSamples; ++i) {
      const double next = law.value(begin + (end - begin) * i / lawSamples);
      if (std::abs(next) > std::abs(value)) value = next;
    }
    largest.push_back(value);
  }
  return largest;
}

void LargestRate::evaluatePoints(const State& state, Which which) {
  model_.states().bind(state.x.data());
  tangents_.clear();
  ofStates_ = 0;
  for (auto& batch : model_.points()) {
    const int w = batch.width();
    const std::size_t entries = at(batch.points() * w) * at(w);
    const std::vector<double> none(entries, 0.0);
    tangents_.push_back({none, none, none});
    if (which == Which::WithoutWalls && batch.law().hasWalls()) continue;
    batch.gatherAll(state.q.data(), state.v.data());
    const Vector start = Eigen::Map<const Vector>(batch.d(), batch.points() * w);
    Vector d = start;
    for (int p : batch.everyPoint()) {
      evaluate(batch, p, state.t, d);
      takeLarger(p, tangents_.back());
    }
    for (int p : batch.everyPoint())
      for (int k = p * w; k < p * w + batch.law().reach(); ++k)
        for (const double way : {1.0, -1.0}) {
          if (goToWall(batch, p, k, way, d)) {
            d[k] += way * depth;
            evaluate(batch, p, state.t, d);
            keepNormalDamping();
            takeLarger(p, tangents_.back());
          }
          d[k] = start[k];
        }
  }
}

/// Moves a point along one of its coordinates until it touches; false if there is no wall in this
/// direction. The clearance never decreases by more than the displacement of the point, so moving
/// by the clearance does not pass a wall.
bool LargestRate::goToWall(const PointBatch& batch, int point, int coordinate, double way,
                           Vector& d) {
  gap_.resize(batch.points());
  const std::vector<int> one{point};
  for (int looks = 0; looks < mostLooks && std::abs(d[coordinate]) < farthest; ++looks) {
    batch.law().clearanceLeft(one, d.data(), gap_.data());
    if (!(gap_[point] > touching)) return true;
    d[coordinate] += way * gap_[point];
  }
  return false;
}

void LargestRate::evaluate(PointBatch& batch, int point, double t, const Vector& d) {
  const int w = batch.width();
  force_.resize(w);
  position_.resize(w, w);
  velocity_.resize(w, w);
  batch.evaluateOne(t, point, d.data() + point * w, batch.v() + point * w, force_.data(),
                    position_.data(), velocity_.data());
  state_.setZero(w, w);
  if (batch.states() != nullptr && batch.states()->rated() > 0) addStates(*batch.states(), point);
}

/// Adds the effect of the states to the tangents of the last evaluation.
void LargestRate::addStates(const PointStates& states, int point) {
  const auto tangents = states.tangentsOf(point);
  position_ += tangents.fx * tangents.gv;
  state_ = tangents.fx * tangents.gd;
  ofStates_ = std::max(ofStates_, Matrix(tangents.gx).norm());
}

/// Friction grows with the force, so df/dv at a wall 1 mm deep is not that of the motion. Only the
/// part of df/dv along the normal n = (df/dd)'f / |(df/dd)'f| is kept.
void LargestRate::keepNormalDamping() {
  Vector n = position_.transpose() * force_;
  if (!(n.norm() > 0)) return;
  n.normalize();
  velocity_ = n.dot(velocity_ * n) * n * n.transpose();
}

/// Keeps the tangents of the last evaluation if they are larger than the earlier ones.
void LargestRate::takeLarger(int point, Tangents& tangents) const {
  const auto take = [&](const Square& found, std::vector<double>& kept) {
    Eigen::Map<Square> before(kept.data() + point * found.size(), found.rows(), found.cols());
    if (found.norm() > before.norm()) before = found;
  };
  take(position_, tangents.position);
  take(velocity_, tangents.velocity);
  take(state_, tangents.state);
}

/// y -= R' J R x
void LargestRate::subtractPoints(std::vector<double> Tangents::*which, const Vector& x,
                                 Vector& y) const {
  for (std::size_t b = 0; b < tangents_.size(); ++b) {
    const auto& batch = model_.points()[b];
    const int w = batch.width();
    for (int p : batch.everyPoint()) {
      const double* J = (tangents_[b].*which).data() + p * w * w;
      for (int j = 0; j < w; ++j) {
        const double d = batch.rowTimesVector(p * w + j, x.data());
        if (d == 0.0) continue;
        for (int i = 0; i < w; ++i) batch.addRow(p * w + i, -J[i * w + j] * d, y.data());
      }
    }
  }
}

/// |M^-1 A|_M by Arnoldi's method: M^-1 A V = V+ H with V'MV = I. |H| is a lower bound that
/// converges with the number of steps. The first vector is M^-1 x with an unstructured x, so that
/// masses of very different size do not hide the stiff ones.
template <class Product>
double LargestRate::norm(const Product& times) const {
  const int n = model_.size(), steps = std::min(model_.wholeSize(), arnoldiSteps);
  Matrix V(n, steps + 1), MV(n, steps + 1);
  Matrix H = Matrix::Zero(steps + 1, steps);
  Vector x(n), y(n);
  for (int i = 0; i < n; ++i) {
    const int number = model_.numberInWhole(i);
    x[i] = std::sin(1.0 + 12.9898 * number) + ((number % 2) == 0 ? 1.0 : -1.0);
  }
  model_.cut().divide(x.data());
  mass_.solve(x.data());
  for (int k = 0;; ++k) {
    y.setZero();
    model_.addMass(x.data(), y.data());
    const double length = std::sqrt(std::max(0.0, model_.dot(x, y)));
    if (k > 0) H(k, k - 1) = length;
    if (k == steps || !(length > negligibleResidual * std::max(1.0, H.norm()))) break;
    V.col(k) = x / length;
    MV.col(k) = y / length;
    times(V.col(k), x);
    mass_.solve(x.data());
    for (int pass = 0; pass < 2; ++pass) {
      Vector h = MV.leftCols(k + 1).transpose() * x;
      model_.cut().reduce(nullptr, 0, h.data(), k + 1);
      H.col(k).head(k + 1) += h;
      x -= V.leftCols(k + 1) * h;
    }
  }
  return linalg::singularValues(H).values[0];
}

}  // namespace tooljoint::transient
