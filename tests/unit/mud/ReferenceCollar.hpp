// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The collar of the reference scene in its bore, and the mud around it.
#pragma once

#include "substructures/mud/AnnularFlow.hpp"

namespace tooljoint::mud {

inline constexpr double outerRadius = 0.0795;  ///< [m]
inline constexpr double innerRadius = 0.0355;  ///< [m]
inline constexpr double boreRadius = 0.108;    ///< [m]

inline MudProperties referenceMud() {
  MudProperties p;
  p.density = 1200.0;
  p.frictionCoefficient = 0.013;
  p.kinematicViscosity = 1e-6;
  p.flowRate = 0.01;
  return p;
}

inline beam::Section collar() {
  return beam::Section::hollow(outerRadius, innerRadius, {7900.0, 2.03e11, 0.3});
}

}  // namespace tooljoint::mud
