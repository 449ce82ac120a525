// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drillstring/case/SurfaceSampler.hpp"

#include <cmath>
#include <string>

#include "substructures/beam/NodalDofs.hpp"
#include "substructures/drillstring/StringModel.hpp"

namespace tooljoint::drillstring {

namespace {

using beam::nodal::thetaZ;
using beam::nodal::w;

/// Difference of a component of the second node and the first.
double stretch(const Vector& displacement, int component) {
  return displacement(kNodeDofs + component) - displacement(component);
}

}  // namespace

SurfaceSampler::SurfaceSampler(const Scene& scene, const StaticStage& stage) : scene_(scene) {
  const auto& element = scene.string.elements.front();
  const auto& section = element.section();
  const auto& state = stage.state;
  axialStiffness_ = section.axialRigidity() / element.length();
  torsionalStiffness_ = section.torsionalRigidity() / element.length();
  axialOffset_ = state.hookLoad - axialStiffness_ * stretch(state.displacement, w);
  torqueOffset_ = state.torque(0) - torsionalStiffness_ * stretch(state.displacement, thetaZ);
}

void SurfaceSampler::sample(const cases::Sample& sample) {
  const Vector& D = sample.displacement;
  speed_ = scene_.rotary.speed(sample.t) + sample.velocity(thetaZ);
  hookLoad_ = axialOffset_ + axialStiffness_ * stretch(D, w);
  torque_ = -sense(sample.t) * (torqueOffset_ + torsionalStiffness_ * stretch(D, thetaZ));
}

/// If the surface does not turn, the sense of the rotation so far, or, before it, that of the first
/// rotation.
double SurfaceSampler::sense(double t) const {
  const auto& rotary = scene_.rotary;
  for (const double turning : {rotary.speed(t), rotary.angle(t), rotary.sense(t)})
    if (turning != 0.0) return std::copysign(1.0, turning);
  return 1.0;
}

}  // namespace tooljoint::drillstring
