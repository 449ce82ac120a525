// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/contact/StaticContact.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include "common/Index.hpp"
#include "substructures/contact/WallKinematics.hpp"

namespace tooljoint::contact {

std::pair<double, double> Sliding::direction(double radius) const {
  if (!any()) return {0.0, 0.0};
  if (axialSpeed == 0.0) return {0.0, std::copysign(1.0, rotarySpeed)};
  const double around = rotarySpeed * radius, speed = std::hypot(axialSpeed, around);
  return {axialSpeed / speed, around / speed};
}

void StaticContact::evaluate(const Options& options, const double* uv, double* f,
                             double* tangent) const {
  std::vector<double> normal(at(size())), slope(at(size()));
  normalForce(options, uv, normal.data(), slope.data());
  for (int p = options.first; p < options.end(size()); ++p) {
    const auto i = at(p);
    const WallKinematics where(uv[2 * p], uv[2 * p + 1], 0.0, 0.0, points_.clearance[i]);
    const double N = normal[i], dN = slope[i], nu = where.nu, nv = where.nv;
    const double radius = points_.contactRadius[i];
    const auto [axial, turning] = options.sliding.direction(radius);
    const double along = axial * options.frictionScale * points_.muStatic[i];
    const double around = turning * options.frictionScale * points_.muStatic[i];
    double* force = f + kForces * p;
    force[0] = N * (around * nv - nu);
    force[1] = -N * (around * nu + nv);
    force[2] = -along * N;
    force[3] = -around * N * radius;
    if (tangent == nullptr) continue;
    // dn/d(u, v) = t t'/r
    const double nuu = (1.0 - nu * nu) * where.inverse;
    const double nuv = -nu * nv * where.inverse;
    const double nvv = (1.0 - nv * nv) * where.inverse;
    double* j = tangent + 2 * kForces * p;
    j[0] = dN * nu * (around * nv - nu) + N * (around * nuv - nuu);
    j[1] = dN * nv * (around * nv - nu) + N * (around * nvv - nuv);
    j[2] = -dN * nu * (around * nu + nv) - N * (around * nuu + nuv);
    j[3] = -dN * nv * (around * nu + nv) - N * (around * nuv + nvv);
    j[4] = -along * dN * nu;
    j[5] = -along * dN * nv;
    j[6] = -around * dN * nu * radius;
    j[7] = -around * dN * nv * radius;
  }
}

}  // namespace tooljoint::contact
