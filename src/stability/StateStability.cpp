// SPDX-License-Identifier: BSD-3-Clause
#include "stability/StateStability.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "common/Index.hpp"
#include "common/Parallel.hpp"
#include "common/Text.hpp"
#include "common/report/EvaluationCounters.hpp"
#include "common/report/Log.hpp"
#include "common/report/StageTimes.hpp"
#include "coupling/CoupledModes.hpp"
#include "coupling/input/ComponentAxes.hpp"
#include "estimate/ModeComparison.hpp"
#include "linalg/ComplexProduct.hpp"
#include "linalg/DynamicStiffness.hpp"
#include "linalg/SparseProducts.hpp"
#include "linalg/trilinos/DividedModes.hpp"
#include "linalg/trilinos/EigenChecks.hpp"
#include "linalg/trilinos/EigenSolver.hpp"
#include "linalg/trilinos/SemidefiniteModes.hpp"
#include "model/HarmonicTangent.hpp"
#include "reduction/part/Partition.hpp"
#include "reduction/vectors/ModalVectors.hpp"
#include "stability/ReleasedStates.hpp"

namespace tooljoint::stability {

namespace {

/// Modes of the symmetric tangent for the projection of the damped equations: number beyond those
/// of negative pivots, and limit. Models with few dofs use more, for this many entries of all
/// shapes.
constexpr int modesBeyond = 12, mostModes = 60, mostBeyond = 80;
constexpr int entriesOfShapes = 200000;
/// For models with at most this many dofs all modes are used.
constexpr int fewDofs = 60;
/// Growing modes of the projection that are checked in the whole equations, without moving states.
constexpr std::size_t mostRefined = 4;
/// Part of the fastest growth above which growth counts as fast.
constexpr double nearly = 0.8;
/// Factor on a first-order estimate of the effect of states on a mode.
constexpr double mayBe = 2.0;
/// Smallest remainder of a vector, relative to its size, that is independent of the earlier ones.
constexpr double independent = 1e-6;
/// Accuracy of these modes: they only span a basis, and growing modes found in it are refined.
constexpr double basisAccuracy = 1e-4;
/// Shift of the modes of a state with a motion without any restoring force [1/s2]. With a shift as
/// small as the growth to be found, that motion would degrade the accuracy of all others.
constexpr double floatingShift = -1.0;
/// Growth below this part of |s| is within the accuracy of s.
constexpr double noGrowth = 1e-7;
/// A motion with |Im s| below this part of Re s is no vibration: it grows by e^60 in half a period.
/// A divergence under torque or rotation has such frequencies.
constexpr double vibrating = 0.05;
/// Stiffness between components below this part of the rows: they are nearly independent.
constexpr double alone = 0.1;
/// Skew stiffness below this part of the rows is rounding.
constexpr double skewRounding = 1e-12;
/// Rate above those of all motions with mass [1/s].
constexpr double fast = 1e8;
/// Smallest part of the largest displacement that counts as a separate deflection.
constexpr double deflection = 0.05;

bool isGrowth(Complex s) { return s.real() > std::max(slowestGrowth, noGrowth * std::abs(s)); }

/// Largest absolute entry of each row.
Vector largestOfRows(const Sparse& K) {
  Vector rows = Vector::Zero(K.rows());
  for (int i = 0; i < K.outerSize(); ++i)
    for (Sparse::InnerIterator it(K, i); it; ++it)
      rows[i] = std::max(rows[i], std::abs(it.value()));
  return rows;
}

/// Whether the damping feeds energy into a motion: the symmetric part of C + 2 slowestGrowth (M +
/// K/fast^2) has a negative eigenvalue. K replaces the mass at massless dofs.
bool feeds(const estimate::Linearised& tangent, const Sparse& symmetricStiffness) {
  const Sparse C = reduction::symmetricPart(tangent.damping);
  if (linalg::isZero(C)) return false;
  const Sparse inertia = tangent.mass + 1.0 / (fast * fast) * symmetricStiffness;
  return linalg::negativeEigenvalues(Sparse(C + 2.0 * slowestGrowth * inertia)).value_or(1) > 0;
}

/// Whether motions can grow without negative pivots: K has a skew part, friction acts at the
/// points, or the damping feeds a motion.
bool canFlutter(const model::SecondOrderModel& model, const estimate::Linearised& tangent,
                const Sparse& symmetricStiffness, double t) {
  if (Sparse(tangent.damping - model.dampingAt(t)).squaredNorm() > 0.0) return true;
  if (feeds(tangent, symmetricStiffness)) return true;
  const Sparse transposed = tangent.stiffness.transpose(), skew = tangent.stiffness - transposed;
  const Vector rows = largestOfRows(tangent.stiffness);
  for (int i = 0; i < skew.outerSize(); ++i)
    for (Sparse::InnerIterator it(skew, i); it; ++it)
      if (std::abs(it.value()) > skewRounding * std::sqrt(rows[i] * rows[it.col()])) return true;
  return false;
}

/// Whether these dofs are nearly independent of the other components, as torsion and stretch of a
/// string are. Deflections in bending are not independent of the rotations.
bool standAlone(const model::SecondOrderModel& model, const Sparse& K, const Vector& rows,
                const std::vector<int>& dofs) {
  const int component = model.dofs[at(dofs.front())].component;
  for (const int i : dofs)
    for (Sparse::InnerIterator it(K, i); it; ++it)
      if (model.dofs[at(static_cast<int>(it.col()))].component != component &&
          std::abs(it.value()) > alone * std::sqrt(rows[i] * rows[it.col()]))
        return false;
  return true;
}

/// Components that point laws couple unsymmetrically, such as the advance and rotation of a cutting
/// bit.
std::map<int, std::set<int>> skewPairs(const model::SecondOrderModel& model, const Vector& rows,
                                       const Sparse& pointStiffness) {
  std::map<int, std::set<int>> pairs;
  const Sparse transposed = pointStiffness.transpose(), skew = pointStiffness - transposed;
  for (int i = 0; i < skew.outerSize(); ++i)
    for (Sparse::InnerIterator it(skew, i); it; ++it) {
      const auto &a = model.dofs[at(i)], &b = model.dofs[at(static_cast<int>(it.col()))];
      if (a.component != b.component &&
          std::abs(it.value()) > skewRounding * std::sqrt(rows[i] * rows[it.col()]))
        pairs[a.component].insert(b.component);
    }
  return pairs;
}

/// Lowest modes of single components (all other dofs held): of those on which a point law acts in
/// the direction of motion (rows of C = -df/dv with a negative diagonal), and of those that one
/// couples unsymmetrically. The lowest modes of a long string are bending modes; torsional modes
/// driven by a bit law or by falling friction, and axial modes of a bit, are far above them.
std::vector<Matrix> modesOfDrivenComponents(const model::SecondOrderModel& model,
                                            const Sparse& symmetric, const Sparse& mass,
                                            const Sparse& pointDamping,
                                            const Sparse& pointStiffness) {
  std::map<int, std::vector<int>> components;
  std::map<int, bool> driven;
  for (int i = 0; i < model.size(); ++i) {
    const auto& dof = model.dofs[at(i)];
    if (dof.kind != model::DofLabel::Kind::Physical) continue;
    components[dof.component].push_back(i);
    if (pointDamping.coeff(i, i) < 0.0) driven[dof.component] = true;
  }
  const Vector rows = largestOfRows(symmetric);
  std::set<int> isolated;
  for (const auto& [component, dofs] : components)
    if (standAlone(model, symmetric, rows, dofs)) isolated.insert(component);
  for (const auto& [component, others] : skewPairs(model, rows, pointStiffness))
    for (const int other : others)
      if (isolated.count(other) > 0) driven[component] = true;
  std::vector<Matrix> all;
  for (const auto& [component, dofs] : components) {
    if (!driven[component] || isolated.count(component) == 0) continue;
    const Sparse K = reduction::block(symmetric, dofs, dofs),
                 M = reduction::block(mass, dofs, dofs);
    linalg::EigenOptions options;
    options.tolerance = basisAccuracy;
    // a bit law may act more strongly than the resistance of the component alone
    if (linalg::eigenvaluesBelow(K, M, floatingShift) == 0) options.shift = floatingShift;
    const auto modes =
        linalg::lowestFiniteModes(K, M, std::min(sizeOf(dofs), modesBeyond), options);
    Matrix shapes = Matrix::Zero(model.size(), modes.count());
    shapes(dofs, Eigen::all) = modes.vectors;
    all.push_back(std::move(shapes));
  }
  return all;
}

/// These columns and the independent parts of further ones, orthonormal in M.
Matrix joined(const Sparse& mass, const Matrix& first, const std::vector<Matrix>& more) {
  if (more.empty()) return first;
  reduction::OrthonormalSet set(mass, independent, "The modes of the static state");
  const auto add = [&](const Matrix& columns) {
    for (Eigen::Index j = 0; j < columns.cols(); ++j) set.add(columns.col(j));
  };
  add(first);
  for (const auto& columns : more) add(columns);
  return set.basis();
}

/// Growing modes of the equations projected on the columns of `basis`, the fastest first. With
/// moving states also the `others` least damped modes that the states may make grow.
std::vector<linalg::DampedMode> growingModes(const estimate::Linearised& tangent,
                                             const Matrix& basis, std::size_t others,
                                             const ReleasedStates* released) {
  const auto projected = [&](const Sparse& A) {
    return Matrix(basis.transpose() * Matrix(A * basis));
  };
  const auto modes = linalg::dampedModes(projected(tangent.mass), projected(tangent.damping),
                                         projected(tangent.stiffness));
  std::vector<Eigen::Index> upper;
  for (Eigen::Index j = 0; j < modes.values.size(); ++j)
    if (modes.values[j].imag() >= 0.0) upper.push_back(j);
  std::sort(upper.begin(), upper.end(), [&](Eigen::Index a, Eigen::Index b) {
    return modes.values[a].real() > modes.values[b].real();
  });
  std::vector<linalg::DampedMode> growing;
  for (const auto j : upper) {
    const bool grows = isGrowth(modes.values[j]);
    if (!grows && others == 0) break;
    linalg::DampedMode mode{modes.values[j], basis.cast<Complex>() * modes.vectors.col(j)};
    if (!grows && mode.s.real() + mayBe * released->reach(mode) <= 0.0) continue;
    if (!grows) --others;
    growing.push_back(std::move(mode));
  }
  return growing;
}

/// Number of modes of the whole equations nearest to a projected one that Newton's method does not
/// refine.
constexpr int nearestModes = 6;

/// Mode of the whole equations for a growing mode of the projection: the refined mode, or else the
/// fastest growing one of those nearest to it. Empty if these are not found.
std::optional<linalg::DampedMode> ofWholeEquations(const estimate::Linearised& tangent,
                                                   const linalg::DampedMode& ritz) {
  const Sparse &M = tangent.mass, &C = tangent.damping, &K = tangent.stiffness;
  if (auto exact = linalg::refine(M, C, K, ritz)) return exact;
  try {
    const auto near = linalg::dampedModesNear(
        M, C, K, {{ritz.s.real(), std::abs(ritz.s.imag())}, 0.0, nearestModes});
    if (near.values.size() == 0) return std::nullopt;
    Eigen::Index fastest = 0;
    near.values.real().maxCoeff(&fastest);
    return linalg::DampedMode{near.values[fastest], near.vectors.col(fastest)};
  } catch (const ConvergenceError&) {
    return std::nullopt;
  }
}

struct GrowingMode {
  linalg::DampedMode mode;
  bool refined;  ///< with the whole equations
};

/// Decaying modes with held states that are followed nevertheless: limit, and limit times the
/// number of dofs, because each takes about twenty factorisations.
constexpr std::size_t mostReleased = 24;
constexpr int dofsReleased = 60000;

/// Whether the growth of a motion without work is rounding: |s|^2 |phi'M phi| is of the size of the
/// rounding error of phi'K phi.
bool isRigidMotion(const estimate::Linearised& tangent, const linalg::DampedMode& mode) {
  const Vector size = mode.shape.cwiseAbs();
  const Sparse absolute = tangent.stiffness.cwiseAbs();
  return std::norm(mode.s) * std::abs(mode.shape.dot(linalg::times(tangent.mass, mode.shape))) <=
         linalg::roundingOf(tangent.stiffness) * size.dot(absolute * size);
}

/// The mode of lowest frequency among those that grow nearly as fast as the fastest one, because
/// overtones of a string driven by friction grow as fast as its fundamental. `most` modes of the
/// projection are refined, and more until one grows. Empty if the whole equations have no growing
/// mode.
std::optional<GrowingMode> mostTelling(const estimate::Linearised& tangent,
                                       std::vector<linalg::DampedMode> ritz, std::size_t most,
                                       const ReleasedStates* released) {
  if (ritz.empty()) return std::nullopt;
  const double fastest = ritz.front().s.real();
  if (released == nullptr)
    std::sort(ritz.begin() + 1, ritz.end(), [&](const auto& a, const auto& b) {
      const bool x = a.s.real() >= nearly * fastest, y = b.s.real() >= nearly * fastest;
      if (x != y) return x;
      return x ? std::abs(a.s.imag()) < std::abs(b.s.imag()) : a.s.real() > b.s.real();
    });
  std::vector<GrowingMode> found;
  for (std::size_t i = 0; i < ritz.size() && (i < most || found.empty()); ++i) {
    auto exact = ofWholeEquations(tangent, ritz[i]);
    if (exact && released != nullptr)
      if (auto moving = (*released)(*exact)) exact = std::move(moving);
    const GrowingMode one{exact ? *exact : ritz[i], exact.has_value()};
    if (isGrowth(one.mode.s) && !isRigidMotion(tangent, one.mode)) found.push_back(one);
  }
  if (found.empty()) return std::nullopt;
  double rate = 0;
  for (const auto& one : found) rate = std::max(rate, one.mode.s.real());
  const GrowingMode* best = nullptr;
  for (const auto& one : found)
    if (one.mode.s.real() >= nearly * rate &&
        (best == nullptr || std::abs(one.mode.s.imag()) < std::abs(best->mode.s.imag())))
      best = &one;
  return *best;
}

/// A chain with fewer dofs per rank than this is computed by all ranks alike.
constexpr int fewestDofs = 2000;

/// Share of this rank in the modes of a model whose dofs are ordered by nodes, each coupled only to
/// its adjacent nodes. Null for other models, on one rank, and if the chain is too short.
std::shared_ptr<const linalg::ChainShare> shareOf(const model::SecondOrderModel& model,
                                                  const Sparse& K, const Sparse& M) {
  std::vector<int> nodeOf;
  for (int i = 0; i < model.size(); ++i) {
    const bool same = i > 0 && model.dofs[at(i)].entity == model.dofs[at(i - 1)].entity;
    nodeOf.push_back(i == 0 ? 0 : nodeOf.back() + (same ? 0 : 1));
  }
  for (const Sparse* matrix : {&K, &M})
    for (int i = 0; i < matrix->outerSize(); ++i)
      for (Sparse::InnerIterator it(*matrix, i); it; ++it)
        if (std::abs(nodeOf[at(it.col())] - nodeOf[at(i)]) > 1) return nullptr;
  return linalg::ChainShare::of(linalg::firstRows(nodeOf), fewestDofs);
}

/// Translations [m] below this part of the largest entry [rad] are part of a torsional mode.
constexpr double leastShare = 1e-3;

/// Outline of the translations, or of the rotations, of a shape; empty if they are no part of it.
ShapeOutline outlineOf(const model::SecondOrderModel& model, const Vector& shape,
                       coupling::ComponentKind kind) {
  using Motion = Eigen::Matrix<double, 1, 6>;
  const auto& names = model.componentNames;
  std::map<std::int64_t, Motion> nodes;
  for (std::size_t i = 0; i < model.dofs.size(); ++i) {
    const auto& dof = model.dofs[i];
    if (dof.kind != model::DofLabel::Kind::Physical || dof.component >= 6) continue;
    if (coupling::kindOf(names[static_cast<std::size_t>(dof.component)]) != kind) continue;
    auto& d = nodes.try_emplace(dof.entity, Motion::Zero()).first->second;
    d[dof.component] = shape[static_cast<Eigen::Index>(i)];
  }
  ShapeOutline found;
  if (nodes.empty()) return found;
  const auto widest = std::max_element(
      nodes.begin(), nodes.end(),
      [](const auto& a, const auto& b) { return a.second.squaredNorm() < b.second.squaredNorm(); });
  const double largest = widest->second.norm();
  if (largest < leastShare * shape.cwiseAbs().maxCoeff()) return found;
  double last = 0.0;
  for (const auto& [node, d] : nodes) {
    const double along = d.dot(widest->second) / largest;
    if (std::abs(along) < deflection * largest) continue;
    if (along * last <= 0.0) ++found.halfWaves;
    last = along;
  }
  Eigen::Index component = 0;
  widest->second.cwiseAbs().maxCoeff(&component);
  found.node = widest->first;
  found.component = names[static_cast<std::size_t>(component)];
  return found;
}

ShapeOutline outlineOf(const model::SecondOrderModel& model, const Vector& shape) {
  using coupling::ComponentKind;
  const auto moved = outlineOf(model, shape, ComponentKind::Translation);
  return moved.node != 0 ? moved : outlineOf(model, shape, ComponentKind::Rotation);
}

}  // namespace

std::string withoutStates(const std::vector<std::string>& held) {
  if (held.empty()) return "";
  return " The states of " + quotedList(held) +
         " are held where modes are sought, and followed from there for the least damped ones "
         "alone: other growth by them (by the delay of a cutting bit, by the control of a drive) "
         "is "
         "not seen. The motion shows it.";
}

void warnOfHeldStates(const model::SecondOrderModel& model, double t) {
  const auto names = model::setsWithMovingStates(model, t);
  if (!names.empty())
    log::warn(
        "The states of " + quotedList(names) +
        " are held in the damped modes: stiffness and damping by them (by the delay of a "
        "cutting bit, by the control of a drive) are left out, so that modes may grow here and "
        "decay in the motion, or the other way round. The motion shows it, and the responses "
        "to harmonic loads (tooljoint response) have it.");
}

StateStability assess(const model::SecondOrderModel& model, double t) {
  const Stage stage("stability of the static state");
  StateStability found;
  found.held = model::setsWithMovingStates(model, t);
  const auto tangent = estimate::linearise(model, t);
  const Sparse symmetric =
      reduction::symmetricPart(model.stiffnessAt(t)) + coupling::normalStiffness(model);
  found.negativePivots =
      linalg::eigenvaluesBelow(symmetric, tangent.mass, -slowestGrowth * slowestGrowth);
  const bool flutters = canFlutter(model, tangent, symmetric, t);
  if (found.negativePivots == 0 && !flutters) return found;
  linalg::EigenOptions options;
  options.tolerance = basisAccuracy;
  if (found.negativePivots == 0) {
    const double slowest = slowestGrowth * slowestGrowth;
    const bool floats = linalg::eigenvaluesBelow(symmetric, tangent.mass, slowest) > 0;
    options.shift = floats ? floatingShift : -4 * slowest;  // below all eigenvalues
  }
  const int beyond = std::clamp(entriesOfShapes / model.size(), modesBeyond, mostBeyond);
  const int wanted = model.size() <= std::max(fewDofs, beyond)
                         ? model.size()
                         : std::min(std::max(mostModes, beyond), found.negativePivots + beyond);
  const auto share = parallel::size() > 1 && !linalg::hasMasslessMotion(tangent.mass)
                         ? shareOf(model, symmetric, tangent.mass)
                         : nullptr;
  const auto modes =
      share ? linalg::lowestModesOfChain(symmetric, tangent.mass, wanted, options, share)
            : linalg::lowestFiniteModes(symmetric, tangent.mass, wanted, options);
  const auto rigid = linalg::areRounding(modes.values, modes.vectors, symmetric);
  for (Eigen::Index j = 0; j < modes.values.size(); ++j)
    if (rigid[at(j)] != 0 && modes.values[j] < -slowestGrowth * slowestGrowth)
      --found.negativePivots;
  const Matrix basis =
      wanted == model.size()
          ? modes.vectors
          : joined(tangent.mass, modes.vectors,
                   modesOfDrivenComponents(model, symmetric, tangent.mass,
                                           tangent.damping - model.dampingAt(t),
                                           tangent.stiffness - model.stiffnessAt(t)));
  found.examined = static_cast<int>(basis.cols());
  count("modes of the static state", found.examined);
  if (found.negativePivots > 0) found.staticGrowthRate = std::sqrt(std::max(0.0, -modes.values[0]));
  if (found.negativePivots == 0 && !flutters) return found;
  const bool follow = !found.held.empty() && model::setsWithUnknownStates(model, t).empty();
  const auto others =
      follow ? std::min<std::size_t>(mostReleased, at(dofsReleased / model.size())) : 0;
  const ReleasedStates states(model, t, tangent);
  const auto* released = follow ? &states : nullptr;
  const auto growing = growingModes(tangent, basis, others, released);
  const auto worst = mostTelling(tangent, growing, std::max(mostRefined, others), released);
  if (!worst) return found;
  found.refined = worst->refined;
  found.growthRate = worst->mode.s.real();
  if (std::abs(worst->mode.s.imag()) > vibrating * worst->mode.s.real())
    found.frequency = std::abs(worst->mode.s.imag()) / constants::twoPi;
  // at the phase of its largest entry
  Eigen::Index largest = 0;
  worst->mode.shape.cwiseAbs().maxCoeff(&largest);
  found.shape = (worst->mode.shape / worst->mode.shape[largest]).real();
  found.shape /= found.shape.cwiseAbs().maxCoeff();
  found.outline = outlineOf(model, found.shape);
  return found;
}

}  // namespace tooljoint::stability
