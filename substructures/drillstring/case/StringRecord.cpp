// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drillstring/case/StringRecord.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

#include "common/Constants.hpp"
#include "deck/PrintedUnits.hpp"
#include "substructures/drillstring/case/StringResults.hpp"

namespace tooljoint::drillstring {

namespace {

io::XdmfScene pictureOf(const Scene& scene, const StaticStage& stage) {
  io::XdmfScene out;
  out.positions = stage.path.position;
  out.frames = stage.path.frame;
  for (int i = 0; i < scene.string.nodeCount(); ++i) {
    const auto n = static_cast<std::size_t>(i);
    const auto& element = scene.string.elements[std::min(n, scene.string.elements.size() - 1)];
    out.radius.push_back(element.section().outerRadius());
    out.wallRadius.push_back(scene.well.boreRadius(scene.string.nodes[n].s));
  }
  return out;
}

}  // namespace

StringRecord::StringRecord(const Scene& scene, const StaticStage& stage,
                           const model::SecondOrderModel& model)
    : scene_(scene),
      merits_(scene, stage),
      bit_(scene),
      surface_(scene, stage),
      row_(StringRecord::columns().size()) {
  const auto nodes = static_cast<std::size_t>(scene.string.nodeCount());
  const auto& output = scene.output;
  if (output.xdmf) picture_ = pictureOf(scene, stage);
  watched_.assign(nodes, 0);
  bool touches = false;
  for (const auto& set : model.points) touches = touches || set.name == kContactSet;
  recordsForce_ = output.hasField("normal_force") && touches;
  for (const auto& set : model.points) {
    if (set.name == drilling::bitSet || set.name == drilling::topDriveSet ||
        set.name == drilling::hookSet)
      drilling_.emplace_back(model, set);
    if (set.name != kContactSet) continue;
    for (auto entity : set.entities) watched_[static_cast<std::size_t>(entity - 1)] = 1;
    cases::PointRecord record(model, set);
    const int normalForce = record.find("normal_force");
    if (normalForce >= 0) contacts_.push_back({std::move(record), normalForce});
  }
  normalForce_ = Vector::Zero(static_cast<Eigen::Index>(nodes));
}

std::array<cases::FieldText, 3> StringRecord::fields() const {
  return {{{"m, rad",
            "Displacements from the path state in nodal frames: u, v, w, theta_x, theta_y, "
            "theta_z"},
           {"m/s, rad/s", "Velocities of the displacements"},
           {"m/s2, rad/s2", "Accelerations of the displacements"}}};
}

std::vector<cases::Channel> StringRecord::channels() const {
  std::vector<cases::Channel> out{
      {"/transient/speed", {}, "rad/s", "Rotary speed imposed at the surface", &rotarySpeed_},
      {"/transient/surface_speed", {}, "rad/s", "Speed of the first node", &surface_.speed()},
      {"/transient/surface_torque",
       {},
       "N m",
       "Torque in the uppermost element, against the rotation",
       &surface_.torque()},
      {"/transient/hook_load",
       {},
       "N",
       "What the hook carries, without block",
       &surface_.hookLoad()}};
  if (recordsForce_)
    out.push_back({"/transient/normal_force",
                   {static_cast<std::size_t>(normalForce_.size())},
                   "N",
                   "Normal contact force, positive pushing off the wall",
                   normalForce_.data()});
  for (const auto& one : drilling_)
    for (std::size_t c = 0; c < one.channels().size(); ++c) {
      const auto& channel = one.channels()[c];
      out.push_back({"/transient/" + channel.name,
                     {},
                     channel.unit,
                     channel.longName,
                     one.values(static_cast<int>(c))});
    }
  return out;
}

std::vector<io::Csv::Column> StringRecord::columns() const {
  return {{"time", "s"},
          {"rotary_speed", "rad/s"},
          {"bit_speed", "rad/s"},
          {"bit_w", "m"},
          {"bit_theta_z", "rad"}};
}

void StringRecord::sample(const cases::Sample& sample) {
  rotarySpeed_ = scene_.rotary.speed(sample.t);
  surface_.sample(sample);
  for (auto& one : drilling_) one.sample(sample);
  sampleContact(sample);
  measureBit(sample);
  measureWall(sample.displacement);
  merits_.sample(sample, bit_.at(sample, drilling_), normalForce_);
}

void StringRecord::sampleContact(const cases::Sample& sample) {
  for (auto& contact : contacts_) {
    contact.record.sample(sample);
    const auto& nodes = contact.record.set().entities;
    const double* force = contact.record.values(contact.normalForce);
    for (std::size_t p = 0; p < nodes.size(); ++p) normalForce_(nodes[p] - 1) = force[p];
  }
}

void StringRecord::measureBit(const cases::Sample& sample) {
  const auto last = sample.displacement.size() - 1;  // theta_z of the bit
  const double bit = rotarySpeed_ + sample.velocity(last);
  figures_.minBitSpeed = figures_.samples == 0 ? bit : std::min(figures_.minBitSpeed, bit);
  figures_.maxBitSpeed = figures_.samples == 0 ? bit : std::max(figures_.maxBitSpeed, bit);
  figures_.sumBitSpeed += bit;
  ++figures_.samples;
  row_ = {sample.t, rotarySpeed_, bit, sample.displacement(last - 3), sample.displacement(last)};
}

void StringRecord::measureWall(const Vector& displacement) {
  const auto& points = scene_.contactPoints;
  for (int i = 0; i < points.size(); ++i) {
    const auto p = static_cast<std::size_t>(i);
    const int node = points.node[p] - 1;
    // G = r - j0
    const double penetration =
        std::hypot(displacement(6 * node), displacement(6 * node + 1)) - points.clearance[p];
    figures_.maxPenetration = std::max(figures_.maxPenetration, penetration);
    if (penetration > 0.0 && watched_[static_cast<std::size_t>(node)] == 0) {
      watched_[static_cast<std::size_t>(node)] = 1;
      figures_.missed.push_back(node + 1);
    }
  }
}

void StringRecord::save(std::vector<double>& memory) const {
  memory.insert(memory.end(), {static_cast<double>(figures_.samples), figures_.minBitSpeed,
                               figures_.maxBitSpeed, figures_.sumBitSpeed, figures_.maxPenetration,
                               static_cast<double>(figures_.missed.size())});
  memory.insert(memory.end(), figures_.missed.begin(), figures_.missed.end());
  merits_.save(memory);
}

void StringRecord::restore(const double*& memory) {
  figures_.samples = static_cast<long>(*memory++);
  for (double* figure : {&figures_.minBitSpeed, &figures_.maxBitSpeed, &figures_.sumBitSpeed,
                         &figures_.maxPenetration})
    *figure = *memory++;
  figures_.missed.resize(static_cast<std::size_t>(*memory++));
  for (int& node : figures_.missed) {
    node = static_cast<int>(*memory++);
    watched_[static_cast<std::size_t>(node - 1)] = 1;
  }
  merits_.restore(memory);
}

void StringRecord::summarise(io::Summary& summary) const {
  summary.set("transient.bit_speed_rpm.min",
              figures_.minBitSpeed * constants::rpmPerRadianPerSecond);
  summary.set("transient.bit_speed_rpm.max",
              figures_.maxBitSpeed * constants::rpmPerRadianPerSecond);
  summary.set("transient.bit_speed_rpm.mean",
              figures_.meanBitSpeed() * constants::rpmPerRadianPerSecond);
  summary.set("transient.max_penetration", figures_.maxPenetration);
  merits_.summarise(summary);
}

std::string StringRecord::describe() const {
  const deck::PrintedUnit speed("rpm");
  const std::string text = fmt::format(
      "            bit speed {:.4g} to {:.4g} rpm, mean {:.4g} rpm; largest "
      "penetration {}",
      speed(figures_.minBitSpeed), speed(figures_.maxBitSpeed), speed(figures_.meanBitSpeed()),
      deck::printed(figures_.maxPenetration, "mm", 3));
  return merits_.known() ? text + "\n" + merits_.describe() : text;
}

std::vector<std::string> StringRecord::warnings() const {
  std::vector<std::string> found;
  if (const auto& missed = figures_.missed; !missed.empty())
    found.push_back(
        std::to_string(missed.size()) +
        " nodes reached the wall although contact is evaluated at retained nodes only (node " +
        std::to_string(missed.front()) +
        " first). Retain more nodes, or set Substructures/Contact Nodes to \"All\".");
  for (auto& warning : merits_.warnings()) found.push_back(std::move(warning));
  return found;
}

void StringRecord::complete(double t, io::XdmfFrame& frame) const {
  frame.normalForce = contacts_.empty() ? nullptr : normalForce_.data();
  frame.rotarySpeed = scene_.rotary.speed(t);
}

}  // namespace tooljoint::drillstring
