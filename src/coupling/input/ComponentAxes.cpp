// SPDX-License-Identifier: BSD-3-Clause
#include "coupling/input/ComponentAxes.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include "common/Text.hpp"

namespace tooljoint::coupling {

namespace {

/// Entries of a rotation below this are rounding.
constexpr double rounding = 1e-12;

/// Kind and axis (0, 1, 2) of a name.
std::pair<ComponentKind, int> meaning(const std::string& name) {
  std::string plain;
  for (char c : lower(name))
    if (c != '_' && c != '-' && c != '.' && c != ' ') plain += c;
  const std::vector<std::vector<std::string>> translations{
      {"u", "x", "ux", "u1"}, {"v", "y", "uy", "u2"}, {"w", "z", "uz", "u3"}};
  for (int axis = 0; axis < 3; ++axis)
    for (const auto& word : translations[static_cast<std::size_t>(axis)])
      if (plain == word) return {ComponentKind::Translation, axis};
  for (const std::string stem : {"theta", "phi", "rot", "ur", "r"}) {
    if (plain.rfind(stem, 0) != 0) continue;
    const std::string rest = plain.substr(stem.size());
    if (rest.empty() && stem.size() > 2) return {ComponentKind::Rotation, 2};
    for (int axis = 0; axis < 3; ++axis)
      if (rest == std::string(1, "xyz"[axis]) || rest == std::string(1, "123"[axis]))
        return {ComponentKind::Rotation, axis};
  }
  return {ComponentKind::Unknown, -1};
}

/// Name of the component along or about `axis` (0, 1, 2) in the style of this one: "w" from "u",
/// "theta_x" from "theta_y" and from "theta".
std::string alongAxis(std::string name, int axis) {
  for (const std::string letters : {"uvw", "UVW", "xyz", "XYZ", "123"})
    if (letters.find(name.back()) != std::string::npos) {
      name.back() = letters[static_cast<std::size_t>(axis)];
      return name;
    }
  return name + "_" + "xyz"[axis];
}

}  // namespace

ComponentAxes componentAxes(const model::ComponentNames& names) {
  ComponentAxes axes;
  for (std::size_t c = 0; c < names.size(); ++c) {
    const auto [kind, axis] = meaning(names[c]);
    if (kind == ComponentKind::Unknown) continue;
    (kind == ComponentKind::Translation ? axes.translation
                                        : axes.rotation)[static_cast<std::size_t>(axis)] =
        static_cast<int>(c);
  }
  return axes;
}

ComponentKind kindOf(const std::string& name) { return meaning(name).first; }

bool sameDirection(const std::string& first, const std::string& second) {
  return meaning(first) == meaning(second) && kindOf(first) != ComponentKind::Unknown;
}

std::vector<std::string> namesTurnedInto(const model::ComponentNames& names, const Matrix3& axes) {
  const auto have = componentAxes(names);
  std::vector<std::string> more;
  for (const auto& vector : {have.translation, have.rotation})
    for (int a = 0; a < 3; ++a) {
      if (vector[static_cast<std::size_t>(a)] >= 0) continue;
      for (int b = 0; b < 3; ++b) {
        const int from = vector[static_cast<std::size_t>(b)];
        if (from < 0 || std::abs(axes(a, b)) < rounding) continue;
        more.push_back(alongAxis(names[static_cast<std::size_t>(from)], a));
        break;
      }
    }
  return more;
}

std::function<std::string(const std::string&)> unitByKind(const std::string& translation,
                                                          const std::string& rotation,
                                                          const std::string& absent) {
  return [translation, rotation, absent](const std::string& component) {
    if (component.empty()) return absent;
    const ComponentKind kind = kindOf(component);
    return kind == ComponentKind::Translation ? translation
           : kind == ComponentKind::Rotation  ? rotation
                                              : std::string();
  };
}

}  // namespace tooljoint::coupling
