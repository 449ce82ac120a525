// SPDX-License-Identifier: BSD-3-Clause
#include "app/PartsRecording.hpp"

#include <algorithm>
#include <cmath>

#include "coupling/input/ComponentAxes.hpp"

namespace tooljoint::app {

namespace {

/// Samples between two flushes.
constexpr long flushEvery = 1000;

std::string unitOf(const std::string& component) {
  switch (coupling::kindOf(component)) {
    case coupling::ComponentKind::Translation:
      return "m";
    case coupling::ComponentKind::Rotation:
      return "rad";
    default:
      return "";
  }
}

std::vector<io::Csv::Column> columns(const model::ComponentNames& names) {
  std::vector<io::Csv::Column> out{{"time", "s"}};
  for (const auto& name : names) out.push_back({"max_" + name, unitOf(name)});
  return out;
}

std::string plain(std::string name) {
  std::replace(name.begin(), name.end(), '/', '|');
  return name;
}

}  // namespace

void writePartsModel(const PartsDeck& deck, const model::SecondOrderModel& model,
                     io::ResultsFile& file) {
  std::vector<int> part, node;
  for (auto number : model.recoveryNodes) {
    const auto& name = deck.scene.nodes.at(number).front();
    part.push_back(name.part + 1);
    node.push_back(static_cast<int>(name.node));
  }
  std::vector<std::string> names, units;
  for (const auto& one : deck.scene.parts) names.push_back(one.name);
  for (const auto& name : model.componentNames) units.push_back(unitOf(name));
  const std::size_t count = node.size();
  file.write("/model/part_names", names, "Parts in the order of the deck");
  file.write("/model/components", model.componentNames, "Components of a node");
  file.write(
      "/model/component_units", units,
      "Unit of each component; empty where its name tells neither a translation nor a rotation");
  file.write("/model/part", part, {count}, "1",
             "Part of each node, counted from 1; the first one of a joined node");
  file.write("/model/node", node, {count}, "1", "Number of each node in that part");
}

PartsRecorder::PartsRecorder(const PartsDeck& deck, const model::SecondOrderModel& model,
                             io::ResultsFile& file)
    : model_(model), file_(file), table_(file, columns(model.componentNames)) {
  const auto nodes = model.recoveryNodes.size(), width = model.componentNames.size();
  time_ = &file.series("/transient/time", {}, "s", "Time of the samples");
  const auto& output = deck.output;
  if (output.hasField("displacement"))
    displacementSeries_ =
        add("/transient/displacement", nodes, width, "m, rad", "Displacements in the common frame");
  if (output.hasField("velocity"))
    velocitySeries_ = add("/transient/velocity", nodes, width, "m/s, rad/s", "Velocities");
  if (output.hasField("acceleration"))
    accelerationSeries_ =
        add("/transient/acceleration", nodes, width, "m/s2, rad/s2", "Accelerations");
  if (!output.hasField("normal_force")) return;
  for (const auto& set : model.points) {
    Points points{&set, {}, set.offset, set.offset, {}};
    const auto channels = set.law->channels();
    for (const auto& channel : channels)
      points.channels.push_back(add("/transient/" + plain(set.name) + "/" + channel.name,
                                    static_cast<std::size_t>(set.law->size()), 0, channel.unit,
                                    channel.longName));
    points.values.resize(static_cast<Eigen::Index>(channels.size()) * set.law->size());
    points_.push_back(std::move(points));
  }
}

io::TimeSeries* PartsRecorder::add(const std::string& path, std::size_t rows, std::size_t columns,
                                   const std::string& unit, const std::string& longName) {
  return &file_.series(path, columns > 0 ? io::Shape{rows, columns} : io::Shape{rows}, unit,
                       longName);
}

void PartsRecorder::save(std::vector<double>& memory) const {
  memory.insert(memory.end(), {largest_, static_cast<double>(samples_)});
}

void PartsRecorder::restore(const double*& memory) {
  largest_ = *memory++;
  samples_ = static_cast<long>(*memory++);
}

void PartsRecorder::sample(double t, const Vector& q, const Vector& qDot, const Vector& qDDot) {
  displacement_ = model_.recoveryOffset + model_.recovery * q;
  measure(t, displacement_.data());
  if (displacementSeries_) displacementSeries_->append(displacement_.data());
  if (velocitySeries_) velocitySeries_->append(Vector(model_.recovery * qDot).data());
  if (accelerationSeries_) accelerationSeries_->append(Vector(model_.recovery * qDDot).data());
  for (auto& points : points_) {
    points.d = points.set->offset + points.set->rows * q;
    points.v = points.set->rows * qDot;
    points.set->law->record(t, points.d.data(), points.v.data(), points.values.data());
    for (std::size_t c = 0; c < points.channels.size(); ++c)
      points.channels[c]->append(points.values.data() +
                                 c * static_cast<std::size_t>(points.set->law->size()));
  }
}

void PartsRecorder::measure(double t, const double* displacement) {
  time_->append(t);
  const auto width = model_.componentNames.size();
  std::vector<double> row(width + 1, 0.0);
  row[0] = t;
  for (std::size_t i = 0; i < model_.recoveryNodes.size() * width; ++i)
    row[1 + i % width] = std::max(row[1 + i % width], std::abs(displacement[i]));
  for (std::size_t c = 1; c < row.size(); ++c) largest_ = std::max(largest_, row[c]);
  table_.row(row);
  if (++samples_ % flushEvery == 0) file_.flush();
}

}  // namespace tooljoint::app
