// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Stress of a pipe in tension, bending, torsion and pressure.
#pragma once

#include "substructures/beam/Section.hpp"

namespace tooljoint::beam {

/// Largest von Mises stress of a section at both walls and on both sides of the bend [Pa], from the
/// effective tension [N], the torque [N m], the curvature of the pipe [1/m] and the difference p of
/// inside and outside pressure. The stresses of a thick wall (Lame) are a -+ b/R^2 radially and
/// around. Their hydrostatic part a = (p_i S_i - p_o S_o)/S is already part of the effective
/// tension T:
///
///     sigma^2 = (T/S +- E kappa R)^2 + 3 (b/R^2)^2 + 3 (M R/J)^2,
///     b = p R_i^2 R_o^2/(R_o^2 - R_i^2)
double vonMises(const Section& section, double tension, double torque, double curvature,
                double pressure = 0.0);

}  // namespace tooljoint::beam
