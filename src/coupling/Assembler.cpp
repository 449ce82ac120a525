// SPDX-License-Identifier: BSD-3-Clause
#include "coupling/Assembler.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "common/Error.hpp"
#include "common/Text.hpp"
#include "coupling/Numbering.hpp"

namespace tooljoint::coupling {

namespace {

using model::DofLabel;
using model::SecondOrderModel;

/// States and recovery rows of shared dofs may differ by this, relative to the largest value.
constexpr double agreement = 1e-9;

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// What the assembler sees of a part, reduced or not.
struct Piece {
  std::string name;
  const SecondOrderModel* model = nullptr;
  std::vector<int> interface;  ///< positions
  Vector offset;               ///< D at q = 0 of the interface dofs
};

/// A place where a label stands.
struct Place {
  int part;
  int dof;
};

class Assembly {
 public:
  explicit Assembly(std::vector<Piece> pieces) : pieces_(std::move(pieces)) {}

  Coupling run() {
    if (pieces_.empty()) throw ModelError("There is no part to couple.");
    checkComponents();
    joinDofs();
    numberDofs();
    assembleMatrices();
    assembleLoads();
    assemblePoints();
    assembleStates();
    assembleRecovery();
    out_.model.validate();
    return std::move(out_);
  }

 private:
  const std::string& name(int p) const { return pieces_[at(p)].name; }
  const SecondOrderModel& part(int p) const { return *pieces_[at(p)].model; }
  int parts() const { return static_cast<int>(pieces_.size()); }
  std::string describe(const DofLabel& label) const { return model::describe(label, pieces_.front().model->componentNames); }

  void checkComponents() {
    const auto& first = part(0).componentNames;
    for (int p = 1; p < parts(); ++p)
      if (part(p).componentNames != first)
        throw ModelError("Parts \"" + name(0) + "\" and \"" + name(p) +
                         "\" do not speak of the same dofs: the components of a node are " + quotedList(first) +
                         " in the first and " + quotedList(part(p).componentNames) + " in the second.");
    out_.model.componentNames = first;
  }

  /// Gives every dof of every part a coupled dof; interface dofs of one label get the same. Modes are renumbered by part.
  void joinDofs() {
    std::map<DofLabel, std::vector<Place>> joints;
    std::map<DofLabel, Place> inner;
    for (int p = 0; p < parts(); ++p) {
      std::vector<char> shared(at(part(p).size()), 0);
      for (int i : pieces_[at(p)].interface) shared[at(i)] = 1;
      std::map<DofLabel, int> own;
      for (int i = 0; i < part(p).size(); ++i) {
        const DofLabel label = labelOf(p, i);
        if (!own.emplace(label, i).second)
          throw ModelError("Part \"" + name(p) + "\" has " + describe(label) +
                           " twice; every dof of a part needs a label of its own.");
        if (shared[at(i)]) {
          joints[label].push_back({p, i});
        } else if (const auto [it, fresh] = inner.emplace(label, Place{p, i}); !fresh) {
          throw ModelError("Parts \"" + name(it->second.part) + "\" and \"" + name(p) + "\" both have " + describe(label) +
                           ", but as an inner dof, which nothing can be joined to. Declare it an interface dof of both parts.");
        }
      }
    }
    for (const auto& [label, places] : joints) {
      if (const auto it = inner.find(label); it != inner.end())
        throw ModelError(describe(label) + " is an interface dof of part \"" + name(places.front().part) +
                         "\" but an inner dof of part \"" + name(it->second.part) +
                         "\". Declare it an interface dof of both parts.");
      if (places.size() < 2)
        throw ModelError("The interface dof " + describe(label) + " of part \"" + name(places.front().part) +
                         "\" joins nothing: no other part has it. Check the labels, or take it out of the interface.");
    }
    out_.positions.resize(at(parts()));
    std::map<DofLabel, int> numberOf;
    for (int p = 0; p < parts(); ++p)
      for (int i = 0; i < part(p).size(); ++i) {
        const DofLabel label = labelOf(p, i);
        const auto [it, fresh] = numberOf.emplace(label, static_cast<int>(labels_.size()));
        if (fresh) labels_.push_back(label);
        out_.positions[at(p)].push_back(it->second);
      }
  }

  DofLabel labelOf(int p, int i) const {
    const DofLabel& label = part(p).dofs[at(i)];
    return label.kind == DofLabel::Kind::Modal ? DofLabel::modal(p, label.component) : label;
  }

