// SPDX-License-Identifier: BSD-3-Clause
#include "io/Xdmf.hpp"

#include <cmath>

#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "common/Text.hpp"

namespace tooljoint::io {
namespace {

using constants::twoPi;

std::string number(std::size_t value) { return std::to_string(value); }

std::string escaped(const std::string& text) {
  std::string out;
  for (char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

/// A whole dataset of the results file.
std::string dataItem(const std::string& file, const std::string& path,
                     const std::string& dimensions, const std::string& type) {
  return "<DataItem Format=\"HDF\" Dimensions=\"" + dimensions + "\" " + type + ">" +
         escaped(file) + ":" + path + "</DataItem>";
}

const char* const realType = "NumberType=\"Float\" Precision=\"8\"";
const char* const integerType = "NumberType=\"Int\" Precision=\"4\"";

/// Row `sample` of a growing dataset of the results file, samples x nodes (x 3).
std::string slice(const std::string& file, const std::string& path, std::size_t sample,
                  std::size_t samples, std::size_t nodes, bool vector) {
  const std::string tail = number(nodes) + (vector ? " 3" : "");
  const std::string start = number(sample) + " 0" + (vector ? " 0" : "");
  const std::string stride = std::string("1 1") + (vector ? " 1" : "");
  return "<DataItem ItemType=\"HyperSlab\" Dimensions=\"1 " + tail +
         "\"><DataItem Format=\"XML\" Dimensions=\"3 " + (vector ? "3" : "2") +
         "\" NumberType=\"Int\">" + start + " " + stride + " 1 " + tail + "</DataItem>" +
         dataItem(file, path, number(samples) + " " + tail, realType) + "</DataItem>";
}

std::string attribute(const std::string& name, bool vector, const std::string& data) {
  return "        <Attribute Name=\"" + name + "\" AttributeType=\"" +
         (vector ? "Vector" : "Scalar") + "\" Center=\"Node\">" + data + "</Attribute>\n";
}

void requireSize(std::size_t given, std::size_t nodes, const char* what) {
  if (given != nodes) {
    throw Error(ExitCode::Internal, std::string("The picture of ") + number(nodes) +
                                        " nodes was given " + number(given) + " " + what + ".");
  }
}

}  // namespace

XdmfRecorder::XdmfRecorder(ResultsFile& file, const XdmfScene& scene, double interval)
    : file_(file), frames_(scene.frames), interval_(interval), hasRadius_(!scene.radius.empty()) {
  const std::size_t nodes = scene.positions.size();
  requireSize(scene.frames.size(), nodes, "frames");
  if (hasRadius_) requireSize(scene.radius.size(), nodes, "radii");
  std::vector<double> positions;
  std::vector<int> line;
  for (const auto& x : scene.positions) {
    positions.insert(positions.end(), x.data(), x.data() + 3);
    line.push_back(static_cast<int>(line.size()));
  }
  file.write("/xdmf/position", positions, {nodes, 3}, "m",
             "Positions of the nodes on the axis of the channel, global frame");
  file.write("/xdmf/line", line, {nodes}, "1", "Nodes of the chain in order, counted from 0");
  if (hasRadius_)
    file.write("/xdmf/radius", scene.radius, {nodes}, "m", "Outer radius at the nodes");
  if (!scene.wallRadius.empty()) {
    requireSize(scene.wallRadius.size(), nodes, "wall radii");
    writeWall(file, scene);
  }
}

/// Writes a ring of points around each node in its x-y plane, and quadrilaterals between
/// neighbouring rings.
void XdmfRecorder::writeWall(ResultsFile& file, const XdmfScene& scene) {
  const std::size_t nodes = scene.positions.size();
  const auto sectors = static_cast<std::size_t>(scene.wallSectors);
  std::vector<double> points;
  std::vector<int> facets;
  for (std::size_t n = 0; n < nodes; ++n) {
    for (std::size_t s = 0; s < sectors; ++s) {
      const double angle = twoPi * static_cast<double>(s) / static_cast<double>(sectors);
      const Vector3 x =
          scene.positions[n] + scene.wallRadius[n] * (std::cos(angle) * scene.frames[n].col(0) +
                                                      std::sin(angle) * scene.frames[n].col(1));
      points.insert(points.end(), x.data(), x.data() + 3);
      if (n + 1 == nodes) continue;
      const std::size_t next = (s + 1) % sectors;
      for (std::size_t corner :
           {n * sectors + s, n * sectors + next, (n + 1) * sectors + next, (n + 1) * sectors + s}) {
        facets.push_back(static_cast<int>(corner));
      }
    }
  }
  wallPoints_ = nodes * sectors;
  wallFacets_ = facets.size() / 4;
  file.write("/xdmf/wall_position", points, {wallPoints_, 3}, "m",
             "Points of the wall of the channel, global frame");
  file.write("/xdmf/wall_facets", facets, {wallFacets_, 4}, "1",
             "Corners of the quadrilaterals of the wall, points counted from 0");
}

bool XdmfRecorder::due(double time) const {
  // half a part in a million of the interval allows for rounding of accumulated times
  return times_.empty() || time >= times_.back() + interval_ * (1.0 - 5e-7);
}

void XdmfRecorder::addSeries(const XdmfFrame& first) {
  const std::size_t nodes = frames_.size();
  time_ = &file_.series("/xdmf/time", {}, "s", "Times of the pictures");
  if (first.displacement != nullptr) {
    displacement_ = &file_.series("/xdmf/displacement", {nodes, 3}, "m",
                                  "Displacement of the nodes from the axis, global frame");
  }
  if (first.velocity != nullptr) {
    speed_ = &file_.series("/xdmf/speed", {nodes}, "m/s",
                           "Length of the translational velocity of the nodes");
    spin_ = &file_.series("/xdmf/spin", {nodes}, "rad/s",
                          "Speed of rotation of the nodes about the axis");
  }
  if (first.normalForce != nullptr)
    normalForce_ =
        &file_.series("/xdmf/normal_force", {nodes}, "N", "Normal contact force on the nodes");
}

void XdmfRecorder::save(std::vector<double>& memory) const {
  memory.push_back(static_cast<double>(times_.size()));
  memory.insert(memory.end(), times_.begin(), times_.end());
}

void XdmfRecorder::restore(const double*& memory, const XdmfFrame& frame) {
  times_.resize(static_cast<std::size_t>(*memory++));
  for (double& time : times_) time = *memory++;
  if (!times_.empty()) addSeries(frame);
}

void XdmfRecorder::append(const XdmfFrame& frame) {
  if (!due(frame.time)) return;
  if (time_ == nullptr) addSeries(frame);
  const auto sameFields = [](const void* given, const void* recorded) {
    return (given != nullptr) == (recorded != nullptr);
  };
  if (!sameFields(frame.displacement, displacement_) || !sameFields(frame.velocity, speed_) ||
      !sameFields(frame.normalForce, normalForce_)) {
    throw Error(ExitCode::Internal,
                "The pictures for ParaView must have the same fields at all times.");
  }
  const std::size_t nodes = frames_.size();
  time_->append(frame.time);
  if (displacement_ != nullptr) {
    row_.resize(3 * nodes);
    for (std::size_t n = 0; n < nodes; ++n) {  // d_global = Q d_nodal
      Eigen::Map<Vector3>(row_.data() + 3 * n) =
          frames_[n] * Eigen::Map<const Vector3>(frame.displacement + 6 * n);
    }
    displacement_->append(row_.data());
  }
  if (speed_ != nullptr) {
    row_.resize(nodes);
    for (std::size_t n = 0; n < nodes; ++n)
      row_[n] = Eigen::Map<const Vector3>(frame.velocity + 6 * n).norm();
    speed_->append(row_.data());
    for (std::size_t n = 0; n < nodes; ++n) row_[n] = frame.rotarySpeed + frame.velocity[6 * n + 5];
    spin_->append(row_.data());
  }
  if (normalForce_ != nullptr) normalForce_->append(frame.normalForce);
  times_.push_back(frame.time);
}

std::string XdmfRecorder::text(const std::string& results) const {
  const std::size_t nodes = frames_.size();
  const std::string count = number(nodes);
  const std::string chain =
      "        <Topology TopologyType=\"Polyline\" NumberOfElements=\"1\" NodesPerElement=\"" +
      count + "\">" + dataItem(results, "/xdmf/line", "1 " + count, integerType) +
      "</Topology>\n        <Geometry GeometryType=\"XYZ\">" +
      dataItem(results, "/xdmf/position", count + " 3", realType) + "</Geometry>\n";
  std::string out =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<!DOCTYPE Xdmf SYSTEM \"Xdmf.dtd\" []>\n<Xdmf "
      "Version=\"2.0\">\n  <Domain>\n"
      "    <Grid Name=\"chain\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
  for (std::size_t i = 0; i < times_.size(); ++i) {
    out += "      <Grid Name=\"chain\" GridType=\"Uniform\">\n        <Time Value=\"" +
           formatNumber(times_[i]) + "\"/>\n" + chain;
    const auto add = [&](const char* name, const TimeSeries* series, bool vector) {
      if (series == nullptr) return;
      out +=
          attribute(name, vector,
                    slice(results, std::string("/xdmf/") + name, i, times_.size(), nodes, vector));
    };
    add("displacement", displacement_, true);
    add("speed", speed_, false);
    add("spin", spin_, false);
    add("normal_force", normalForce_, false);
    if (hasRadius_)
      out += attribute("radius", false, dataItem(results, "/xdmf/radius", count, realType));
    out += "      </Grid>\n";
  }
  out += "    </Grid>\n";
  if (wallFacets_ > 0) {
    out +=
        "    <Grid Name=\"wall\" GridType=\"Uniform\">\n      <Topology "
        "TopologyType=\"Quadrilateral\" NumberOfElements=\"" +
        number(wallFacets_) + "\">" +
        dataItem(results, "/xdmf/wall_facets", number(wallFacets_) + " 4", integerType) +
        "</Topology>\n      <Geometry GeometryType=\"XYZ\">" +
        dataItem(results, "/xdmf/wall_position", number(wallPoints_) + " 3", realType) +
        "</Geometry>\n    </Grid>\n";
  }
  return out + "  </Domain>\n</Xdmf>\n";
}

}  // namespace tooljoint::io
