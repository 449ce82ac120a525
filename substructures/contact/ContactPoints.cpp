// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/contact/ContactPoints.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "common/Error.hpp"
#include "model/laws/Coulomb.hpp"

namespace tooljoint::contact {
namespace {

void require(bool good, int node, const std::string& sentence) {
  if (!good) throw DeckError("Contact at node " + std::to_string(node) + ": " + sentence);
}

}  // namespace

void ContactPoints::add(const ContactPoint& p) {
  const auto atLeastZero = [](double x) { return std::isfinite(x) && x >= 0.0; };
  require(atLeastZero(p.clearance), p.node, "the clearance must be finite and not negative.");
  require(atLeastZero(p.contactRadius), p.node,
          "the contact radius must be finite and not negative.");
  require(std::isfinite(p.stiffness) && p.stiffness > 0.0, p.node,
          "the stiffness must be above 0.");
  require(atLeastZero(p.damping), p.node, "the damping must not be negative.");
  require(std::isfinite(p.lambdaK) && p.lambdaK > 0.0, p.node,
          "the stiffness regularisation must be above 0.");
  require(std::isfinite(p.lambdaC) && p.lambdaC > 0.0, p.node,
          "the damping regularisation must be above 0.");
  require(atLeastZero(p.muStatic) && atLeastZero(p.muDynamic), p.node,
          "friction coefficients must not be negative.");
  require(p.muDynamic <= p.muStatic, p.node,
          "the dynamic friction coefficient is above the static one; the friction law needs "
          "dynamic <= static.");
  require(std::isfinite(p.regularisationVelocity) && p.regularisationVelocity > 0.0, p.node,
          "the regularisation velocity must be above 0.");
  node.push_back(p.node);
  clearance.push_back(p.clearance);
  contactRadius.push_back(p.contactRadius);
  stiffness.push_back(p.stiffness);
  damping.push_back(p.damping);
  lambdaK.push_back(p.lambdaK);
  lambdaC.push_back(p.lambdaC);
  muStatic.push_back(p.muStatic);
  muDynamic.push_back(p.muDynamic);
  regularisationVelocity.push_back(p.regularisationVelocity);
}

ContactPoint ContactPoints::at(int position) const {
  const auto i = static_cast<std::size_t>(position);
  return {node.at(i), clearance[i], contactRadius[i], stiffness[i], damping[i],
          lambdaK[i], lambdaC[i],   muStatic[i],      muDynamic[i], regularisationVelocity[i]};
}

ContactPoints ContactPoints::subset(const std::vector<int>& positions) const {
  ContactPoints out;
  for (const int i : positions) out.add(at(i));
  return out;
}

ContactPoints ContactPoints::slidingAt(double omega, double axialSpeed) const {
  ContactPoints out = *this;
  for (std::size_t i = 0; i < out.muStatic.size(); ++i)
    out.muStatic[i] = model::FrictionCurve(muStatic[i], muDynamic[i], regularisationVelocity[i])
                          .value(std::hypot(omega * contactRadius[i], axialSpeed));
  return out;
}

ContactPoints ContactPoints::slidingFast() const {
  ContactPoints out = *this;
  out.muStatic = muDynamic;
  return out;
}

bool ContactPoints::frictionless() const {
  return std::all_of(muStatic.begin(), muStatic.end(), [](double mu) { return mu == 0.0; });
}

}  // namespace tooljoint::contact