  /// Walks over groups: the dofs of a node together, every mode by itself.
  void numberDofs() {
    std::map<DofLabel, int> groupOf;
    std::vector<std::vector<int>> members;
    std::vector<int> group(labels_.size());
    const auto key = [](const DofLabel& label) {
      return label.kind == DofLabel::Kind::Physical ? DofLabel::physical(label.entity, 0) : label;
    };
    for (const auto& label : labels_) groupOf.emplace(key(label), 0);
    int next = 0;
    for (auto& [label, number] : groupOf) number = next++;
    members.resize(at(next));
    for (std::size_t i = 0; i < labels_.size(); ++i) {
      group[i] = groupOf.at(key(labels_[i]));
      members[at(group[i])].push_back(static_cast<int>(i));
    }
    std::vector<std::pair<int, int>> edges;
    for (int p = 0; p < parts(); ++p) {
      std::vector<std::pair<int, int>> own;
      forEachMatrix(part(p), [&](const Sparse& A) {
        for (int i = 0; i < A.outerSize(); ++i)
          for (Sparse::InnerIterator it(A, i); it; ++it) {
            const int a = group[at(out_.positions[at(p)][at(i)])];
            const int b = group[at(out_.positions[at(p)][at(static_cast<int>(it.col()))])];
            if (it.value() != 0.0 && a < b) own.emplace_back(a, b);
            if (it.value() != 0.0 && b < a) own.emplace_back(b, a);
          }
        std::sort(own.begin(), own.end());
        own.erase(std::unique(own.begin(), own.end()), own.end());
      });
      edges.insert(edges.end(), own.begin(), own.end());
    }
    std::vector<int> number(labels_.size());
    next = 0;
    for (int g : cuthillMcKee(static_cast<int>(members.size()), edges)) {
      auto& dofs = members[at(g)];
      std::sort(dofs.begin(), dofs.end(), [&](int a, int b) { return labels_[at(a)] < labels_[at(b)]; });
      for (int i : dofs) {
        number[at(i)] = next++;
        out_.model.dofs.push_back(labels_[at(i)]);
      }
    }
    for (auto& positions : out_.positions)
      for (int& i : positions) i = number[at(i)];
  }

  template <class Visit>
  static void forEachMatrix(const SecondOrderModel& model, const Visit& visit) {
    visit(model.mass);
    for (const auto& term : model.damping) visit(term.matrix);
    for (const auto& term : model.stiffness) visit(term.matrix);
  }

  int size() const { return static_cast<int>(labels_.size()); }

  /// L_p' A L_p as entries.
  void scatter(int p, const Sparse& A, Triplets& entries) const {
    const auto& to = out_.positions[at(p)];
    for (int i = 0; i < A.outerSize(); ++i)
      for (Sparse::InnerIterator it(A, i); it; ++it)
        if (it.value() != 0.0) entries.emplace_back(to[at(i)], to[at(static_cast<int>(it.col()))], it.value());
  }

  Sparse square(const Triplets& entries) const {
    Sparse A(size(), size());
    A.setFromTriplets(entries.begin(), entries.end());
    A.prune([](Eigen::Index, Eigen::Index, double value) { return value != 0.0; });
    return A;
  }

  /// Law of a part as an index of the coupled model.
  int mergedLaw(int p, int law) { return out_.model.lawIndex(part(p).laws[at(law)]); }

  std::vector<model::MatrixTerm> mergeTerms(std::vector<model::MatrixTerm> SecondOrderModel::*terms) {
    std::vector<model::MatrixTerm> merged;
    std::vector<Triplets> entries;
    for (int p = 0; p < parts(); ++p)
      for (const auto& term : part(p).*terms) {
        const int law = mergedLaw(p, term.law);
        std::size_t k = 0;
        while (k < merged.size() && (merged[k].name != term.name || merged[k].law != law)) ++k;
        if (k == merged.size()) {
          merged.push_back({term.name, Sparse(), law});
          entries.emplace_back();
        }
        scatter(p, term.matrix, entries[k]);
      }
    for (std::size_t k = 0; k < merged.size(); ++k) merged[k].matrix = square(entries[k]);
    return merged;
  }

  void assembleMatrices() {
    Triplets entries;
    for (int p = 0; p < parts(); ++p) scatter(p, part(p).mass, entries);
    out_.model.mass = square(entries);
    out_.model.damping = mergeTerms(&SecondOrderModel::damping);
    out_.model.stiffness = mergeTerms(&SecondOrderModel::stiffness);
  }

