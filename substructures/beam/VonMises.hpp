// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Stress of a pipe in tension, bending and torsion.
#pragma once

#include "substructures/beam/Section.hpp"

namespace tooljoint::beam {

/// Largest von Mises stress of a section at both walls and on both sides of the bend [Pa], from the
/// effective tension [N], the torque [N m] and the curvature of the pipe [1/m]. Equal pressure
/// inside and outside is hydrostatic in the wall and part of the effective tension T:
///
///     sigma^2 = (T/S +- E kappa R)^2 + 3 (M R/J)^2
double vonMises(const Section& section, double tension, double torque, double curvature);

}  // namespace tooljoint::beam
