// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Directions of the named components.
#pragma once

#include <array>
#include <functional>
#include <string>

#include "model/DofLabel.hpp"

namespace tooljoint::coupling {

/// Positions of the components along or about the axes 1, 2, 3; -1 where the names have none.
struct ComponentAxes {
  std::array<int, 3> translation{-1, -1, -1};
  std::array<int, 3> rotation{-1, -1, -1};
};

enum class ComponentKind { Translation, Rotation, Unknown };

/// Translations: u v w, x y z, ux uy uz, u1 u2 u3; rotations: theta, phi, rot, r or ur with x y z
/// or 1 2 3, and theta, phi or rot alone in a plane (about the third axis); "_", "-", "." and case
/// do not matter.
ComponentAxes componentAxes(const model::ComponentNames& names);
ComponentKind kindOf(const std::string& name);

/// Chooses between the unit of a translation and that of a rotation by the name of a component: for
/// deck::ListSpec::unitBy. A name of neither kind has none; `absent` is the unit without a name.
std::function<std::string(const std::string&)> unitByKind(const std::string& translation,
                                                          const std::string& rotation,
                                                          const std::string& absent = "");

}  // namespace tooljoint::coupling
