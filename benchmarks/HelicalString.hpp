// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A drillstring of the size and make of the reference scene (163 nodes, 972 dofs, contact and
/// friction at 161 nodes, gyroscopic and two mud damping terms), put together without path and
/// static stage so that a benchmark starts at once: the string lies in a bore that curves at 1/108
/// m, inclined 52 degrees, and is bent into nodal frames element by element. Its motion is not that
/// of the reference scene; its arithmetic is.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <memory>
#include <vector>

#include "common/Constants.hpp"
#include "model/SecondOrderModel.hpp"
#include "substructures/beam/BeamMatrices.hpp"
#include "substructures/contact/ContactLaw.hpp"

namespace tooljoint::benchmarks {

/// Element lengths and outer radii from the surface down: six pipes with tool joints between them,
/// 15 parts of bottom-hole assembly.
struct Mesh {
  std::vector<double> length, outer, inner;
  void add(int elements, double total, double outerRadius, double innerRadius) {
    for (int i = 0; i < elements; ++i)
      length.push_back(total / elements), outer.push_back(outerRadius),
          inner.push_back(innerRadius);
  }
};

inline Mesh referenceMesh() {
  Mesh mesh;
  for (int pipe = 0; pipe < 6; ++pipe) {
    mesh.add(5, 9.0, 0.0635, 0.054);
    mesh.add(1, 0.2, 0.0635, 0.054);
    mesh.add(1, 0.3, 0.081, 0.048);
    mesh.add(1, pipe < 5 ? 0.3 : 0.2, pipe < 5 ? 0.081 : 0.0635, pipe < 5 ? 0.048 : 0.054);
    if (pipe < 5) mesh.add(1, 0.2, 0.0635, 0.054);
  }
  for (int collars : {3, 4, 3}) {
    for (int c = 0; c < collars; ++c) mesh.add(10, 10.0, 0.0795, 0.0355);
    mesh.add(collars == 3 && mesh.length.size() > 120 ? 1 : 4,
             collars == 3 && mesh.length.size() > 120 ? 0.5 : 5.0, 0.0795, 0.0355);
  }
  return mesh;
}

/// Repeats the mesh until it has at least `elements` elements.
inline Mesh longMesh(std::size_t elements) {
  Mesh mesh;
  const Mesh unit = referenceMesh();
  while (mesh.length.size() < elements)
    for (std::size_t e = 0; e < unit.length.size(); ++e)
      mesh.add(1, unit.length[e], unit.outer[e], unit.inner[e]);
  return mesh;
}

inline double rotarySpeed(double t) { return 4 * constants::pi * (1 - std::exp(-6 * t)); }

/// \param steady  constant rotary speed from the start (no matrix changes with time)
inline model::SecondOrderModel helicalString(const Mesh& mesh, bool steady) {
  const int elements = static_cast<int>(mesh.length.size());
  const int nodes = elements + 1;
  const double bore = 0.108, curvature = 1 / 108.0, fluid = 1200;
  std::vector<Matrix3> frame;
  std::vector<double> clearance(static_cast<std::size_t>(nodes), 1.0),
      radius(static_cast<std::size_t>(nodes), 0.1);
  double s = 0;
  for (int i = 0; i < nodes; ++i) {
    frame.push_back((Eigen::AngleAxisd(0.3 + 0.002 * s, Vector3::UnitX()) *
                     Eigen::AngleAxisd(0.9 + curvature * s, Vector3::UnitY()))
                        .toRotationMatrix());
    if (i < elements) s += mesh.length[static_cast<std::size_t>(i)];
    for (int e : {i - 1, i})
      if (e >= 0 && e < elements &&
          bore - mesh.outer[static_cast<std::size_t>(e)] < clearance[static_cast<std::size_t>(i)]) {
        clearance[static_cast<std::size_t>(i)] = bore - mesh.outer[static_cast<std::size_t>(e)];
        radius[static_cast<std::size_t>(i)] = mesh.outer[static_cast<std::size_t>(e)];
      }
  }
  std::vector<int> dof(static_cast<std::size_t>(6 * nodes), -1);
  model::SecondOrderModel model;
  model.componentNames = {"u", "v", "w", "theta_x", "theta_y", "theta_z"};
  for (int i = 0; i < nodes; ++i)
    for (int c = 0; c < 6; ++c) {
      if ((i == 0 && (c < 3 || c == 5)) || (i == nodes - 1 && c < 2)) continue;
      dof[static_cast<std::size_t>(6 * i + c)] = static_cast<int>(model.dofs.size());
      model.dofs.push_back(model::DofLabel::physical(i + 1, c));
    }
  const int n = static_cast<int>(model.dofs.size());
  Triplets m, c0, gyroscopic, drag, k;
  Vector weight = Vector::Zero(n), spin = Vector::Zero(n);
  const auto scatter = [&](Triplets& to, int e, const beam::Matrix12& a) {
    for (int i = 0; i < 12; ++i)
      for (int j = 0; j < 12; ++j) {
        const int row = dof[static_cast<std::size_t>(6 * e + i)],
                  column = dof[static_cast<std::size_t>(6 * e + j)];
        if (row >= 0 && column >= 0) to.emplace_back(row, column, a(i, j));
      }
  };
  for (int e = 0; e < elements; ++e) {
    const auto ez = static_cast<std::size_t>(e);
    const double l = mesh.length[ez];
    const auto section =
        beam::Section::hollow(mesh.outer[ez], mesh.inner[ez], {7900, 2.03e11, 0.3});
    Matrix3 triad = Eigen::Quaterniond(frame[ez])
                        .slerp(0.5, Eigen::Quaterniond(frame[ez + 1]))
                        .toRotationMatrix();
    const beam::Matrix12 R = beam::rotation12(triad, frame[ez], frame[ez + 1]);
    const auto nodal = [&](const beam::Matrix12& a) -> beam::Matrix12 {
      return R.transpose() * a * R;
    };
    const double area = constants::pi * mesh.outer[ez] * mesh.outer[ez];
    const double added = fluid * (3.0 * area + constants::pi * mesh.inner[ez] * mesh.inner[ez]);
    const beam::Matrix12 steel = beam::mass(section, l);
    scatter(m, e, nodal(steel + added * beam::lateralMass(l)));
    scatter(c0, e, nodal(0.03 * steel + 0.5 * beam::lateralMass(l)));
    const beam::Matrix12 G = beam::gyroscopic(section, l);
    scatter(gyroscopic, e, nodal(G.transpose() - G));
    scatter(drag, e, nodal(2.0 * beam::lateralMass(l)));
    // axial force of one reference string after the other, however long the whole
    scatter(
        k, e,
        nodal(beam::stiffness(section, l) + (2e4 - 300.0 * (e % 162)) * beam::geometricAxial(l) -
              2e3 * beam::geometricTorque(l)));
    const beam::Vector12 load =
        R.transpose() *
        beam::distributedLoad(
            triad.transpose() * Vector3(0, 0, 9.81 * (section.massPerLength() - fluid * area)), l);
    for (int i = 0; i < 12; ++i)
      if (dof[static_cast<std::size_t>(6 * e + i)] >= 0)
        weight[dof[static_cast<std::size_t>(6 * e + i)]] += load[i];
  }
  const auto matrix = [n](const Triplets& t) {
    Sparse a(n, n);
    a.setFromTriplets(t.begin(), t.end());
    return a;
  };
  const auto omega = [steady](double t) { return steady ? 4 * constants::pi : rotarySpeed(t); };
  const int lawOmega = model.lawIndex({"Omega", omega});
  const int lawRoot =
      model.lawIndex({"sqrt|Omega|", [omega](double t) { return std::sqrt(std::abs(omega(t))); }});
  model.mass = matrix(m);
  model.damping = {{"damping", matrix(c0), 0},
                   {"gyroscopic", matrix(gyroscopic), lawOmega},
                   {"mud drag", matrix(drag), lawRoot}};
  model.stiffness = {{"stiffness", matrix(k), 0}};
  model.loads = {{"weight", weight, 0}};
  model.initialDisplacement = Vector::Zero(n);
  model.initialVelocity = Vector::Zero(n);

  contact::ContactPoints points;
  Triplets rows;
  std::vector<std::int64_t> entities;
  for (int i = 1; i < nodes - 1; ++i) {
    const auto iz = static_cast<std::size_t>(i);
    const int r = static_cast<int>(rows.size());
    points.add({i + 1, clearance[iz], radius[iz], 1e7, 1e4, 7e11, 7e11, 0.2, 0.1, 0.1});
    for (int c : {0, 1, 5})
      rows.emplace_back(r + (c == 5 ? 2 : c), dof[static_cast<std::size_t>(6 * i + c)], 1.0);
    entities.push_back(i + 1);
  }
  model::PointSet set;
  set.name = "contact";
  set.law = contact::makeLaw("Nguyen")->inMotion(points, omega);
  set.entities = entities;
  set.rows.resize(3 * (nodes - 2), n);
  set.rows.setFromTriplets(rows.begin(), rows.end());
  set.offset = Vector::Zero(3 * (nodes - 2));
  model.points.push_back(set);
  return model;
}

}  // namespace tooljoint::benchmarks
