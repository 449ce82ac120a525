// SPDX-License-Identifier: BSD-3-Clause
#include "cases/imported/ImportedRecord.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <utility>

#include "cases/imported/MeasuredComponents.hpp"
#include "common/Text.hpp"
#include "coupling/input/ComponentAxes.hpp"
#include "deck/PrintedUnits.hpp"

namespace tooljoint::cases {

namespace {

/// Converts a name to a component of a path in the results file.
std::string pathName(std::string name) {
  std::replace(name.begin(), name.end(), '/', '|');
  return name;
}

}  // namespace

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

ImportedRecord::ImportedRecord(const model::SecondOrderModel& model, bool forces,
                               const FigureWindow& window, NodeNames names)
    : model_(model),
      components_(model.componentNames),
      recordsForces_(forces),
      row_(model.componentNames.size() + 1, 0.0),
      largest_(model.componentNames.size(), 0.0),
      window_(window),
      names_(std::move(names)),
      measured_(measuredComponents(model.componentNames)),
      displacement_(static_cast<Eigen::Index>(model.recoveryNodes.size())),
      acceleration_(displacement_) {
  for (const auto& set : model.points) {
    PointRecord record(model, set);
    const int force = record.find("stop_force");
    if (force >= 0) stops_.push_back({points_.size(), force, ContactFigures(set.law->size())});
    if (forces || force >= 0) points_.push_back(std::move(record));
  }
}

std::array<FieldText, 3> ImportedRecord::fields() const {
  return {{{"m, rad", "Displacements in the common frame"},
           {"m/s, rad/s", "Velocities"},
           {"m/s2, rad/s2", "Accelerations"}}};
}

std::vector<Channel> ImportedRecord::channels() const {
  std::vector<Channel> out;
  if (!recordsForces_) return out;
  for (const auto& points : points_)
    for (std::size_t c = 0; c < points.channels().size(); ++c) {
      const auto& channel = points.channels()[c];
      out.push_back({"/transient/" + pathName(points.set().name) + "/" + channel.name,
                     {static_cast<std::size_t>(points.set().law->size())},
                     channel.unit,
                     channel.longName,
                     points.values(static_cast<int>(c))});
    }
  return out;
}

std::vector<io::Csv::Column> ImportedRecord::columns() const {
  std::vector<io::Csv::Column> out{{"time", "s"}};
  for (const auto& name : components_) out.push_back({"max_" + name, unitOf(name)});
  return out;
}

void ImportedRecord::sample(const Sample& sample) {
  const std::size_t width = components_.size();
  row_.assign(width + 1, 0.0);
  row_[0] = sample.t;
  for (Eigen::Index i = 0; i < sample.displacement.size(); ++i) {
    auto& largest = row_[1 + static_cast<std::size_t>(i) % width];
    largest = std::max(largest, std::abs(sample.displacement[i]));
  }
  for (std::size_t c = 0; c < width; ++c) largest_[c] = std::max(largest_[c], row_[c + 1]);
  for (auto& points : points_) points.sample(sample);
  if (window_.contains(sample.t)) measure(sample);
}

void ImportedRecord::measure(const Sample& sample) {
  if (samples_ == 0) first_ = sample.t;
  last_ = sample.t;
  ++samples_;
  const auto width = static_cast<Eigen::Index>(components_.size());
  const auto magnitudes = [&](const Vector& motion) {
    Vector out = Vector::Zero(motion.size() / width);
    for (Eigen::Index node = 0; node < out.size(); ++node)
      for (int c : measured_) out[node] += motion[width * node + c] * motion[width * node + c];
    return Vector(out.cwiseSqrt());
  };
  displacement_.add(magnitudes(sample.displacement));
  acceleration_.add(magnitudes(sample.acceleration));
  for (auto& stop : stops_)
    stop.figures.add(Eigen::Map<const Vector>(points_[stop.record].values(stop.force),
                                              stop.figures.peak().size()));
}

void ImportedRecord::save(std::vector<double>& memory) const {
  memory.insert(memory.end(), largest_.begin(), largest_.end());
  memory.insert(memory.end(), {static_cast<double>(samples_), first_, last_});
  displacement_.save(memory);
  acceleration_.save(memory);
  for (const auto& stop : stops_) stop.figures.save(memory);
}

void ImportedRecord::restore(const double*& memory) {
  for (double& largest : largest_) largest = *memory++;
  samples_ = static_cast<long>(*memory++);
  first_ = *memory++;
  last_ = *memory++;
  displacement_.restore(memory);
  acceleration_.restore(memory);
  for (auto& stop : stops_) stop.figures.restore(memory);
}

std::map<std::string, double> ImportedRecord::largestByUnit() const {
  std::map<std::string, double> found;
  for (std::size_t c = 0; c < components_.size(); ++c) {
    double& largest = found[unitOf(components_[c])];
    largest = std::max(largest, largest_[c]);
  }
  return found;
}

void ImportedRecord::summarise(io::Summary& summary) const {
  const std::map<std::string, const char*> keys{
      {"m", "max_displacement"}, {"rad", "max_rotation"}, {"", "max_coordinate"}};
  for (const auto& [unit, largest] : largestByUnit())
    summary.set(std::string("transient.") + keys.at(unit), largest);
  if (samples_ == 0 || displacement_.peak().size() == 0) return;
  summary.set("transient.figures.begin", first_);
  summary.set("transient.figures.end", last_);
  summary.set("transient.figures.samples", samples_);
  summarise("transient.figures.displacement", displacement_, summary);
  summarise("transient.figures.acceleration", acceleration_, summary);
  if (!stops_.empty()) summariseStops(summary);
}

void ImportedRecord::summariseStops(io::Summary& summary) const {
  double duty = 0.0, force = 0.0, peak = -1.0;
  Eigen::Index points = 0;
  std::string where;
  for (const auto& stop : stops_) {
    duty += stop.figures.duty().sum();
    force += stop.figures.mean().sum();
    points += stop.figures.peak().size();
    if (!(stop.figures.peak().maxCoeff() > peak)) continue;
    peak = stop.figures.peak().maxCoeff();
    where = points_[stop.record].set().name;
  }
  const std::string key = "transient.figures.contact.";
  summary.set(key + "duty", duty / static_cast<double>(points));
  summary.set(key + "total_force_mean", force);
  summary.set(key + "force_peak", peak);
  summary.set(key + "force_peak_stop", where);
}

void ImportedRecord::summarise(const std::string& key, const MagnitudeFigures& figures,
                               io::Summary& summary) const {
  const auto peak = worst(figures.peak());
  const auto [part, node] = names_(model_.recoveryNodes[static_cast<std::size_t>(peak.row)]);
  summary.set(key + ".rms", figures.overallRms());
  summary.set(key + ".peak", peak.value);
  summary.set(key + ".peak_part", part);
  summary.set(key + ".peak_node", node);
}

void ImportedRecord::write(io::ResultsFile& file) const {
  if (samples_ == 0) return;
  const std::string group = "/figures/";
  file.write(group + "window", {first_, last_}, {2}, "s", "First and last sample of the window");
  const auto write = [&](const std::string& name, const Vector& values, const char* unit,
                         const char* text) {
    file.write(group + name, values, {static_cast<std::size_t>(values.size())}, unit, text);
  };
  // without translations all components count
  const bool lengths = unitOf(components_[static_cast<std::size_t>(measured_.front())]) == "m";
  write("displacement_rms", displacement_.rms(), lengths ? "m" : "m, rad",
        "Root mean square of the displacement of a node");
  write("displacement_peak", displacement_.peak(), lengths ? "m" : "m, rad",
        "Largest displacement of a node");
  write("acceleration_rms", acceleration_.rms(), lengths ? "m/s2" : "m/s2, rad/s2",
        "Root mean square of the acceleration of a node");
  write("acceleration_peak", acceleration_.peak(), lengths ? "m/s2" : "m/s2, rad/s2",
        "Largest acceleration of a node");
  for (const auto& stop : stops_) {
    const auto name = pathName(points_[stop.record].set().name) + "/";
    write(name + "contact_duty", stop.figures.duty(), "1", "Share of time in contact");
    write(name + "contact_force_mean", stop.figures.mean(), "N", "Mean force, 0 where open");
    write(name + "contact_force_peak", stop.figures.peak(), "N", "Largest force");
  }
}

std::string ImportedRecord::describe() const {
  constexpr int digits = 4;
  const std::map<std::string, const char*> names{
      {"m", "displacement "}, {"rad", "rotation "}, {"", "coordinate "}};
  std::vector<std::string> found;
  for (const auto& [unit, largest] : largestByUnit())
    found.push_back(names.at(unit) + (unit.empty() ? fmt::format("{:.{}g}", largest, digits)
                                                   : deck::printed(largest, unit, digits)));
  return "            largest " + join(found, ", ");
}

}  // namespace tooljoint::cases
