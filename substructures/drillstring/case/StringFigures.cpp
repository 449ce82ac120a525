// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drillstring/case/StringFigures.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/printf.h>
#include <utility>

#include "cases/figures/Settling.hpp"
#include "common/Constants.hpp"
#include "deck/PrintedUnits.hpp"
#include "io/Csv.hpp"
#include "substructures/beam/NodalDofs.hpp"
#include "substructures/drillstring/figures/BendingElements.hpp"

namespace tooljoint::drillstring {

namespace {

using namespace beam::nodal;

constexpr double rpm = constants::rpmPerRadianPerSecond;
constexpr double secondsPerHour = 3600.0;
double holeArea(const Scene& scene) {
  const double radius = scene.well.boreRadius(scene.string.length());
  return constants::pi * radius * radius;
}

Vector asVector(const std::vector<double>& values) {
  return Eigen::Map<const Vector>(values.data(), static_cast<Eigen::Index>(values.size()));
}

Vector component(const Vector& values, Eigen::Index which) {
  return Eigen::Map<const Vector, 0, Eigen::InnerStride<kNodeDofs>>(values.data() + which,
                                                                    values.size() / kNodeDofs);
}

}  // namespace

StringFigures::StringFigures(const Scene& scene, const StaticStage& stage)
    : scene_(scene),
      window_(cases::figureWindow(scene.output.figures, scene.list().sublist("Transient"))),
      nodeDepth_(asVector(scene.string.depths())),
      bit_(scene.output.figures.stuckSpeed, holeArea(scene)),
      axial_(nodeDepth_.size()),
      lateral_(nodeDepth_.size()),
      orbit_(nodeDepth_.size()),
      contact_(nodeDepth_.size()),
      bending_(bendingElements(scene.string, stage.path), scene.output.figures.snLine) {
  const auto nodes = nodeDepth_.size();
  elementDepth_ = 0.5 * (nodeDepth_.head(nodes - 1) + nodeDepth_.tail(nodes - 1));
  belowReleases_ = elementsBelowReleases(scene, stage);
}

void StringFigures::sample(const cases::Sample& sample, const BitSample& bit,
                           const Vector& normalForce) {
  if (bit.weight) {
    leastWeight_ = std::min(leastWeight_, *bit.weight);
    mostWeight_ = std::max(mostWeight_, *bit.weight);
  }
  if (!window_.contains(sample.t)) return;
  if (samples_ == 0) first_ = sample.t;
  last_ = sample.t;
  ++samples_;
  bit_.add(bit, sample.t > 0.5 * (window_.begin + window_.end));
  sampleNodes(sample, normalForce);
  bending_.add(sample.displacement, scene_.rotary.angle(sample.t));
}

void StringFigures::sampleNodes(const cases::Sample& sample, const Vector& normalForce) {
  const auto& a = sample.acceleration;
  lateral_.add((component(a, u).cwiseAbs2() + component(a, v).cwiseAbs2()).cwiseSqrt());
  axial_.add(component(a, w).cwiseAbs());
  contact_.add(normalForce);
  std::vector<char> inContact(static_cast<std::size_t>(normalForce.size()), 0);
  for (Eigen::Index i = 0; i < normalForce.size(); ++i)
    inContact[static_cast<std::size_t>(i)] = normalForce[i] > 0.0 ? 1 : 0;
  orbit_.add({component(sample.displacement, u), component(sample.displacement, v),
              component(sample.velocity, u), component(sample.velocity, v), inContact,
              scene_.rotary.speed(sample.t)});
}

double StringFigures::perHour() const {
  return last_ > first_ ? secondsPerHour / (last_ - first_) : 0.0;
}

std::vector<StringFigures::Column> StringFigures::nodeColumns() const {
  return {{"axial_rms", "m/s2", "Root mean square of the axial acceleration", axial_.rms()},
          {"axial_peak", "m/s2", "Largest axial acceleration", axial_.peak()},
          {"lateral_rms", "m/s2", "Root mean square of the lateral acceleration", lateral_.rms()},
          {"lateral_peak", "m/s2", "Largest lateral acceleration", lateral_.peak()},
          {"precession", "rad/s", "Mean precession rate, positive turns x into y", orbit_.rate()},
          {"forward_share", "1", "Share of time in forward whirl", orbit_.forwardShare()},
          {"backward_share", "1", "Share of time in backward whirl", orbit_.backwardShare()},
          {"forward_contact_share", "1", "Share of time in forward whirl and in contact",
           orbit_.forwardContact()},
          {"backward_contact_share", "1", "Share of time in backward whirl and in contact",
           orbit_.backwardContact()},
          {"contact_duty", "1", "Share of time in contact", contact_.duty()},
          {"contact_force_mean", "N", "Mean normal contact force, 0 where open", contact_.mean()},
          {"contact_force_peak", "N", "Largest normal contact force", contact_.peak()}};
}

std::vector<StringFigures::Column> StringFigures::elementColumns() const {
  const auto counts = bending_.counts();
  Vector cycles(elementDepth_.size()), range(elementDepth_.size()), damage(elementDepth_.size());
  for (Eigen::Index e = 0; e < elementDepth_.size(); ++e) {
    const bool next = std::binary_search(belowReleases_.begin(), belowReleases_.end(), e);
    const auto& one = counts[static_cast<std::size_t>(next ? e + 1 : e)];
    cycles[e] = one.cycles;
    range[e] = one.largestRange;
    damage[e] = one.damage * perHour();
  }
  std::vector<Column> out{
      {"bending_cycles", "1", "Cycles of the bending moment by rainflow", cycles},
      {"bending_range", "N m", "Largest range of the bending moment", range}};
  if (bending_.hasDamage())
    out.push_back({"damage_per_hour", "1/h", "Share of the fatigue life used in an hour", damage});
  return out;
}

void StringFigures::summarise(io::Summary& summary) const {
  if (!known()) return;
  summary.set("transient.figures.begin", first_);
  summary.set("transient.figures.end", last_);
  summary.set("transient.figures.samples", samples_);
  bit_.summarise(summary);
  summariseNodes(summary);
  summariseBending(summary);
}

void StringFigures::summariseNodes(io::Summary& summary) const {
  const std::string key = "transient.figures.";
  const auto place = [&](const std::string& name, const cases::WorstPlace& found) {
    summary.set(key + name, found.value);
    summary.set(key + name + "_node", static_cast<long>(found.row) + 1);
    summary.set(key + name + "_depth", nodeDepth_[found.row]);
  };
  for (const auto& [name, figures] :
       {std::pair{"axial_acceleration", &axial_}, {"lateral_acceleration", &lateral_}}) {
    summary.set(key + name + ".rms", figures->overallRms());
    place(std::string(name) + ".peak", cases::worst(figures->peak()));
    place(std::string(name) + ".worst_rms", cases::worst(figures->rms()));
  }
  const Vector backward = orbit_.backwardShare();
  summary.set(key + "whirl.forward_share", orbit_.forwardShare().mean());
  summary.set(key + "whirl.backward_share", backward.mean());
  summary.set(key + "whirl.backward_contact_share", orbit_.backwardContact().mean());
  const auto worst = orbit_.most(backward);
  place("whirl.worst_backward_share", worst);
  place("whirl.worst_backward_contact_share", orbit_.most(orbit_.backwardContact()));
  const auto whirls = worst.value > 0.0 ? worst : orbit_.most(orbit_.forwardShare());
  if (whirls.value > 0.0)
    place("whirl.worst_precession_rpm", {whirls.row, orbit_.rate()[whirls.row] * rpm});
  if (scene_.contactPoints.size() == 0) return;
  summary.set(key + "contact.duty", contact_.duty().sum() / scene_.contactPoints.size());
  summary.set(key + "contact.total_force_mean", contact_.mean().sum());
  place("contact.force_peak", cases::worst(contact_.peak()));
}

void StringFigures::summariseBending(io::Summary& summary) const {
  const std::string key = "transient.figures.bending.";
  const auto columns = elementColumns();
  const auto place = [&](const std::string& name, const cases::WorstPlace& found) {
    summary.set(key + name, found.value);
    summary.set(key + name + "_element", static_cast<long>(found.row) + 1);
    summary.set(key + name + "_depth", elementDepth_[found.row]);
  };
  const auto largest = cases::worst(columns[1].values);
  place("range", largest);
  summary.set(key + "cycles", columns[0].values[largest.row]);
  if (bending_.hasDamage()) place("damage_per_hour", cases::worst(columns[2].values));
}

std::vector<std::string> StringFigures::warnings() const {
  constexpr double negligible = 0.01;
  std::vector<std::string> found;
  if (const auto growth = bit_.growth(); growth && *growth >= cases::unsettledGrowth)
    found.push_back(fmt::sprintf(
        "The bit has not settled: the range of its speed about the rotary speed is %.2g times as "
        "large in the second half of %.4g to %.4g s as in the first. A vibration that grows is "
        "larger later. Let the motion last longer before its figures are taken "
        "(Transient/End Time, Output/Figures/Begin).",
        *growth, first_, last_));
  if (scene_.bit && leastWeight_ <= mostWeight_) {
    auto weight =
        drilling::outsideCalibration(*scene_.bit, "the motion", leastWeight_, mostWeight_);
    if (!weight.empty()) found.push_back(std::move(weight));
  }
  if (!known() || !scene_.bit) return found;
  const auto backward = bit_.backwardAdvance();
  if (scene_.bit->law->cutsForwardOnly() && backward && *backward >= negligible)
    found.push_back(fmt::sprintf(
        "The bit made %.3g %% of its advance from %.4g to %.4g s while it turned backward, where "
        "the law \"%s\" cuts nothing and carries no weight but that of its wear flats: it sinks "
        "into uncut rock. Rate of penetration and specific energy count that advance. Damp the "
        "stick-slip (Top Drive/Control), or raise the rotary speed.",
        100.0 * *backward, first_, last_, scene_.bit->name.c_str()));
  return found;
}

std::string StringFigures::describe() const {
  if (!known()) return "";
  const auto lateral = cases::worst(lateral_.peak());
  const auto bending = cases::worst(elementColumns()[1].values);
  const auto acceleration = [](double value) { return deck::printed(value, "m/s2", 3); };
  const auto depth = [](double value) { return deck::printed(value, "m", 4); };
  const auto index = bit_.stickSlipIndex(), stuck = bit_.stuckShare();
  return fmt::sprintf(
      "figures     %.4g to %.4g s%s\n"
      "            acceleration: axial %s rms, lateral %s rms, %s at most (%s); bending range %s "
      "(%s)",
      first_, last_,
      index && stuck ? fmt::sprintf(": stick-slip index %.3g, stuck %.3g %% of the time", *index,
                                    100.0 * *stuck)
                     : std::string(": nothing turns the string"),
      acceleration(axial_.overallRms()), acceleration(lateral_.overallRms()),
      acceleration(lateral.value), depth(nodeDepth_[lateral.row]),
      deck::printed(bending.value, "kN m", 3), depth(elementDepth_[bending.row]));
}

void StringFigures::write(io::ResultsFile& file) const {
  if (!known()) return;
  const std::string group = "/figures/";
  file.write(group + "window", {first_, last_}, {2}, "s", "First and last sample of the window");
  for (const auto& columns : {nodeColumns(), elementColumns()})
    for (const auto& column : columns)
      file.write(group + column.name, column.values,
                 {static_cast<std::size_t>(column.values.size())}, column.unit, column.longName);
}

void StringFigures::stageTables(io::OutputFolder& folder) const {
  if (!known()) return;
  const auto stage = [&](const std::string& kind, const Vector& depth,
                         const std::vector<Column>& columns) {
    std::vector<io::Csv::Column> header{{kind, ""}, {"s", "m"}};
    for (const auto& column : columns) header.push_back({column.name, column.unit});
    io::Csv table(header);
    for (Eigen::Index i = 0; i < depth.size(); ++i) {
      std::vector<double> row{static_cast<double>(i) + 1.0, depth[i]};
      for (const auto& column : columns) row.push_back(column.values[i]);
      table.row(row);
    }
    table.stage(folder.file("figures_" + kind + "s.csv"));
  };
  stage("node", nodeDepth_, nodeColumns());
  stage("element", elementDepth_, elementColumns());
}

void StringFigures::save(std::vector<double>& memory) const {
  memory.insert(memory.end(),
                {static_cast<double>(samples_), first_, last_, leastWeight_, mostWeight_});
  bit_.save(memory);
  axial_.save(memory);
  lateral_.save(memory);
  orbit_.save(memory);
  contact_.save(memory);
  bending_.save(memory);
}

void StringFigures::restore(const double*& memory) {
  samples_ = static_cast<long>(*memory++);
  first_ = *memory++;
  last_ = *memory++;
  leastWeight_ = *memory++;
  mostWeight_ = *memory++;
  bit_.restore(memory);
  axial_.restore(memory);
  lateral_.restore(memory);
  orbit_.restore(memory);
  contact_.restore(memory);
  bending_.restore(memory);
}

}  // namespace tooljoint::drillstring
