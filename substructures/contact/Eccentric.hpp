// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Contact of sections whose centre of contact lies beside the axis of the string (eccentric
/// gauges), based on the law for concentric sections:
///
///     f(d) = f_0(u + o_u, v + o_v, theta_z),  T_z = T_0 + o_u F_v - o_v F_u
///
/// The offset o [m] is constant in the nodal frame and does not turn.
#pragma once

#include <memory>
#include <vector>

#include "common/Types.hpp"
#include "substructures/contact/BoreholeContact.hpp"
#include "substructures/contact/StaticContact.hpp"

namespace tooljoint::contact {

/// One offset per point.
using Offsets = std::vector<Eigen::Vector2d>;

std::shared_ptr<const StaticContact> eccentric(std::shared_ptr<const StaticContact> concentric,
                                               Offsets offsets);

/// For a law with the coordinates u, v, theta_z or u, v, w, theta_z and without states.
std::shared_ptr<const model::PointLaw> eccentric(std::shared_ptr<const model::PointLaw> concentric,
                                                 Offsets offsets);

}  // namespace tooljoint::contact
