// SPDX-License-Identifier: BSD-3-Clause
#include "coupling/assembly/DualAssembly.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "common/Index.hpp"
#include "coupling/assembly/Congruence.hpp"
#include "linalg/trilinos/DirectSolver.hpp"
#include "model/DofNames.hpp"
#include "model/NodalFrequency.hpp"

namespace tooljoint::coupling {

namespace {

using model::DofLabel;
using model::SecondOrderModel;

class Builder {
 public:
  Builder(const std::vector<AlignedPart>& alignedParts, const Labelled& labelled,
          const Elimination& constraints)
      : alignedParts_(alignedParts),
        labelled_(labelled),
        solved_(constraints.solved),
        all_(static_cast<int>(labelled.model.dofs.size())) {}

  DualModel run() {
    out_.model = labelled_.model;
    findOwners();
    dropInterfacesThatAreNoCoordinates();
    addForces();
    putForcesInPlace();
    returnImbalance();
    startConsistently();
    return std::move(out_);
  }

 private:
  int constraints() const { return static_cast<int>(solved_.size()); }
  int count() const { return 2 * constraints(); }

  void findOwners() {
    owner_.assign(at(all_), -1);
    virtual_.assign(at(all_), -1);
    for (std::size_t p = 0; p < alignedParts_.size(); ++p)
      for (std::size_t i = 0; i < labelled_.columns[p].size(); ++i) {
        const int y = labelled_.columns[p][i];
        if (owner_[at(y)] < 0) owner_[at(y)] = static_cast<int>(p);
        if (static_cast<int>(i) >= alignedParts_[p].coordinates)
          virtual_[at(y)] = static_cast<int>(i) - alignedParts_[p].coordinates;
      }
  }

  /// y = S (x, lambda): interface displacements that are not coordinates are rows of their part,
  /// u_b = B_p q_p.
  void dropInterfacesThatAreNoCoordinates() {
    std::vector<char> keep(at(all_), 1);
    Triplets entries;
    for (int y = 0; y < all_; ++y) {
      if (virtual_[at(y)] < 0) continue;
      keep[at(y)] = 0;
      const auto& from = labelled_.columns[at(owner_[at(y)])];
      forEachInRow(alignedParts_[at(owner_[at(y)])].boundaryRows, virtual_[at(y)],
                   [&](int j, double value) { entries.emplace_back(y, from[at(j)], value); });
    }
    Substitution s;
    column_ = keepOnly(labelled_.model, keep, entries, count(), s);
    coordinates_ = sizeOf(s.dofs);
    for (const auto& solved : solved_)
      for (const auto which : {std::int8_t{1}, std::int8_t{2}})
        s.dofs.push_back(labelOf(solved.unknown, which));
    substitute(out_.model, s);
    out_.map = s.map;
  }

  /// A multiplier has the node of its dof, or the label of a mode of the part if the interface is
  /// not a coordinate.
  DofLabel labelOf(int unknown, std::int8_t which) const {
    const DofLabel& label = labelled_.model.dofs[at(unknown)];
    if (virtual_[at(unknown)] >= 0)
      return DofLabel::modal(owner_[at(unknown)], virtual_[at(unknown)]).joiningForce(which);
    return label.joiningForce(which);
  }

  /// Constraints as rows over all unknowns of `labelled`, y[unknown] - rest = value. Each is added
  /// twice and scaled by the stiffness S of that dof, so that the multipliers have the unit of a
  /// displacement:
  ///
  ///     K -> [K -S B' -S B'; -S B -S S; -S B S -S],   F -> [F; -S g; -S g]
  void addForces() {
    const Vector stiffness = diagonalStiffness();
    Triplets rows, entries;
    Vector values(count());
    for (int k = 0; k < constraints(); ++k) {
      const SolvedRow& solved = solved_[at(k)];
      const double scale = scaleOf(solved, stiffness);
      const int first = coordinates_ + 2 * k;
      for (int row : {2 * k, 2 * k + 1}) {
        rows.emplace_back(row, solved.unknown, scale);
        for (const auto& [other, factor] : solved.rest)
          rows.emplace_back(row, other, -scale * factor);
        values[row] = scale * solved.value;
        entries.emplace_back(coordinates_ + row, coordinates_ + row, -scale);
      }
      entries.emplace_back(first, first + 1, scale);
      entries.emplace_back(first + 1, first, scale);
      out_.multipliers.push_back({first, first + 1,
                                  alignedParts_[at(owner_[at(solved.unknown)])].name,
                                  labelled_.model.dofs[at(solved.unknown)], scale});
    }
    labelRows_ = sparse(count(), all_, rows);
    forEachEntry(Sparse(labelRows_ * out_.map), [&](int k, int j, double value) {
      if (value == 0.0) return;
      entries.emplace_back(coordinates_ + k, j, -value);
      entries.emplace_back(j, coordinates_ + k, -value);
    });
    const int size = coordinates_ + count();
    if (count() > 0) {
      joining_ = out_.model.stiffness.size();
      out_.model.stiffness.push_back({"joining forces", sparse(size, size, entries), 0});
    }
    if (!values.isZero(0.0)) {
      Vector load = Vector::Zero(size);
      load.tail(count()) = -values;
      out_.model.loads.push_back({"constraint values", load, 0});
    }
  }

