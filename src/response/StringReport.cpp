// SPDX-License-Identifier: BSD-3-Clause
#include "response/StringReport.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "common/Constants.hpp"
#include "common/Index.hpp"
#include "common/report/Log.hpp"
#include "deck/PrintedUnits.hpp"

namespace tooljoint::response {

namespace {

using constants::rpmPerRadianPerSecond;

/// Distance of two responses at one node or element in the complex plane, at least that of their
/// values.
double apart(const Extreme& a, const Extreme& b) {
  return std::hypot(std::abs(a.axes[0] - b.axes[0]), std::abs(a.axes[1] - b.axes[1]));
}

using Points = std::vector<const ResponsePoint*>;

/// The points of the sweep and the peaks between them, in the order of the sweep.
Points everyPoint(const HarmonicResponse& response) {
  Points all;
  for (const auto& point : response.points) all.push_back(&point);
  for (const auto& peak : response.peaks) all.push_back(&peak.at);
  std::stable_sort(all.begin(), all.end(), [](const auto* a, const auto* b) {
    return std::pair(a->speed, a->frequency) < std::pair(b->speed, b->frequency);
  });
  return all;
}

/// The point at which `profile` has its smallest or largest value at a node or element.
const ResponsePoint& pointAt(const Points& points, Eigen::Index place,
                             Vector StringResponse::*profile, bool largest) {
  const ResponsePoint* best = points.front();
  for (const auto* point : points) {
    const double value = (point->along.*profile)[place], before = (best->along.*profile)[place];
    if (largest ? value > before : value < before) best = point;
  }
  return *best;
}

}  // namespace

const ResponsePoint* StringReport::firstTouch() const {
  if (response_.nodes.empty()) return nullptr;
  for (const auto* point : everyPoint(response_))
    if (point->along.margin->value < 0.0) return point;
  return nullptr;
}

const ResponsePoint* StringReport::mostBent() const {
  if (response_.elements.empty()) return nullptr;
  const auto points = everyPoint(response_);
  const auto* most = *std::max_element(points.begin(), points.end(), [](auto* a, auto* b) {
    return a->along.moment->value < b->along.moment->value;
  });
  return most->along.moment->value > 0.0 ? most : nullptr;
}

void StringReport::print() const {
  if (const auto* bent = mostBent()) {
    const deck::PrintedUnit moment("N m");
    log::info(
        fmt::format("largest bending moment beside that at rest: {:.4e} {} at a depth of "
                    "{:.1f} m, {:.2f} rpm and {:.4f} Hz",
                    moment(bent->along.moment->value), moment.name(),
                    response_.elements[bent->along.moment->place].depth,
                    bent->speed * rpmPerRadianPerSecond, bent->frequency));
  }
  if (const auto* touching = firstTouch())
    log::warn(fmt::format(
        "From {:.2f} rpm and {:.4f} Hz on, node {} reaches the wall. The linear response does not "
        "include this contact: larger amplitudes are not those of the scene.",
        touching->speed * rpmPerRadianPerSecond, touching->frequency,
        response_.nodes[touching->along.margin->place].number));
}

void StringReport::addColumns(Columns& table) const {
  const auto& points = response_.points;
  const auto add = [&](const std::string& name, const std::string& unit,
                       const std::string& longName, const auto& value) {
    table.columns.push_back({name, unit, longName, collect(points, value)});
  };
  if (!response_.nodes.empty()) {
    add("contact_margin", "m", "Least distance to the wall left to a node that is open at rest",
        [](const auto& p) { return p.along.margin->value; });
    add("contact_node", "1", "Node of that distance", [&](const auto& p) {
      return static_cast<double>(response_.nodes[p.along.margin->place].number);
    });
    if (estimated_)
      add("contact_margin_estimate", "m", "Estimated error of that distance",
          [](const auto& p) { return p.along.margin->estimate; });
  }
  if (response_.elements.empty()) return;
  add("bending_moment", "N m", "Largest amplitude of the bending moment beside that at rest",
      [](const auto& p) { return p.along.moment->value; });
  add("bending_depth", "m", "Depth of the middle of that element",
      [&](const auto& p) { return response_.elements[p.along.moment->place].depth; });
  if (estimated_)
    add("bending_moment_estimate", "N m", "Estimated error of that moment",
        [](const auto& p) { return p.along.moment->estimate; });
}

Columns StringReport::bendingTable() const {
  const auto points = everyPoint(response_);
  Columns table{{{"depth", "m", "Depth of the middle of the element", {}},
                 {"moment", "N m", "Largest amplitude of the bending moment in the sweep", {}},
                 {"stress", "Pa", "Bending stress of that at the outer wall", {}},
                 {"speed", "rad/s", "Rotary speed of that", {}},
                 {"frequency", "Hz", "Frequency of the excitation there", {}}}};
  for (std::size_t e = 0; e < response_.elements.size(); ++e) {
    const auto place = static_cast<Eigen::Index>(e);
    const auto& at = pointAt(points, place, &StringResponse::moments, true);
    const double moment = at.along.moments[place];
    const auto& element = response_.elements[e];
    const std::array<double, 5> row{element.depth, moment, moment * element.stressPerMoment,
                                    at.speed, at.frequency};
    for (std::size_t c = 0; c < row.size(); ++c) table.columns[c].values.push_back(row[c]);
  }
  return table;
}

Columns StringReport::marginTable() const {
  const auto points = everyPoint(response_);
  Columns table{{{"node", "1", "Node that is open at rest", {}},
                 {"depth", "m", "Its depth", {}},
                 {"gap", "m", "Distance to the wall at rest", {}},
                 {"margin", "m", "Least distance left in the sweep", {}},
                 {"speed", "rad/s", "Rotary speed of that", {}},
                 {"frequency", "Hz", "Frequency of the excitation there", {}}}};
  for (std::size_t i = 0; i < response_.nodes.size(); ++i) {
    const auto place = static_cast<Eigen::Index>(i);
    const auto& at = pointAt(points, place, &StringResponse::margins, false);
    const auto& node = response_.nodes[i];
    const std::array<double, 6> row{static_cast<double>(node.number), node.depth, node.gap,
                                    at.along.margins[place],          at.speed,   at.frequency};
    for (std::size_t c = 0; c < row.size(); ++c) table.columns[c].values.push_back(row[c]);
  }
  return table;
}

Columns StringReport::checkTable() const {
  const auto& checks = response_.checks;
  Columns table{{
      {"speed", "rad/s", "Rotary speed",
       collect(checks, [](const auto& c) { return c.reduced.speed; })},
      {"frequency", "Hz", "Frequency of the excitation",
       collect(checks, [](const auto& c) { return c.reduced.frequency; })},
  }};
  const auto add = [&](const std::string& name, const std::string& unit, const std::string& what,
                       std::optional<Extreme> StringResponse::*extreme) {
    const auto column = [&](const std::string& which, const std::string& text, const auto& value) {
      table.columns.push_back({name + "_" + which, unit, text, collect(checks, value)});
    };
    column("full", what + " of the full model, at the place of that of the reduced one",
           [=](const auto& c) { return (c.full.along.*extreme)->value; });
    column("reduced", what + " of the reduced model",
           [=](const auto& c) { return (c.reduced.along.*extreme)->value; });
    column("error", "Size of the complex difference of both in two axes", [=](const auto& c) {
      return apart(*(c.full.along.*extreme), *(c.reduced.along.*extreme));
    });
    if (estimated_)
      column("estimate", "Estimate of that without the full model",
             [=](const auto& c) { return (c.reduced.along.*extreme)->estimate; });
  };
  if (!response_.elements.empty())
    add("moment", "N m", "Largest bending moment", &StringResponse::moment);
  if (!response_.nodes.empty())
    add("margin", "m", "Least distance to the wall", &StringResponse::margin);
  return table;
}

void StringReport::writeProfiles(io::ResultsFile& file) const {
  const auto write = [&](const std::string& path, std::size_t places, const std::string& unit,
                         const std::string& longName, Vector StringResponse::*profile) {
    std::vector<double> all;
    for (const auto& point : response_.points) {
      const Vector& one = point.along.*profile;
      all.insert(all.end(), one.data(), one.data() + one.size());
    }
    file.write(path, all, {response_.points.size(), places}, unit, longName);
  };
  if (!response_.elements.empty())
    write("/bending/moments", response_.elements.size(), "N m",
          "Amplitudes of the bending moments of the elements at the points of the sweep",
          &StringResponse::moments);
  if (!response_.nodes.empty())
    write("/margins/margins", response_.nodes.size(), "m",
          "Distances left to the wall by the nodes at the points of the sweep",
          &StringResponse::margins);
}

void StringReport::write(io::OutputFolder& folder, io::ResultsFile& file) const {
  if (!response_.elements.empty()) bendingTable().write("bending", folder, file);
  if (!response_.nodes.empty()) marginTable().write("margins", folder, file);
  if (!response_.elements.empty() || !response_.nodes.empty()) {
    checkTable().write("spot_checks_string", folder, file);
    writeProfiles(file);
  }
}

void StringReport::summarise(io::Summary& summary) const {
  if (const auto* bent = mostBent()) {
    const auto& moment = *bent->along.moment;
    summary.set("response.bending_moment", moment.value);
    summary.set("response.bending_depth", response_.elements[moment.place].depth);
    summary.set("response.bending_speed_rpm", bent->speed * rpmPerRadianPerSecond);
    summary.set("response.bending_hz", bent->frequency);
    if (estimated_) summary.set("response.bending_estimate", moment.estimate);
  }
  if (const auto* touching = firstTouch()) {
    summary.set("response.contact_speed_rpm", touching->speed * rpmPerRadianPerSecond);
    summary.set("response.contact_hz", touching->frequency);
    summary.set("response.contact_node",
                static_cast<long>(response_.nodes[touching->along.margin->place].number));
  }
}

}  // namespace tooljoint::response
