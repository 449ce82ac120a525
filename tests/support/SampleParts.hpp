// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Small parts for the tests of reduction and coupling: spring chains, a bar, plane frames, a cubic
/// spring at points.
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "model/Substructure.hpp"

namespace tooljoint::samples {

using model::DofLabel;
using model::Substructure;

/// A law of time that is neither 1 nor 0.
inline model::ScalarLaw spin() {
  return {"Omega", [](double t) { return 2.0 + t; }};
}
inline model::ScalarLaw spinRate() {
  return {"dOmega/dt", [](double) { return 1.0; }};
}

/// Entries of an element matrix added at the positions `dofs` (negative: held).
inline void add(Triplets& entries, const Matrix& element, const std::vector<int>& dofs) {
  for (std::size_t i = 0; i < dofs.size(); ++i)
    for (std::size_t j = 0; j < dofs.size(); ++j)
      if (dofs[i] >= 0 && dofs[j] >= 0)
        entries.emplace_back(dofs[i], dofs[j],
                             element(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
}

inline Sparse square(int n, const Triplets& entries) {
  Sparse A(n, n);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

/// Interface and retained positions of a part from node numbers.
inline void classify(Substructure& part, const std::vector<int>& interface,
                     const std::vector<int>& retained = {}) {
  const auto named = [](const std::vector<int>& nodes, std::int64_t node) {
    return std::find(nodes.begin(), nodes.end(), static_cast<int>(node)) != nodes.end();
  };
  part.interface.clear();
  part.retained.clear();
  for (int i = 0; i < part.model.size(); ++i) {
    const auto node = part.model.dofs[static_cast<std::size_t>(i)].entity;
    if (named(interface, node))
      part.interface.push_back(i);
    else if (named(retained, node))
      part.retained.push_back(i);
  }
}

/// Recovery rows for all nodes of a part: the dofs themselves, zero rows for held ones. Zero
/// initial state.
inline void complete(Substructure& part) {
  auto& m = part.model;
  const int n = m.size();
  const int components = static_cast<int>(m.componentNames.size());
  std::map<std::int64_t, int> order;
  for (const auto& label : m.dofs) order.emplace(label.entity, 0);
  int next = 0;
  m.recoveryNodes.clear();
  for (auto& [node, number] : order) {
    number = next++;
    m.recoveryNodes.push_back(node);
  }
  Triplets rows;
  for (int i = 0; i < n; ++i) {
    const auto& label = m.dofs[static_cast<std::size_t>(i)];
    rows.emplace_back(order.at(label.entity) * components + label.component, i, 1.0);
  }
  m.recovery = Sparse(next * components, n);
  m.recovery.setFromTriplets(rows.begin(), rows.end());
  m.recoveryOffset = Vector::Zero(next * components);
  m.initialDisplacement = Vector::Zero(n);
  m.initialVelocity = Vector::Zero(n);
}

/// A uniform bar (or spring chain) of `elements` linear elements from node `first`: stiffness k and
/// mass m of each element, consistent mass; nodes in `held` do not move.
inline Substructure bar(const std::string& name, int first, int elements, double k, double m,
                        const std::vector<int>& held = {}) {
  Substructure part;
  part.name = name;
  part.model.componentNames = {"u"};
  std::map<int, int> position;
  for (int node = first; node <= first + elements; ++node) {
    const bool fixed = std::find(held.begin(), held.end(), node) != held.end();
    position[node] = fixed ? -1 : static_cast<int>(part.model.dofs.size());
    if (!fixed) part.model.dofs.push_back(DofLabel::physical(node, 0));
  }
  Triplets stiffness, mass;
  for (int e = 0; e < elements; ++e) {
    const std::vector<int> dofs{position[first + e], position[first + e + 1]};
    add(stiffness, k * (Matrix(2, 2) << 1, -1, -1, 1).finished(), dofs);
    add(mass, m / 6 * (Matrix(2, 2) << 2, 1, 1, 2).finished(), dofs);
  }
  const int n = static_cast<int>(part.model.dofs.size());
  part.model.mass = square(n, mass);
  part.model.stiffness.push_back({"elastic", square(n, stiffness), 0});
  complete(part);
  return part;
}

/// A straight member of a plane frame between two nodes of the frame, cut into `elements` beam
/// elements.
struct Member {
  int from, to;              ///< node numbers
  std::vector<int> between;  ///< numbers of the nodes in between (elements - 1 of them)
};

/// Plane frame of Euler beams: nodes with u, v, theta. EA, EI, mass per length.
struct Frame {
  std::map<int, Eigen::Vector2d> corners;
  double EA = 2e8, EI = 3e5, mu = 20;
  std::vector<int> clamped;
};

inline Matrix planeBeamStiffness(double EA, double EI, double l) {
  Matrix K = Matrix::Zero(6, 6);
  K(0, 0) = K(3, 3) = EA / l;
  K(0, 3) = K(3, 0) = -EA / l;
  const double b = EI / (l * l * l);
  const int i[4] = {1, 2, 4, 5};
  const double bending[4][4] = {{12, 6 * l, -12, 6 * l},
                                {6 * l, 4 * l * l, -6 * l, 2 * l * l},
                                {-12, -6 * l, 12, -6 * l},
                                {6 * l, 2 * l * l, -6 * l, 4 * l * l}};
  for (int r = 0; r < 4; ++r)
    for (int c = 0; c < 4; ++c) K(i[r], i[c]) = b * bending[r][c];
  return K;
}

inline Matrix planeBeamMass(double mu, double l) {
  Matrix M = Matrix::Zero(6, 6);
  M(0, 0) = M(3, 3) = mu * l / 3;
  M(0, 3) = M(3, 0) = mu * l / 6;
  const double f = mu * l / 420;
  const int i[4] = {1, 2, 4, 5};
  const double bending[4][4] = {{156, 22 * l, 54, -13 * l},
                                {22 * l, 4 * l * l, 13 * l, -3 * l * l},
                                {54, 13 * l, 156, -22 * l},
                                {-13 * l, -3 * l * l, -22 * l, 4 * l * l}};
  for (int r = 0; r < 4; ++r)
    for (int c = 0; c < 4; ++c) M(i[r], i[c]) = f * bending[r][c];
  return M;
}

inline Matrix planeRotation(const Eigen::Vector2d& direction) {
  const double c = direction.x(), s = direction.y();
  Matrix R = Matrix::Identity(6, 6);
  for (int k : {0, 3}) {
    R(k, k) = c;
    R(k, k + 1) = s;
    R(k + 1, k) = -s;
    R(k + 1, k + 1) = c;
  }
  return R;
}

/// The part of `frame` made of `members`. With `spinning`, each element also carries a skew damping
/// matrix times Omega (as gyroscopics do), a skew part of the constant stiffness (as a torque does)
/// and a skew stiffness times dOmega/dt.
inline Substructure framePart(const std::string& name, const Frame& frame,
                              const std::vector<Member>& members, bool spinning = false) {
  Substructure part;
  part.name = name;
  part.model.componentNames = {"u", "v", "theta"};
  std::map<int, int> first;  // node -> position of its u
  const auto place = [&](int node) {
    const bool fixed =
        std::find(frame.clamped.begin(), frame.clamped.end(), node) != frame.clamped.end();
    if (!first.count(node)) {
      first[node] = fixed ? -1 : static_cast<int>(part.model.dofs.size());
      for (int c = 0; c < 3 && !fixed; ++c) part.model.dofs.push_back(DofLabel::physical(node, c));
    }
  };
  Triplets stiffness, mass, gyroscopic, torque;
  for (const Member& member : members) {
    std::vector<int> chain{member.from};
    chain.insert(chain.end(), member.between.begin(), member.between.end());
    chain.push_back(member.to);
    const Eigen::Vector2d along = frame.corners.at(member.to) - frame.corners.at(member.from);
    const double l = along.norm() / static_cast<double>(chain.size() - 1);
    const Matrix R = planeRotation(along.normalized());
    for (std::size_t e = 0; e + 1 < chain.size(); ++e) {
      place(chain[e]);
      place(chain[e + 1]);
      std::vector<int> dofs;
      for (int node : {chain[e], chain[e + 1]})
        for (int c = 0; c < 3; ++c) dofs.push_back(first[node] < 0 ? -1 : first[node] + c);
      add(stiffness, R.transpose() * planeBeamStiffness(frame.EA, frame.EI, l) * R, dofs);
      add(mass, R.transpose() * planeBeamMass(frame.mu, l) * R, dofs);
      Matrix skew = Matrix::Zero(6, 6);
      for (int k : {0, 3}) {
        skew(k, k + 1) = 1;
        skew(k + 1, k) = -1;
      }
      add(gyroscopic, frame.mu * l * skew, dofs);
      add(torque, 40.0 * skew, dofs);
    }
  }
  auto& m = part.model;
  const int n = static_cast<int>(m.dofs.size());
  m.mass = square(n, mass);
  m.stiffness.push_back({"elastic", square(n, stiffness), 0});
  if (spinning) {
    m.damping.push_back({"gyroscopic", square(n, gyroscopic), m.lawIndex(spin())});
    m.damping.push_back({"Rayleigh", Sparse(0.03 * m.mass + 1e-5 * m.stiffness.front().matrix), 0});
    m.stiffness.push_back({"torque", square(n, torque), 0});
    m.stiffness.push_back(
        {"gyroscopic rate", Sparse(0.5 * square(n, gyroscopic)), m.lawIndex(spinRate())});
  }
  complete(part);
  return part;
}

/// A point with two coordinates held by a cubic spring and a damper: f = -k |d|^2 d - c v.
class CubicSpring : public model::PointLaw {
 public:
  CubicSpring(int size, double k, double c) : size_(size), k_(k), c_(c) {}
  int size() const override { return size_; }
  int width() const override { return 2; }
  void evaluate(double, const std::vector<int>& active, const double* d, const double* v,
                double* f) const override {
    for (int p : active) {
      const double square = d[2 * p] * d[2 * p] + d[2 * p + 1] * d[2 * p + 1];
      for (int c = 0; c < 2; ++c) f[2 * p + c] = -k_ * square * d[2 * p + c] - c_ * v[2 * p + c];
    }
  }
  void evaluateWithTangent(double t, const std::vector<int>& active, const double* d,
                           const double* v, double* f, double* dfdd, double* dfdv) const override {
    evaluate(t, active, d, v, f);
    for (int p : active)
      for (int r = 0; r < 2; ++r)
        for (int c = 0; c < 2; ++c) {
          const double square = d[2 * p] * d[2 * p] + d[2 * p + 1] * d[2 * p + 1];
          dfdd[(2 * p + r) * 2 + c] =
              -k_ * (2 * d[2 * p + r] * d[2 * p + c] + (r == c ? square : 0.0));
          dfdv[(2 * p + r) * 2 + c] = r == c ? -c_ : 0.0;
        }
  }
  void clearanceLeft(const std::vector<int>& points, const double*, double* gap) const override {
    for (int p : points) gap[p] = 0.0;
  }
  Power power(double, const std::vector<int>&, const double*, const double*) const override {
    return {};
  }
  std::vector<model::Channel> channels() const override { return {}; }
  void record(double, const double*, const double*, double*) const override {}
  std::shared_ptr<const model::PointLaw> subset(const std::vector<int>& points) const override {
    return std::make_shared<CubicSpring>(static_cast<int>(points.size()), k_, c_);
  }

 private:
  int size_;
  double k_, c_;
};

/// Cubic springs on the first two components of the given nodes of a part.
inline void addCubicSprings(Substructure& part, const std::vector<int>& nodes, double k = 1e12,
                            double c = 5.0) {
  model::PointSet set;
  set.name = "cubic springs";
  set.law = std::make_shared<CubicSpring>(static_cast<int>(nodes.size()), k, c);
  Triplets rows;
  for (std::size_t p = 0; p < nodes.size(); ++p) {
    set.entities.push_back(nodes[p]);
    for (int i = 0; i < part.model.size(); ++i) {
      const auto& label = part.model.dofs[static_cast<std::size_t>(i)];
      if (label.entity == nodes[p] && label.component < 2)
        rows.emplace_back(static_cast<int>(2 * p) + label.component, i, 1.0);
    }
  }
  set.rows = Sparse(static_cast<Eigen::Index>(2 * nodes.size()), part.model.size());
  set.rows.setFromTriplets(rows.begin(), rows.end());
  set.offset = Vector::Zero(set.rows.rows());
  part.model.points.push_back(set);
}

/// Position of a label in a model, -1 when it is not there.
inline int find(const model::SecondOrderModel& m, const DofLabel& label) {
  const auto it = std::find(m.dofs.begin(), m.dofs.end(), label);
  return it == m.dofs.end() ? -1 : static_cast<int>(it - m.dofs.begin());
}

/// Four parts of a clamped frame with a closed loop and a branch:
///
///     4 ---- 3 ---- 5
///     |      |
///     1      2          (1 and 2 clamped)
///
/// part 0: column 1-4, part 1: column 2-3, part 2: beam 4-3, part 3: cantilever 3-5. Node 3 belongs
/// to three parts.
inline std::vector<Substructure> loopFrame(int elements, bool spinning, bool retainSome = false) {
  Frame frame;
  frame.corners = {{1, {0, 0}}, {2, {3, 0}}, {3, {3, 2.5}}, {4, {0, 2}}, {5, {5, 2.6}}};
  frame.clamped = {1, 2};
  const auto inner = [&](int base) {
    std::vector<int> nodes;
    for (int i = 1; i < elements; ++i) nodes.push_back(base + i);
    return nodes;
  };
  std::vector<Substructure> parts{framePart("left column", frame, {{1, 4, inner(100)}}, spinning),
                                  framePart("right column", frame, {{2, 3, inner(200)}}, spinning),
                                  framePart("beam", frame, {{4, 3, inner(300)}}, spinning),
                                  framePart("cantilever", frame, {{3, 5, inner(400)}}, spinning)};
  const auto middle = [&](int base) {
    return retainSome ? std::vector<int>{base + elements / 2} : std::vector<int>{};
  };
  classify(parts[0], {4}, middle(100));
  classify(parts[1], {3}, middle(200));
  classify(parts[2], {3, 4}, middle(300));
  classify(parts[3], {3}, retainSome ? std::vector<int>{5} : std::vector<int>{});
  return parts;
}

}  // namespace tooljoint::samples
