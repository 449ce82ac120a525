// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drillstring/buckling/BucklingState.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "common/Constants.hpp"
#include "common/Index.hpp"
#include "linalg/DenseDecompositions.hpp"
#include "substructures/beam/BeamMatrices.hpp"
#include "substructures/beam/NodalDofs.hpp"
#include "substructures/equilibrium/Equilibrium.hpp"
#include "substructures/softstring/Buckling.hpp"
#include "substructures/well/Frames.hpp"

namespace tooljoint::drillstring {

namespace nodal = beam::nodal;

namespace {

/// Deflections below this fraction of the clearance count as none.
constexpr double straight = 0.05;
/// The string winds if it is at least this fraction of the clearance off the axis.
constexpr double offAxis = 0.5;
/// Fraction of the total turning that has the same sense in a helix.
constexpr double oneWay = 0.9;
/// The middle half of the compressed part, as fractions of its length.
constexpr double middleBegin = 0.25, middleEnd = 0.75;
/// Largest compression of a sinusoidal state relative to its onset (Mitchell 1997).
constexpr double lateralLimit = 2.8;
/// Largest weight along the hole for the formula of a hinged pipe, as a fraction of its load.
constexpr double littleAlong = 0.1;
/// Holes with less inclination have no sides [rad].
constexpr double vertical = 1e-3;
/// Relative tolerance of equality.
constexpr double same = 1e-9;

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

bool uniform(const std::vector<double>& values) {
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return *most - *least <= same * std::abs(*most);
}

/// Angle from a to b, in (-pi, pi].
double angle(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
}

/// Depths at which the deflection changes sign between sections where it exceeds `least`.
std::vector<double> zeros(const std::vector<double>& depth, const Vector& deflection,
                          double least) {
  std::vector<double> found;
  double last = 0.0, crossing = 0.0;
  for (int n = 0; n < static_cast<int>(deflection.size()); ++n) {
    const double here = deflection(n);
    if (n > 0 && here * deflection(n - 1) < 0.0)
      crossing = depth[at(n - 1)] +
                 (depth[at(n)] - depth[at(n - 1)]) * deflection(n - 1) / (deflection(n - 1) - here);
    else if (here == 0.0)
      crossing = depth[at(n)];
    if (std::abs(here) <= least) continue;
    if (here * last < 0.0) found.push_back(crossing);
    last = here;
  }
  return found;
}

}  // namespace

BucklingMeasure::BucklingMeasure(const Scene& scene, const path::PathState& path,
                                 const equilibrium::StaticInput& input,
                                 const equilibrium::StaticProblem& problem)
    : scene_(scene), path_(path), input_(input), problem_(problem), depth_(scene.string.depths()) {
  const double mud = scene.mud ? mud::readProperties(scene.list().sublist("Mud")).density : 0.0;
  const double gravity = loads::acceleration(scene.loads).z();
  for (int e = 0; e < scene.string.elementCount(); ++e) {
    const auto& section = scene.string.elements[at(e)].section();
    weight_.push_back((section.massPerLength() - mud * section.area()) * gravity);
    rigidity_.push_back(section.youngModulus() * std::min(section.inertiaX(), section.inertiaY()));
    clearance_.push_back(scene.well.boreRadius(0.5 * (depth_[at(e)] + depth_[at(e + 1)])) -
                         section.outerRadius());
    const auto& element = input.elements[at(e)];
    const beam::Matrix12& r = element.slopes;
    unitAxial_.push_back(r.transpose() * element.formulation->geometricAxial() * r);
  }
}

Matrix BucklingMeasure::toSides(const Vector& displacement) const {
  Matrix sides(2, scene_.string.nodeCount());
  for (int n = 0; n < scene_.string.nodeCount(); ++n) {
    const Matrix3& frame = path_.frame[at(n)];
    const Vector3 high = well::highSide(frame.col(2));
    const Vector3 moved =
        frame.leftCols<2>() * displacement.segment<2>(nodal::perNode * n + nodal::u);
    sides.col(n) << high.dot(moved), frame.col(2).cross(high).dot(moved);
  }
  return sides;
}

/// 1/2 D' K_gF D, K_gF that of a unit tension: 1/2 int u'^2 + v'^2 ds.
double BucklingMeasure::shortening(int element, const Vector& displacement) const {
  const beam::Vector12 d = displacement.segment<12>(nodal::perNode * element);
  return 0.5 * d.dot(unitAxial_[at(element)] * d);
}

BucklingState BucklingMeasure::state(double weight, const Vector& displacement) const {
  BucklingState state;
  state.weight = weight;
  const auto described = equilibrium::describe(input_, problem_, displacement);
  state.compression = -described.axialForce;
  state.contactForce = described.normalForce;
  state.contacts = described.contactNodes;
  state.largestContact = described.maxNormalForce;
  state.totalContact = described.totalNormalForce;
  state.displacement = toSides(displacement);
  state.lateral = state.displacement.colwise().norm().maxCoeff();
  for (int e = 0; e < scene_.string.elementCount(); ++e)
    state.shortening += shortening(e, displacement);
  state.bitAdvance =
      displacement(nodal::perNode * (scene_.string.nodeCount() - 1) + nodal::w) - state.shortening;
  addShape(state);
  addMiddle(displacement, state);
  return state;
}

bool BucklingMeasure::liesLow() const {
  return scene_.well.inclination(depth_.back()) > vertical &&
         loads::acceleration(scene_.loads).norm() > 0.0;
}

void BucklingMeasure::addShape(BucklingState& state) const {
  const Matrix& d = state.displacement;
  const double clearance = *std::max_element(clearance_.begin(), clearance_.end());
  Eigen::Vector2d side(0.0, 1.0);
  if (!liesLow()) side = linalg::symmetricPairs(d * d.transpose()).vectors.col(1);
  const Vector deflection = d.transpose() * side;
  const double most = deflection.cwiseAbs().maxCoeff();
  if (most > straight * clearance) {
    const auto crossings = zeros(depth_, deflection, straight * most);
    state.halfWaves = static_cast<int>(crossings.size()) + 1;
    std::vector<double> lengths;
    for (std::size_t i = 1; i < crossings.size(); ++i)
      lengths.push_back(crossings[i] - crossings[i - 1]);
    if (!lengths.empty()) state.halfWaveLength = median(lengths);
  }
  double turned = 0.0;
  for (int n = 1; n < static_cast<int>(d.cols()); ++n)
    if (d.col(n - 1).norm() > offAxis * clearance && d.col(n).norm() > offAxis * clearance)
      turned += angle(d.col(n - 1), d.col(n));
  state.turns = turned / constants::twoPi;
}

double BucklingMeasure::neutralDepth(const BucklingState& state) const {
  const int last = scene_.string.elementCount() - 1;
  if (!(state.compression(last) > 0.0)) return 0.0;
  int e = last;
  while (e > 0 && state.compression(e - 1) > 0.0) --e;
  return depth_[at(e)];
}

void BucklingMeasure::addMiddle(const Vector& displacement, BucklingState& state) const {
  auto& middle = state.middle;
  const double top = neutralDepth(state), L = depth_.back() - top;
  double length = 0.0, net = 0.0, all = 0.0;
  bool winds = true;
  for (int e = 0; e < scene_.string.elementCount(); ++e) {
    const double centre = 0.5 * (depth_[at(e)] + depth_[at(e + 1)]);
    if (centre < top + middleBegin * L || centre > top + middleEnd * L) continue;
    const double l = scene_.string.elements[at(e)].length();
    const double F = std::max(0.0, state.compression(e)), r = clearance_[at(e)],
                 EI = rigidity_[at(e)];
    length += l;
    middle.compression += l * state.compression(e);
    middle.contactForce += 0.5 * (state.contactForce(e) + state.contactForce(e + 1));
    middle.helicalContactForce += l * softstring::helicalSideForce(F, EI, r);
    middle.shortening += shortening(e, displacement);
    middle.helicalShortening += l * r * r * F / (4.0 * EI);
    middle.helicalPitch += l * (F > 0.0 ? constants::twoPi * std::sqrt(2.0 * EI / F) : 0.0);
    const auto upper = state.displacement.col(e), lower = state.displacement.col(e + 1);
    if (std::min(upper.norm(), lower.norm()) < offAxis * r) {
      winds = false;
      continue;
    }
    const double turned = angle(upper, lower);
    net += turned;
    all += std::abs(turned);
  }
  if (!(length > 0.0)) return;
  for (double* mean : {&middle.compression, &middle.contactForce, &middle.helicalContactForce,
                       &middle.shortening, &middle.helicalShortening, &middle.helicalPitch})
    *mean /= length;
  if (winds && std::abs(net) >= oneWay * all && std::abs(net) > constants::pi)
    middle.pitch = constants::twoPi * length / std::abs(net);
}

BucklingTheory BucklingMeasure::theory(const Vector& tension) const {
  BucklingTheory theory;
  theory.sinusoidal = theory.helical = theory.spontaneous = std::numeric_limits<double>::infinity();
  bool bends = false;
  for (int e = 0; e < scene_.string.elementCount(); ++e) {
    const auto point = scene_.well.at(0.5 * (depth_[at(e)] + depth_[at(e + 1)]));
    bends = bends || point.curvature.norm() > 0.0;
    const auto limits =
        softstring::bucklingLimits(point, weight_[at(e)], rigidity_[at(e)], clearance_[at(e)]);
    // the compression of an element is the weight on bit minus the weight that hangs below it
    theory.sinusoidal = std::min(theory.sinusoidal, tension(e) + limits.sinusoidal);
    theory.helical = std::min(theory.helical, tension(e) + limits.helical);
    theory.spontaneous =
        std::min(theory.spontaneous, tension(e) + lateralLimit * limits.sinusoidal);
  }
  if (bends || !uniform(rigidity_) || !uniform(clearance_) || !uniform(weight_)) return theory;
  const double L = depth_.back(), EI = rigidity_.front();
  const double across = weight_.front() * std::sin(scene_.well.inclination(0.5 * L));
  const double along = weight_.front() * std::cos(scene_.well.inclination(0.5 * L)) * L;
  theory.finiteLength = std::numeric_limits<double>::infinity();
  for (int n = 1;; ++n) {
    const double q = n * constants::pi / L;
    const double F = EI * q * q + across / clearance_.front() / (q * q);
    if (!(F < theory.finiteLength)) break;
    theory.finiteLength = F, theory.finiteHalfWaves = n;
  }
  if (std::abs(along) > littleAlong * theory.finiteLength)
    theory.finiteLength = 0.0, theory.finiteHalfWaves = 0;
  return theory;
}

}  // namespace tooljoint::drillstring
