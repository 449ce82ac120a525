// SPDX-License-Identifier: BSD-3-Clause
#include "io/summary/SummaryUnits.hpp"

#include <map>
#include <utility>

namespace tooljoint::io {
namespace {

bool endsWith(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}
bool startsWith(const std::string& text, const std::string& begin) {
  return text.compare(0, begin.size(), begin) == 0;
}

/// Groups of numbers of one quantity below a key: mean, rms, min, max; peak and worst of a node.
const std::pair<const char*, const char*> groups[] = {
    {"transient.figures.weight_on_bit.", "N"},
    {"transient.figures.torque_on_bit.", "N m"},
    {"transient.figures.axial_acceleration.", "m/s2"},
    {"transient.figures.lateral_acceleration.", "m/s2"},
};

const std::map<std::string, std::string>& single() {
  static const std::map<std::string, std::string> units{
      {"model.length", "m"},
      {"path.max_position_error", "m"},
      {"static.hook_load", "N"},
      {"static.surface_torque", "N m"},
      {"static.top_axial_force", "N"},
      {"static.last_element_axial_force", "N"},
      {"static.last_element_torque", "N m"},
      {"static.max_normal_force", "N"},
      {"static.total_normal_force", "N"},
      {"static.top_torque", "N m"},
      {"static.top_torque_equilibrium", "N m"},
      {"static.torque_balance_defect", "N m"},
      {"static.torque_scale", "N m"},
      {"transient.max_penetration", "m"},
      {"transient.figures.rate_of_penetration", "m/s"},
      {"transient.figures.specific_energy", "Pa"},
      {"transient.figures.contact.total_force_mean", "N"},
      {"transient.figures.contact.force_peak", "N"},
      {"transient.figures.bending.range", "N m"},
  };
  return units;
}

}  // namespace

std::string unitOfKey(const std::string& key) {
  if (endsWith(key, "_node") || endsWith(key, "_element")) return "";
  if (endsWith(key, "_depth")) return "m";
  for (const auto& [begin, unit] : groups)
    if (startsWith(key, begin)) return unit;
  const auto found = single().find(key);
  return found == single().end() ? "" : found->second;
}

}  // namespace tooljoint::io