  /// Diagonal of the stiffness of the parts; constant terms.
  Vector diagonalStiffness() const {
    Vector diagonal = Vector::Zero(out_.model.mass.rows());
    for (std::size_t i = 0; i < out_.model.stiffness.size(); ++i) {
      const auto& term = out_.model.stiffness[i];
      if (i != joining_ && out_.model.laws[at(term.law)].isOne())
        diagonal += term.matrix.diagonal();
    }
    return diagonal;
  }

  double scaleOf(const SolvedRow& solved, const Vector& stiffness) const {
    double size = stiffnessOf(solved.unknown, stiffness);
    for (const auto& [other, factor] : solved.rest)
      if (size == 0.0) size = stiffnessOf(other, stiffness);
    return size > 0.0 ? size : 1.0;
  }

  /// Stiffness of one dof. For an interface dof that is not a coordinate, the lowest stiffness
  /// against moving it by its coordinates: by forces, or by modes other than rigid-body modes
  /// (whose stiffness is rounding).
  double stiffnessOf(int unknown, const Vector& stiffness) const {
    if (virtual_[at(unknown)] < 0) return std::abs(stiffness[column_[at(unknown)]]);
    const AlignedPart& alignedPart = alignedParts_[at(owner_[at(unknown)])];
    const auto& from = labelled_.columns[at(owner_[at(unknown)])];
    const auto place = [&](int i) { return static_cast<Eigen::Index>(column_[at(from[at(i)])]); };
    const int modes = alignedPart.coordinates - alignedPart.forces;
    double largest = 0, flexibility = 0;
    for (int i = 0; i < modes; ++i) largest = std::max(largest, std::abs(stiffness[place(i)]));
    for (int i = alignedPart.coordinates - 1; i >= 0; --i) {
      if (i == modes - 1 && flexibility > 0.0) break;  // the residual flexibility decides
      const double own = std::abs(stiffness[place(i)]), row = out_.map.coeff(unknown, place(i));
      if (own > (i < modes ? 1e-8 * largest : 0.0))
        flexibility = std::max(flexibility, row * row / own);
    }
    return flexibility > 0.0 ? 1.0 / flexibility : 0.0;
  }

  /// Entry (j, i) of T for interface forces; T turns the common frame into that of the part.
  static double turned(const AlignedPart& part, int j, int i) {
    const int n = part.coordinates;
    return part.turn.rows() > 0 ? part.turn.coeff(n + j, n + i) : i == j ? 1.0 : 0.0;
  }

  /// Replaces the interface forces of a part by the multipliers: g = T C' lambda, where T turns the
  /// common frame into that of the part.
  void putForcesInPlace() {
    std::vector<char> keep(at(coordinates_ + count()), 1);
    Triplets entries;
    for (std::size_t p = 0; p < alignedParts_.size(); ++p) {
      const AlignedPart& alignedPart = alignedParts_[p];
      if (alignedPart.forces == 0) continue;
      const int n = alignedPart.coordinates, first = n - alignedPart.forces;
      Triplets rows;
      for (int j = 0; j < alignedPart.forces; ++j)
        for (int i = 0; i < alignedPart.forces; ++i)
          if (const double value = turned(alignedPart, j, i); value != 0.0)
            rows.emplace_back(j, labelled_.columns[p][at(n + i)], value);
      const Sparse toCommon = sparse(alignedPart.forces, all_, rows), C = labelRows_.transpose();
      const Sparse g = toCommon * C;  // forces x multipliers
      for (int j = 0; j < alignedPart.forces; ++j) {
        const int x = column_[at(labelled_.columns[p][at(first + j)])];
        keep[at(x)] = 0;
        forEachInRow(g, j, [&](int column, double value) {
          entries.emplace_back(x, coordinates_ + column, value);
        });
      }
    }
    if (!contains(keep, 0)) return;
    Substitution s;
    const std::vector<int> to = keepOnly(out_.model, keep, entries, 0, s);
    substitute(out_.model, s);
    out_.map = Sparse(out_.map * s.map);
    for (auto& multiplier : out_.multipliers) {
      multiplier.first = to[at(multiplier.first)];
      multiplier.second = to[at(multiplier.second)];
    }
  }