  void assembleLoads() {
    auto& loads = out_.model.loads;
    for (int p = 0; p < parts(); ++p)
      for (const auto& load : part(p).loads) {
        const int law = mergedLaw(p, load.law);
        auto it = std::find_if(loads.begin(), loads.end(),
                               [&](const model::LoadTerm& other) { return other.name == load.name && other.law == law; });
        if (it == loads.end()) it = loads.insert(it, {load.name, Vector::Zero(size()), law});
        for (int i = 0; i < part(p).size(); ++i) it->vector[out_.positions[at(p)][at(i)]] += load.vector[i];
      }
  }

  /// rows L_p
  Sparse moveColumns(int p, const Sparse& rows) const {
    Triplets entries;
    for (int i = 0; i < rows.outerSize(); ++i)
      for (Sparse::InnerIterator it(rows, i); it; ++it)
        if (it.value() != 0.0) entries.emplace_back(i, out_.positions[at(p)][at(static_cast<int>(it.col()))], it.value());
    Sparse moved(rows.rows(), size());
    moved.setFromTriplets(entries.begin(), entries.end());
    return moved;
  }

  void assemblePoints() {
    for (int p = 0; p < parts(); ++p)
      for (const auto& set : part(p).points) {
        out_.model.points.push_back(set);
        out_.model.points.back().rows = moveColumns(p, set.rows);
      }
  }

  /// Puts the values of all parts together; shared dofs must agree.
  template <class ValuesOf>
  Vector gather(const ValuesOf& valuesOf, const std::string& what, const std::string& advice) const {
    Vector all = Vector::Zero(size());
    std::vector<int> from(labels_.size(), -1);
    double largest = 0;
    for (int p = 0; p < parts(); ++p)
      for (const auto& [i, value] : valuesOf(p)) largest = std::max(largest, std::abs(value));
    for (int p = 0; p < parts(); ++p)
      for (const auto& [i, value] : valuesOf(p)) {
        const int dof = out_.positions[at(p)][at(i)];
        int& first = from[at(dof)];
        if (first < 0) {
          first = p;
          all[dof] = value;
        } else if (std::abs(all[dof] - value) > agreement * largest) {
          throw ModelError("The " + what + " of " + describe(out_.model.dofs[at(dof)]) + " is " + formatNumber(all[dof]) +
                           " in part \"" + name(first) + "\" and " + formatNumber(value) + " in part \"" + name(p) + "\". " +
                           advice);
        }
      }
    return all;
  }

  void assembleStates() {
    const auto whole = [this](Vector SecondOrderModel::*state) {
      return [this, state](int p) {
        std::vector<std::pair<int, double>> values;
        for (int i = 0; i < part(p).size(); ++i) values.emplace_back(i, (part(p).*state)[i]);
        return values;
      };
    };
    gather(
        [this](int p) {
          std::vector<std::pair<int, double>> values;
          for (std::size_t j = 0; j < pieces_[at(p)].interface.size(); ++j)
            values.emplace_back(pieces_[at(p)].interface[j], pieces_[at(p)].offset[static_cast<Eigen::Index>(j)]);
          return values;
        },
        "reference state", "Parts that meet must be reduced about one state.");
    const std::string advice = "Parts that meet must start from one state.";
    out_.model.initialDisplacement = gather(whole(&SecondOrderModel::initialDisplacement), "initial displacement", advice);
    out_.model.initialVelocity = gather(whole(&SecondOrderModel::initialVelocity), "initial velocity", advice);
  }

  /// Output rows of a node in one part.
  struct NodeRows {
    int part;
    int firstRow;
  };

