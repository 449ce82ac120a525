// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drillstring/case/BitSampler.hpp"

#include <optional>
#include <string>

#include "substructures/beam/NodalDofs.hpp"
#include "substructures/drillstring/StringModel.hpp"

namespace tooljoint::drillstring {

namespace {

using beam::nodal::thetaZ;
using beam::nodal::w;

}  // namespace

BitSampler::BitSampler(const Scene& scene) : scene_(scene) {
  const int last = scene.string.nodeCount();
  for (const auto& load : loads::pointLoads(scene.loads, scene.string.depths(), scene.rotary)) {
    const int dof = kNodeDofs * (last - 1) + load.component;
    const bool acts = load.component == w || load.component == thetaZ;
    if (load.node == last && acts && !scene.held[static_cast<std::size_t>(dof)])
      loads_.push_back(load);
  }
}

BitSample BitSampler::at(const cases::Sample& sample,
                         const std::vector<cases::PointRecord>& drilling) const {
  const auto last = sample.velocity.size() - kNodeDofs;
  BitSample out;
  out.imposed = scene_.rotary.speed(sample.t);
  out.speed = out.imposed + sample.velocity(last + thetaZ);
  for (const auto& record : drilling) {
    if (record.set().name != drilling::bitSet) continue;
    const int weight = record.find("weight_on_bit"), torque = record.find("torque_on_bit");
    if (torque >= 0) out.torque = *record.values(torque);
    if (weight < 0) continue;
    out.weight = *record.values(weight);
    out.advance = scene_.topDrive.blockSpeed + sample.velocity(last + w);
  }
  // Without a bit law, Loads represent the rock: they act along w and theta_z, opposite to the
  // sampled values.
  const bool ofLaw[] = {out.weight.has_value(), out.torque.has_value()};
  for (const auto& load : loads_) {
    auto& sum = load.component == w ? out.weight : out.torque;
    if (!ofLaw[load.component == w ? 0 : 1])
      sum = sum.value_or(0.0) - load.value * load.law.value(sample.t);
  }
  return out;
}

}  // namespace tooljoint::drillstring
