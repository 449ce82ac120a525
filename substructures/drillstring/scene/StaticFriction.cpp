// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drillstring/scene/StaticFriction.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <vector>

namespace tooljoint::drillstring {

namespace {

/// ", 0.25 to 0.28": range of the coefficients of points with friction.
std::string range(const std::vector<double>& coefficients) {
  double least = std::numeric_limits<double>::infinity(), most = 0.0;
  for (const double one : coefficients)
    if (one > 0.0) least = std::min(least, one), most = std::max(most, one);
  if (!(most > 0.0)) return "";
  const auto from = fmt::format(", {:.3g}", least), to = fmt::format("{:.3g}", most);
  return from == ", " + to ? from : from + " to " + to;
}

}  // namespace

StaticFriction staticFriction(const Scene& scene) {
  constexpr double atRest = 1e-9;  // [rad/s], a phase of 180 degrees leaves 1e-16 of an amplitude
  using equilibrium::FrictionRule;
  if (scene.contact && !scene.contact->law->hasFrictionAtRest())
    return {0.0, 0.0,
            "none: the friction of " + scene.contact->lawName + " begins with the motion"};
  if (!scene.contact || !scene.contact->friction)
    return {0.0, 0.0, "no friction in the Contact list"};
  if (scene.statics.friction == FrictionRule::None)
    return {0.0, 0.0, "switched off in Static/Friction"};
  const double start = scene.startTime();
  const double speed = scene.rotary.speed(start);
  const bool turns = std::abs(speed) > atRest;
  const double along = scene.contact->axialFriction ? scene.topDrive.blockSpeed : 0.0;
  if (along != 0.0) {  // in motion from the start
    const double around = turns ? speed : 0.0, sense = turns ? std::copysign(1.0, speed) : 0.0;
    if (scene.statics.friction == FrictionRule::Peak)
      return {sense, 0.0, "peak coefficient, around and along the hole", {along, around}};
    return {sense,
            std::abs(around),
            "coefficient at the sliding speed around and along the hole" +
                range(scene.contactPoints.slidingAt(around, along).muStatic),
            {along, around},
            true};
  }
  const double direction = turns ? std::copysign(1.0, speed) : scene.rotary.sense(start);
  if (direction == 0.0) return {0.0, 0.0, "the string never turns"};
  if (scene.statics.friction == FrictionRule::Peak)
    return {direction, 0.0, "peak coefficient", {0.0, direction}};
  if (!turns)
    return {direction, 0.0, "peak coefficient: the string starts from rest", {0.0, direction}};
  return {direction,
          std::abs(speed),
          "coefficient at the sliding speed Omega R_c" +
              range(scene.contactPoints.slidingAt(speed).muStatic),
          {0.0, speed},
          true};
}

}  // namespace tooljoint::drillstring
