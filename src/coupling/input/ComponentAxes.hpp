// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Directions of the named components.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "common/Types.hpp"
#include "model/DofLabel.hpp"

namespace tooljoint::coupling {

/// Positions of the components along or about the axes 1, 2, 3; -1 if there is none.
struct ComponentAxes {
  std::array<int, 3> translation{-1, -1, -1};
  std::array<int, 3> rotation{-1, -1, -1};
};

enum class ComponentKind { Translation, Rotation, Unknown };

/// Translations: u v w, x y z, ux uy uz, u1 u2 u3. Rotations: theta, phi, rot, r or ur with x y z
/// or 1 2 3; theta, phi or rot alone in a plane (about the third axis). "_", "-", "." and case are
/// ignored.
ComponentAxes componentAxes(const model::ComponentNames& names);
ComponentKind kindOf(const std::string& name);
/// True if both are the translation along, or the rotation about, the same axis: "w" and "uz".
bool sameDirection(const std::string& first, const std::string& second);

/// Names, in the style of those given, of missing components that a rotation d_common = axes d_part
/// leads into: {"w"} for (u, v) turned out of its plane.
std::vector<std::string> namesTurnedInto(const model::ComponentNames& names, const Matrix3& axes);

/// Chooses the unit of a translation or that of a rotation by the name of a component: for
/// deck::ListSpec::unitBy. A name of neither kind has no unit; `absent` is the unit without a name.
std::function<std::string(const std::string&)> unitByKind(const std::string& translation,
                                                          const std::string& rotation,
                                                          const std::string& absent = "");

}  // namespace tooljoint::coupling