  /// Forces of the static state load the parts (reduction::DerivedInterface). Their sum where parts
  /// meet is not a force between parts but the residual of the static state, and is subtracted.
  void returnImbalance() {
    Vector total = Vector::Zero(all_);
    for (std::size_t p = 0; p < alignedParts_.size(); ++p) {
      const AlignedPart& alignedPart = alignedParts_[p];
      const int n = alignedPart.coordinates;
      for (int j = 0; j < alignedPart.staticForces.size(); ++j) {
        for (int i = 0; i < alignedPart.forces; ++i)
          total[labelled_.columns[p][at(n + i)]] +=
              turned(alignedPart, j, i) * alignedPart.staticForces[j];
      }
    }
    for (const auto& solved : solved_) {
      for (const auto& [other, factor] : solved.rest)
        total[other] += factor * total[solved.unknown];
      total[solved.unknown] = 0;
    }
    if (total.isZero(0.0)) return;
    const Vector load = -(out_.map.transpose() * total);
    out_.model.loads.push_back({"reference state: imbalance where parts meet", load,
                                out_.model.lawIndex(model::ScalarLaw::one())});
  }

  /// Initial multipliers of constraints, which nothing else determines, at t = 0 (J: what
  /// addForces() has added):
  ///
  ///     [M . ; . .] (a, lambda) + J (a, lambda) = (F + R'f - C v - K q, 0)
  ///
  /// Coordinates without mass get that of the frequency of the fastest node. Massless motions of
  /// several coordinates, as of turned dofs, get a small part of it. This hardly affects the
  /// forces.
  void startConsistently() {
    SecondOrderModel& m = out_.model;
    const Eigen::Index n = m.mass.rows();
    const Vector mass = m.mass.diagonal(), stiffness = diagonalStiffness();
    std::vector<char> isForce(at(n), 0), bare(at(n), 0);
    for (const auto& multiplier : out_.multipliers)
      for (int i : {multiplier.first, multiplier.second}) {
        isForce[at(i)] = 1;
        bare[at(i)] = mass[i] == 0.0 && stiffness[i] == 0.0 ? 1 : 0;
      }
    Vector r = m.loadAt(0.0) + m.pointForce(0.0, m.initialDisplacement, m.initialVelocity) -
               m.dampingAt(0.0) * m.initialVelocity - m.stiffnessAt(0.0) * m.initialDisplacement;
    const double fastest = model::fastestNode(m, 0.0);
    for (Eigen::Index i = 0; i < n; ++i)
      if (bare[at(i)]) r[i] = 0.0;
    if (r.isZero(0.0) || !contains(bare, 1)) return;
    Triplets entries;
    forEachEntry(m.mass, [&](int i, int j, double value) { entries.emplace_back(i, j, value); });
    for (int i = 0; i < n; ++i) {
      if (mass[i] == 0.0 && !bare[at(i)])
        entries.emplace_back(
            i, i, stiffness[i] != 0.0 && fastest > 0 ? std::abs(stiffness[i]) / fastest : 1.0);
    }
    constexpr double part = 1e-11;
    for (std::size_t k = 0; k < m.stiffness.size(); ++k)
      if (fastest > 0 && k != joining_ && m.laws[at(m.stiffness[k].law)].isOne())
        forEachEntry(m.stiffness[k].matrix, [&](int i, int j, double value) {
          if (!isForce[at(i)] && !isForce[at(j)])
            entries.emplace_back(i, j, part / fastest * value);
        });
    // their stiffness as a mass, so that it does not hide the small part beside it
    const double unit = fastest > 0 ? 1.0 / fastest : 1.0;
    if (joining_)
      forEachEntry(m.stiffness[*joining_].matrix, [&](int i, int j, double value) {
        if (bare[at(i)] != 0 || bare[at(j)] != 0)
          entries.emplace_back(i, j, value * (bare[at(i)] ? unit : 1) * (bare[at(j)] ? unit : 1));
      });
    const linalg::DirectSolver solver(sparse(n, n, entries), model::namer(m));
    const Vector x = solver.solve(r);
    for (Eigen::Index i = 0; i < n; ++i)
      if (bare[at(i)]) m.initialDisplacement[i] = unit * x[i];
  }

  const std::vector<AlignedPart>& alignedParts_;
  const Labelled& labelled_;
  const std::vector<SolvedRow>& solved_;
  const int all_;                       ///< coordinates of `labelled`
  int coordinates_ = 0;                 ///< of the model without multipliers
  std::vector<int> owner_;              ///< per coordinate of `labelled`: its (first) part
  std::vector<int> virtual_;            ///< row in boundaryRows of its part, -1 for a coordinate
  std::vector<int> column_;             ///< position among the coordinates
  std::optional<std::size_t> joining_;  ///< position of the term of the multipliers in the
                                        ///< stiffness
  Sparse labelRows_;                    ///< scaled constraints over `labelled`
  DualModel out_;
};

}  // namespace

DualModel addMultipliers(const std::vector<AlignedPart>& alignedParts, const Labelled& labelled,
                         const Elimination& constraints) {
  return Builder(alignedParts, labelled, constraints).run();
}

}  // namespace tooljoint::coupling
