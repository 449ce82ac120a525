// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A chain of corotational elements under dead loads, for comparison with large-displacement
/// solutions.
#pragma once

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "model/NonlinearProblem.hpp"
#include "substructures/beam/Corotational.hpp"
#include "substructures/beam/Rotation.hpp"
#include "substructures/beam/SparseAssembler.hpp"

namespace tooljoint::testing_ {

/// Unknowns per free node: displacement from the start, and the rotation vector since the last
/// accepted state.
class FrameProblem : public model::NonlinearProblem {
 public:
  /// Node positions and triads at rest, the elements between them; the first node is clamped.
  FrameProblem(std::vector<Vector3> positions, std::vector<Matrix3> triads,
               std::vector<beam::CorotationalElement> elements, double forceScale,
               double momentScale)
      : positions_(std::move(positions)),
        triads_(std::move(triads)),
        elements_(std::move(elements)),
        forceScale_(forceScale),
        momentScale_(momentScale),
        load_(Vector::Zero(size())) {
    std::vector<std::vector<int>> lists;
    for (int e = 0; e < static_cast<int>(elements_.size()); ++e) {
      std::vector<int> list;
      for (int i = 0; i < 12; ++i) list.push_back(6 * e + i < 6 ? -1 : 6 * (e - 1) + i);
      lists.push_back(list);
    }
    assembler_ = beam::SparseAssembler(size(), lists);
  }

  int size() const override { return 6 * static_cast<int>(elements_.size()); }
  /// Dead force and moment at the last node.
  void loadTip(const Vector3& force, const Vector3& moment) {
    load_.tail<6>().head<3>() = force;
    load_.tail<3>() = moment;
  }
  Vector start() const { return Vector::Zero(size()); }
  /// Moves the mesh to x: positions and triads of the next load step.
  void accept(const Vector& x) {
    const auto [p, t] = pose(x);
    positions_ = p;
    triads_ = t;
  }
  const Vector3& tip() const { return positions_.back(); }
  const Matrix3& tipTriad() const { return triads_.back(); }

  void residual(const Vector& x, Vector& r) const override {
    const auto [p, t] = pose(x);
    r = -load_;
    for (std::size_t e = 0; e < elements_.size(); ++e)
      assembler_.add(static_cast<int>(e),
                     elements_[e].evaluate({p[e], p[e + 1], t[e], t[e + 1]}, false).force, r);
  }

  void jacobian(const Vector& x, Sparse& jacobian) const override {
    const auto [p, t] = pose(x);
    assembler_.clear(jacobian);
    for (std::size_t e = 0; e < elements_.size(); ++e) {
      beam::Matrix12 k = elements_[e].evaluate({p[e], p[e + 1], t[e], t[e + 1]}, true).tangent;
      for (int end = 0; end < 2; ++end) {
        const int node = static_cast<int>(e) + end;
        if (node == 0) continue;
        const Vector3 theta = x.segment<3>(6 * (node - 1) + 3);
        k.middleCols<3>(6 * end + 3) =
            (k.middleCols<3>(6 * end + 3) * beam::spinFromRotationVector(theta)).eval();
      }
      assembler_.add(static_cast<int>(e), k, jacobian);
    }
  }

  Vector residualScale() const override {
    Vector scale(size());
    for (int i = 0; i < size(); ++i) scale(i) = 1.0 / (i % 6 < 3 ? forceScale_ : momentScale_);
    return scale;
  }
  std::string unknownName(int i) const override { return "dof " + std::to_string(i + 1); }

 private:
  std::pair<std::vector<Vector3>, std::vector<Matrix3>> pose(const Vector& x) const {
    std::vector<Vector3> p = positions_;
    std::vector<Matrix3> t = triads_;
    for (std::size_t n = 1; n < p.size(); ++n) {
      const int first = 6 * (static_cast<int>(n) - 1);
      p[n] += x.segment<3>(first);
      t[n] = beam::rotationExponential(x.segment<3>(first + 3)) * t[n];
    }
    return {p, t};
  }

  std::vector<Vector3> positions_;
  std::vector<Matrix3> triads_;
  std::vector<beam::CorotationalElement> elements_;
  double forceScale_;
  double momentScale_;
  Vector load_;
  beam::SparseAssembler assembler_;
};

}  // namespace tooljoint::testing_
