// SPDX-License-Identifier: BSD-3-Clause
#include "app/Recording.hpp"

#include <algorithm>
#include <cmath>

#include "io/TextFile.hpp"

namespace tooljoint::app {

namespace {

io::XdmfScene picture(const Scene& scene, const StaticStage& stage) {
  io::XdmfScene out;
  out.positions = stage.path.position;
  out.frames = stage.path.frame;
  for (int i = 0; i < scene.string.nodeCount(); ++i) {
    const auto n = static_cast<std::size_t>(i);
    const auto& element = scene.string.elements[std::min(n, scene.string.elements.size() - 1)];
    out.radius.push_back(element.section.outerRadius());
    out.wallRadius.push_back(scene.well.boreRadius(scene.string.nodes[n].s));
  }
  return out;
}

}  // namespace

MotionRecorder::MotionRecorder(const Scene& scene, const StaticStage& stage,
                               const model::SecondOrderModel& model, io::ResultsFile& file)
    : scene_(scene),
      model_(model),
      recovery_(model.recovery),
      file_(file),
      table_(file, {{"time", "s"},
                    {"rotary_speed", "rad/s"},
                    {"bit_speed", "rad/s"},
                    {"bit_w", "m"},
                    {"bit_theta_z", "rad"}}) {
  const auto nodes = static_cast<std::size_t>(scene.string.nodeCount());
  const auto& output = scene.output;
  time_ = &file.series("/transient/time", {}, "s", "Time of the samples");
  speed_ = &file.series("/transient/speed", {}, "rad/s", "Rotary speed imposed at the surface");
  if (output.hasField("displacement"))
    displacementSeries_ = &file.series(
        "/transient/displacement", {nodes, 6}, "m, rad",
        "Displacements from the path state in nodal frames: u, v, w, theta_x, theta_y, theta_z");
  if (output.hasField("velocity"))
    velocitySeries_ = &file.series("/transient/velocity", {nodes, 6}, "m/s, rad/s",
                                   "Velocities of the displacements");
  if (output.hasField("acceleration"))
    accelerationSeries_ = &file.series("/transient/acceleration", {nodes, 6}, "m/s2, rad/s2",
                                       "Accelerations of the displacements");
  const bool touches = std::any_of(model.points.begin(), model.points.end(),
                                   [](const auto& set) { return set.name == kContactSet; });
  if (output.hasField("normal_force") && touches)
    forceSeries_ = &file.series("/transient/normal_force", {nodes}, "N",
                                "Normal contact force, positive pushing off the wall");
  if (output.xdmf)
    xdmf_ = std::make_unique<io::XdmfRecorder>(file, picture(scene, stage), output.xdmfInterval);

  const bool forces = forceSeries_ != nullptr || xdmf_ != nullptr;
  watched_.assign(nodes, 0);
  for (const auto& set : model.points) {
    if (set.name != kContactSet) continue;
    for (auto entity : set.entities) watched_[static_cast<std::size_t>(entity - 1)] = 1;
    if (!forces) continue;
    Contact contact{&set, -1, linalg::GroupedRows(set.rows), set.offset, set.offset, {}};
    const auto channels = set.law->channels();
    for (std::size_t c = 0; c < channels.size(); ++c)
      if (channels[c].name == "normal_force") contact.normalForce = static_cast<int>(c);
    contact.channels.resize(static_cast<Eigen::Index>(channels.size()) * set.law->size());
    contacts_.push_back(std::move(contact));
  }
  normalForce_ = Vector::Zero(static_cast<Eigen::Index>(nodes));
  const auto& transient = scene.list().sublist("Transient");
  flushInterval_ = 0.1 * (transient.get<double>("End Time") - transient.get<double>("Start Time"));
  nextFlush_ = transient.get<double>("Start Time") + flushInterval_;
}

void MotionRecorder::sample(double t, const Vector& q, const Vector& qDot, const Vector& qDDot) {
  recovery_.multiply(q, displacement_);
  displacement_ += model_.recoveryOffset;
  recovery_.multiply(qDot, velocity_);
  if (accelerationSeries_) recovery_.multiply(qDDot, acceleration_);
  recordContact(t, q, qDot);
  measure(t);
  time_->append(t);
  speed_->append(scene_.rotary.speed(t));
  if (displacementSeries_) displacementSeries_->append(displacement_.data());
  if (velocitySeries_) velocitySeries_->append(velocity_.data());
  if (accelerationSeries_) accelerationSeries_->append(acceleration_.data());
  if (forceSeries_) forceSeries_->append(normalForce_.data());
  if (xdmf_ && xdmf_->due(t)) xdmf_->append(frame(t));
  if (t >= nextFlush_) file_.flush();
  while (t >= nextFlush_) nextFlush_ += flushInterval_;
}

io::XdmfFrame MotionRecorder::frame(double t) const {
  io::XdmfFrame out;
  out.time = t;
  out.displacement = displacement_.data();
  out.velocity = velocity_.data();
  out.normalForce = contacts_.empty() ? nullptr : normalForce_.data();
  out.rotarySpeed = scene_.rotary.speed(t);
  return out;
}

void MotionRecorder::save(std::vector<double>& memory) const {
  memory.insert(memory.end(), {static_cast<double>(figures_.samples), figures_.minBitSpeed,
                               figures_.maxBitSpeed, figures_.sumBitSpeed, figures_.maxPenetration,
                               static_cast<double>(figures_.missed.size())});
  memory.insert(memory.end(), figures_.missed.begin(), figures_.missed.end());
  if (xdmf_) xdmf_->save(memory);
}

void MotionRecorder::restore(const double*& memory) {
  figures_.samples = static_cast<long>(*memory++);
  for (double* figure : {&figures_.minBitSpeed, &figures_.maxBitSpeed, &figures_.sumBitSpeed,
                         &figures_.maxPenetration})
    *figure = *memory++;
  figures_.missed.resize(static_cast<std::size_t>(*memory++));
  for (int& node : figures_.missed) {
    node = static_cast<int>(*memory++);
    watched_[static_cast<std::size_t>(node - 1)] = 1;
  }
  // only which fields a picture has matters here
  displacement_ = velocity_ = Vector::Zero(1);
  if (xdmf_) xdmf_->restore(memory, frame(0.0));
}

void MotionRecorder::stagePictures(io::OutputFolder& folder) const {
  io::stageText(folder.file("results.xdmf"), xdmf_->text("results.h5"));
}

void MotionRecorder::recordContact(double t, const Vector& q, const Vector& qDot) {
  for (auto& contact : contacts_) {
    if (contact.normalForce < 0) continue;
    contact.rows.multiply(q, contact.d);
    contact.d += contact.set->offset;
    contact.rows.multiply(qDot, contact.v);
    contact.set->law->record(t, contact.d.data(), contact.v.data(), contact.channels.data());
    const int size = contact.set->law->size();
    for (int p = 0; p < size; ++p)
      normalForce_(contact.set->entities[static_cast<std::size_t>(p)] - 1) =
          contact.channels(contact.normalForce * size + p);
  }
}

void MotionRecorder::measure(double t) {
  const auto last = displacement_.size() - 1;  // theta_z of the bit
  const double bit = scene_.rotary.speed(t) + velocity_(last);
  figures_.minBitSpeed = figures_.samples == 0 ? bit : std::min(figures_.minBitSpeed, bit);
  figures_.maxBitSpeed = figures_.samples == 0 ? bit : std::max(figures_.maxBitSpeed, bit);
  figures_.sumBitSpeed += bit;
  ++figures_.samples;
  table_.row({t, scene_.rotary.speed(t), bit, displacement_(last - 3), displacement_(last)});
  const auto& points = scene_.contactPoints;
  for (int i = 0; i < points.size(); ++i) {
    const auto p = static_cast<std::size_t>(i);
    const int node = points.node[p] - 1;
    // G = r - j0
    const double penetration =
        std::hypot(displacement_(6 * node), displacement_(6 * node + 1)) - points.clearance[p];
    figures_.maxPenetration = std::max(figures_.maxPenetration, penetration);
    if (penetration > 0.0 && watched_[static_cast<std::size_t>(node)] == 0) {
      watched_[static_cast<std::size_t>(node)] = 1;
      figures_.missed.push_back(node + 1);
    }
  }
}

}  // namespace tooljoint::app
