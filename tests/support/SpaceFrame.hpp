// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Frames of Euler-Bernoulli beams in space for the tests of coupling: every member a part, in
/// global axes or in its own, and the same frame as one part.
#pragma once

#include <Eigen/Dense>
#include <map>
#include <string>
#include <vector>

#include "coupling/input/Connections.hpp"
#include "tests/support/SampleParts.hpp"

namespace tooljoint::samples {

inline const model::ComponentNames spaceComponents{"u", "v", "w", "theta_x", "theta_y", "theta_z"};

/// Per length: stiffness against stretching, twisting, bending about y and z; mass and its polar
/// moment.
struct SpaceSection {
  double EA = 4e8, GJ = 3e5, EIy = 5e5, EIz = 8e5, mu = 25, mup = 0.05;
};

/// A straight member: nodes in order, evenly spaced between two points.
struct SpaceMember {
  std::string name;
  std::vector<int> nodes;
  Vector3 from, to;
};

/// Axes of a member as columns: x along it.
inline Matrix3 memberAxes(const SpaceMember& member) {
  const Vector3 x = (member.to - member.from).normalized();
  const Vector3 up = std::abs(x.z()) < 0.9 ? Vector3::UnitZ() : Vector3::UnitX();
  Matrix3 axes;
  axes.col(0) = x;
  axes.col(1) = up.cross(x).normalized();
  axes.col(2) = x.cross(axes.col(1));
  return axes;
}

/// Stiffness of an element along x: (u v w theta_x theta_y theta_z) of both ends.
inline Matrix spaceBeamStiffness(const SpaceSection& s, double l) {
  Matrix K = Matrix::Zero(12, 12);
  for (const auto& [c, k] : {std::pair{0, s.EA / l}, std::pair{3, s.GJ / l}}) {
    K(c, c) = K(c + 6, c + 6) = k;
    K(c, c + 6) = K(c + 6, c) = -k;
  }
  const Matrix plane = planeBeamStiffness(0.0, 1.0, l);  // u v theta, theta = v'
  const int inXY[6] = {-1, 1, 5, -1, 7, 11}, inXZ[6] = {-1, 2, 4, -1, 8, 10};
  const double sign[6] = {1, 1, -1, 1, 1, -1};  // w' = -theta_y
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) {
      if (inXY[i] < 0 || inXY[j] < 0) continue;
      K(inXY[i], inXY[j]) += s.EIz * plane(i, j);
      K(inXZ[i], inXZ[j]) += s.EIy * sign[i] * sign[j] * plane(i, j);
    }
  return K;
}

inline Matrix spaceBeamMass(const SpaceSection& s, double l) {
  Matrix M = Matrix::Zero(12, 12);
  for (const auto& [c, m] : {std::pair{0, s.mu}, std::pair{3, s.mup}}) {
    M(c, c) = M(c + 6, c + 6) = m * l / 3;
    M(c, c + 6) = M(c + 6, c) = m * l / 6;
  }
  const Matrix plane = planeBeamMass(s.mu, l);
  const int inXY[6] = {-1, 1, 5, -1, 7, 11}, inXZ[6] = {-1, 2, 4, -1, 8, 10};
  const double sign[6] = {1, 1, -1, 1, 1, -1};
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) {
      if (inXY[i] < 0 || inXY[j] < 0) continue;
      M(inXY[i], inXY[j]) += plane(i, j);
      M(inXZ[i], inXZ[j]) += sign[i] * sign[j] * plane(i, j);
    }
  return M;
}

/// The members as one part, in global axes, or (one member) in the axes of that member. Held nodes
/// have no dofs.
inline Substructure spacePart(const std::string& name, const std::vector<SpaceMember>& members,
                              const std::vector<int>& held, bool ownAxes = false,
                              const SpaceSection& section = {}) {
  Substructure part;
  part.name = name;
  part.model.componentNames = spaceComponents;
  std::map<int, int> first;
  Triplets stiffness, mass;
  for (const auto& member : members) {
    const double l =
        (member.to - member.from).norm() / static_cast<double>(member.nodes.size() - 1);
    Matrix T = Matrix::Identity(12, 12);  // local = T global
    if (!ownAxes)
      for (int b = 0; b < 4; ++b) T.block<3, 3>(3 * b, 3 * b) = memberAxes(member).transpose();
    const Matrix K = T.transpose() * spaceBeamStiffness(section, l) * T,
                 M = T.transpose() * spaceBeamMass(section, l) * T;
    for (std::size_t e = 0; e + 1 < member.nodes.size(); ++e) {
      std::vector<int> dofs;
      for (int node : {member.nodes[e], member.nodes[e + 1]}) {
        const bool fixed = std::find(held.begin(), held.end(), node) != held.end();
        if (first.count(node) == 0) {
          first[node] = fixed ? -1 : static_cast<int>(part.model.dofs.size());
          for (int c = 0; c < 6 && !fixed; ++c)
            part.model.dofs.push_back(DofLabel::physical(node, c));
        }
        for (int c = 0; c < 6; ++c) dofs.push_back(first[node] < 0 ? -1 : first[node] + c);
      }
      add(stiffness, K, dofs);
      add(mass, M, dofs);
    }
  }
  const int n = static_cast<int>(part.model.dofs.size());
  part.model.mass = square(n, mass);
  part.model.stiffness.push_back({"elastic", square(n, stiffness), 0});
  complete(part);
  return part;
}

/// Five members in space: two columns on clamped feet (1, 2), a beam between their heads (4, 3),
/// and two struts that meet in node 5: a loop 4-3-5. Node 4 and node 3 belong to three parts.
struct FiveMembers {
  std::vector<SpaceMember> members;
  std::vector<int> feet{1, 2};

  explicit FiveMembers(int elements = 6) {
    const std::map<int, Vector3> corner{
        {1, {0, 0, 0}}, {2, {4, 0.3, 0}}, {3, {4, 0, 3}}, {4, {0, 0.2, 3.1}}, {5, {1.8, 2.4, 3.6}}};
    const auto member = [&](const std::string& name, int a, int b, int base) {
      SpaceMember m{name, {a}, corner.at(a), corner.at(b)};
      for (int i = 1; i < elements; ++i) m.nodes.push_back(base + i);
      m.nodes.push_back(b);
      members.push_back(m);
    };
    member("left column", 1, 4, 100);
    member("right column", 2, 3, 200);
    member("beam", 4, 3, 300);
    member("left strut", 4, 5, 400);
    member("right strut", 3, 5, 500);
  }

  /// `own`: members that are given in their own axes.
  std::vector<Substructure> parts(const std::vector<int>& own = {}) const {
    std::vector<Substructure> list;
    for (int p = 0; p < 5; ++p) {
      const auto& m = members[static_cast<std::size_t>(p)];
      list.push_back(
          spacePart(m.name, {m}, feet, std::find(own.begin(), own.end(), p) != own.end()));
      std::vector<int> ends;
      for (int node : {m.nodes.front(), m.nodes.back()})
        if (node > 2) ends.push_back(node);
      classify(list.back(), ends);
    }
    return list;
  }
  std::vector<coupling::Frame> frames(const std::vector<int>& own) const {
    std::vector<coupling::Frame> list;
    for (int p : own)
      list.push_back({members[static_cast<std::size_t>(p)].name, 0,
                      memberAxes(members[static_cast<std::size_t>(p)])});
    return list;
  }
  Substructure whole() const { return spacePart("whole", members, feet); }
};

}  // namespace tooljoint::samples
