// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drillstring/case/SurfaceSampler.hpp"

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
  const double sense = scene_.rotary.speed(sample.t) < 0.0 ? -1.0 : 1.0;
  torque_ = -sense * (torqueOffset_ + torsionalStiffness_ * stretch(D, thetaZ));
}

}  // namespace tooljoint::drillstring
