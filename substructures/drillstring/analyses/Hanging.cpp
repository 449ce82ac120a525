// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drillstring/analyses/Hanging.hpp"

#include <algorithm>
#include <string>

#include "substructures/beam/NodalDofs.hpp"
#include "substructures/drillstring/ContactNodes.hpp"
#include "substructures/drillstring/assembly/DrillstringReader.hpp"

namespace tooljoint::drillstring {
namespace {

void holdAlongAndAbout(DofFlags& dofs, bool held) {
  dofs[beam::nodal::w] = dofs[beam::nodal::thetaZ] = held;
}

/// Supports of a string without its first nodes.
SupportSettings hanging(SupportSettings supports, int removedNodes) {
  holdAlongAndAbout(supports.top, true);
  holdAlongAndAbout(supports.bit, false);
  for (NamedSupport& support : supports.named) {
    support.node -= removedNodes;
    holdAlongAndAbout(support.dofs, false);
  }
  supports.named.erase(std::remove_if(supports.named.begin(), supports.named.end(),
                                      [](const NamedSupport& one) { return one.node < 1; }),
                       supports.named.end());
  return supports;
}

/// Only the loads that act on the mud too: weight.
loads::Loads weightAlone(const loads::Loads& all) {
  loads::Loads found;
  for (const auto& load : all)
    if (!load->acceleration().isZero(0.0)) found.push_back(load);
  return found;
}

}  // namespace

Scene hungAt(const Scene& scene, double bit) {
  Scene hung = scene;
  hung.string = buildDrillString(readDrillstring(scene.deck), scene.well, bit);
  hung.supports = hanging(scene.supports, scene.string.nodeCount() - hung.string.nodeCount());
  hung.held = heldDofs(hung.supports, hung.string);
  if (hung.contact) hung.contactPoints = contactPoints(*hung.contact, hung.string, hung.held);
  hung.loads = weightAlone(scene.loads);
  hung.bit.reset();
  hung.topDrive = {};
  return hung;
}

}  // namespace tooljoint::drillstring
