// SPDX-License-Identifier: BSD-3-Clause
#include "cases/imported/ImportedRecord.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "coupling/input/ComponentAxes.hpp"

namespace tooljoint::cases {

namespace {

/// A name as part of a path of the results file.
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

ImportedRecord::ImportedRecord(const model::SecondOrderModel& model, bool forces)
    : components_(model.componentNames), row_(model.componentNames.size() + 1, 0.0) {
  if (!forces) return;
  for (const auto& set : model.points) points_.emplace_back(model, set);
}

std::array<FieldText, 3> ImportedRecord::fields() const {
  return {{{"m, rad", "Displacements in the common frame"},
           {"m/s, rad/s", "Velocities"},
           {"m/s2, rad/s2", "Accelerations"}}};
}

std::vector<Channel> ImportedRecord::channels() const {
  std::vector<Channel> out;
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
  largest_ = std::max(largest_, *std::max_element(row_.begin() + 1, row_.end()));
  for (auto& points : points_) points.sample(sample);
}

void ImportedRecord::save(std::vector<double>& memory) const { memory.push_back(largest_); }

void ImportedRecord::restore(const double*& memory) { largest_ = *memory++; }

void ImportedRecord::summarise(io::Summary& summary) const {
  summary.set("transient.max_displacement", largest_);
}

std::string ImportedRecord::describe() const {
  char text[100];
  std::snprintf(text, sizeof text, "            largest displacement %.4g", largest_);
  return text;
}

}  // namespace tooljoint::cases