  void assembleRecovery() {
    const int components = static_cast<int>(out_.model.componentNames.size());
    std::map<std::int64_t, NodeRows> nodes;
    std::vector<Sparse> rows;
    for (int p = 0; p < parts(); ++p) {
      const SecondOrderModel& m = part(p);
      const auto expected = static_cast<Eigen::Index>(m.recoveryNodes.size()) * components;
      if (expected > 0 && (m.recovery.rows() != expected || m.recovery.cols() != m.size() || m.recoveryOffset.size() != expected))
        throw ModelError("Part \"" + name(p) + "\": its recovery rows do not match its " +
                         std::to_string(m.recoveryNodes.size()) + " output nodes with " + std::to_string(components) +
                         " components each.");
      rows.push_back(expected > 0 ? moveColumns(p, m.recovery) : Sparse(0, size()));
      for (std::size_t n = 0; n < m.recoveryNodes.size(); ++n) {
        const NodeRows here{p, static_cast<int>(n) * components};
        const auto [it, fresh] = nodes.emplace(m.recoveryNodes[n], here);
        if (!fresh) compareRows(rows, it->second, here, it->first, components);
      }
    }
    Triplets entries;
    out_.model.recoveryOffset.resize(static_cast<Eigen::Index>(nodes.size()) * components);
    int row = 0;
    for (const auto& [node, where] : nodes) {
      out_.model.recoveryNodes.push_back(node);
      for (int c = 0; c < components; ++c, ++row) {
        out_.model.recoveryOffset[row] = part(where.part).recoveryOffset[where.firstRow + c];
        for (Sparse::InnerIterator it(rows[at(where.part)], where.firstRow + c); it; ++it)
          entries.emplace_back(row, static_cast<int>(it.col()), it.value());
      }
    }
    out_.model.recovery = Sparse(row, size());
    out_.model.recovery.setFromTriplets(entries.begin(), entries.end());
  }

  void compareRows(const std::vector<Sparse>& rows, const NodeRows& a, const NodeRows& b, std::int64_t node,
                   int components) const {
    for (int c = 0; c < components; ++c) {
      const Eigen::SparseVector<double> left = rows[at(a.part)].row(a.firstRow + c);
      const Eigen::SparseVector<double> right = rows[at(b.part)].row(b.firstRow + c);
      const double leftOffset = part(a.part).recoveryOffset[a.firstRow + c];
      const double rightOffset = part(b.part).recoveryOffset[b.firstRow + c];
      const double scale = std::max({1.0, left.norm(), right.norm()});
      const double offsetScale =
          std::max({std::abs(leftOffset), std::abs(rightOffset), part(a.part).recoveryOffset.cwiseAbs().maxCoeff()});
      const Eigen::SparseVector<double> difference = left - right;
      if (difference.norm() > agreement * scale || std::abs(leftOffset - rightOffset) > agreement * offsetScale)
        throw ModelError("The motion of " + describe(DofLabel::physical(node, c)) + " is recovered differently by part \"" +
                         name(a.part) + "\" and part \"" + name(b.part) +
                         "\". A node that two parts share must be joined in every dof, or recovered by one of them only.");
    }
  }

  std::vector<Piece> pieces_;
  std::vector<DofLabel> labels_;  ///< of the coupled dofs, in order of first appearance
  Coupling out_;
};

}  // namespace

Coupling coupleWithPositions(const std::vector<reduction::ReducedSubstructure>& parts) {
  std::vector<Piece> pieces;
  for (const auto& part : parts) {
    Piece piece{part.name, &part.model, {}, Vector::Zero(part.interface)};
    for (int i = 0; i < part.interface; ++i) {
      piece.interface.push_back(i);
      piece.offset[i] = part.offset[part.basis.partition.interface[at(i)]];
    }
    pieces.push_back(piece);
  }
  return Assembly(pieces).run();
}

Coupling coupleWithPositions(const std::vector<model::Substructure>& parts) {
  std::vector<Piece> pieces;
  for (const auto& part : parts) {
    reduction::checkPart(part);
    pieces.push_back({part.name, &part.model, part.interface, Vector::Zero(static_cast<Eigen::Index>(part.interface.size()))});
  }
  return Assembly(pieces).run();
}

SecondOrderModel couple(const std::vector<reduction::ReducedSubstructure>& parts) { return coupleWithPositions(parts).model; }
SecondOrderModel couple(const std::vector<model::Substructure>& parts) { return coupleWithPositions(parts).model; }

int halfBandwidth(const SecondOrderModel& model) {
  int width = 0;
  const auto look = [&](const Sparse& A) {
    for (int i = 0; i < A.outerSize(); ++i)
      for (Sparse::InnerIterator it(A, i); it; ++it)
        if (it.value() != 0.0) width = std::max(width, std::abs(i - static_cast<int>(it.col())));
  };
  look(model.mass);
  for (const auto& term : model.damping) look(term.matrix);
  for (const auto& term : model.stiffness) look(term.matrix);
  return width;
}

}  // namespace tooljoint::coupling
