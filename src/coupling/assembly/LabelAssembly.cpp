// SPDX-License-Identifier: BSD-3-Clause
#include "coupling/assembly/LabelAssembly.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "common/Error.hpp"
#include "common/Index.hpp"
#include "common/Text.hpp"
#include "coupling/assembly/Congruence.hpp"

namespace tooljoint::coupling {

namespace {

using model::DofLabel;
using model::SecondOrderModel;

/// States and recovery rows of shared dofs may differ by this, relative to the largest value.
constexpr double agreementOfValues = 1e-9;

class Labeller {
 public:
  Labeller(const std::vector<AlignedPart>& alignedParts, const LabelRules& rules)
      : alignedParts_(alignedParts), rules_(rules) {}

  Labelled run() {
    out_.model.componentNames = part(0).componentNames;
    out_.model.nodeName = part(0).nodeName;
    findJoints();
    numberDofs();
    assembleMatrices();
    assembleLoads();
    for (int p = 0; p < parts(); ++p)
      for (const auto& set : part(p).points) {
        out_.model.points.push_back(set);
        out_.model.points.back().rows = moveColumns(set.rows, out_.columns[at(p)], size());
      }
    assembleStates();
    assembleRecovery();
    return std::move(out_);
  }

 private:
  const std::string& name(int p) const { return alignedParts_[at(p)].name; }
  const SecondOrderModel& part(int p) const { return *alignedParts_[at(p)].model; }
  int parts() const { return static_cast<int>(alignedParts_.size()); }
  int size() const { return static_cast<int>(out_.model.dofs.size()); }
  std::string describe(const DofLabel& label) const {
    return model::describe(label, out_.model.componentNames, out_.model.nodeName);
  }
  bool released(int p, int i) const { return rules_.released.count({p, i}) > 0; }

  /// Finds the interface dofs of each label; checks that no other part has the label of an inner
  /// dof.
  void findJoints() {
    std::map<DofLabel, std::vector<DofPosition>> shared;
    std::map<DofLabel, DofPosition> inner;
    for (int p = 0; p < parts(); ++p) {
      std::vector<char> open(at(part(p).size()), 0);
      for (int i : alignedParts_[at(p)].interface) open[at(i)] = 1;
      std::map<DofLabel, int> own;
      for (int i = 0; i < part(p).size(); ++i) {
        const DofLabel label = labelOf(p, i);
        if (!own.emplace(label, i).second)
          throw ModelError("Part \"" + name(p) + "\" has " + describe(label) +
                           " twice. Give every dof of a part its own label.");
        if (open[at(i)]) {
          shared[label].push_back({p, i});
        } else if (const auto [it, fresh] = inner.emplace(label, DofPosition{p, i}); !fresh) {
          throw ModelError("Parts \"" + name(it->second.part) + "\" and \"" + name(p) +
                           "\" both have " + describe(label) +
                           ", but as an interior dof, which cannot be joined. Declare it an "
                           "interface dof of both parts, or let parts that only use the same "
                           "numbers count their own nodes (Coupling/Node Numbers \"Own\").");
        }
      }
    }
    for (const auto& [label, places] : shared) {
      if (const auto it = inner.find(label); it != inner.end())
        throw ModelError(describe(label) + " is an interface dof of part \"" +
                         name(places.front().part) + "\" but an interior dof of part \"" +
                         name(it->second.part) + "\". Declare it an interface dof of both parts.");
      const DofPosition& first = places.front();
      if (places.size() < 2 && rules_.attached.count({first.part, first.dof}) == 0 &&
          !released(first.part, first.dof))
        throw ModelError("The interface dof " + describe(label) + " of part \"" + name(first.part) +
                         "\" is not joined: no other part has it. Check the labels, or remove it "
                         "from the interface.");
      Joint joint{label, {}};
      for (const auto& place : places)
        if (!released(place.part, place.dof)) joint.places.push_back(place);
      if (joint.places.size() > 1) out_.joints.push_back(joint);
      if (places.size() > 1)
        for (const auto& place : places)
          if (rules_.apart || released(place.part, place.dof)) own_.insert({place.part, place.dof});
    }
  }

  DofLabel labelOf(int p, int i) const {
    const DofLabel& label = part(p).dofs[at(i)];
    return label.kind == DofLabel::Kind::Modal ? DofLabel::modal(p, label.component) : label;
  }

  /// Numbers the dofs of all parts as coordinates; joined dofs get the same. Modes are renumbered
  /// by part.
  void numberDofs() {
    out_.columns.resize(at(parts()));
    std::map<DofLabel, int> numberOf;
    for (int p = 0; p < parts(); ++p)
      for (int i = 0; i < part(p).size(); ++i) {
        const DofLabel label = own_.count({p, i}) > 0 ? labelOf(p, i).of(p) : labelOf(p, i);
        const auto [it, fresh] = numberOf.emplace(label, size());
        if (fresh) out_.model.dofs.push_back(label);
        out_.columns[at(p)].push_back(it->second);
      }
    stands_ = range(size());
    for (const auto& joint : out_.joints)
      for (const auto& place : joint.places)
        stands_[at(column(place))] = column(joint.places.front());
  }

  int column(const DofPosition& place) const { return out_.columns[at(place.part)][at(place.dof)]; }

  /// Adds L_p' A L_p as entries.
  void scatter(int p, const Sparse& A, Triplets& entries) const {
    const auto& to = out_.columns[at(p)];
    forEachEntry(A, [&](int i, int j, double value) {
      if (value != 0.0) entries.emplace_back(to[at(i)], to[at(j)], value);
    });
  }

  Sparse square(const Triplets& entries) const {
    return withoutZeros(sparse(size(), size(), entries));
  }

  /// Law of a part as an index of the coupled model.
  int mergedLaw(int p, int law) { return out_.model.lawIndex(part(p).laws[at(law)]); }

  std::vector<model::MatrixTerm> mergeTerms(
      model::SharedList<model::MatrixTerm> SecondOrderModel::*terms) {
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
        auto it = std::find_if(loads.begin(), loads.end(), [&](const model::LoadTerm& other) {
          return other.name == load.name && other.law == law;
        });
        if (it == loads.end()) it = loads.insert(it, {load.name, Vector::Zero(size()), law});
        for (int i = 0; i < part(p).size(); ++i)
          it->vector[out_.columns[at(p)][at(i)]] += load.vector[i];
      }
  }

  /// True if the boundary dofs of a part are functions of its modes.
  bool derives(int p) const { return alignedParts_[at(p)].boundaryRows.rows() > 0; }
  static constexpr const char* derivedStart =
      "The bases of these parts have no boundary dofs of their own (Dual Craig-Bampton), and their "
      "modes give each part another start. Choose a basis with boundary dofs, such as "
      "\"Craig-Bampton\", or keep more modes.";

  /// Assembles the values of all parts; those of joined dofs must agree.
  template <class ValuesOf>
  Vector gather(const ValuesOf& valuesOf, const std::string& what,
                const std::string& advice) const {
    Vector all = Vector::Zero(size());
    std::vector<int> from(at(size()), -1);  // of the dof that represents the joint
    double largest = 0;
    for (int p = 0; p < parts(); ++p)
      largest = std::max(largest, part(p).size() > 0 ? valuesOf(p).cwiseAbs().maxCoeff() : 0.0);
    for (int p = 0; p < parts(); ++p) {
      const Vector& values = valuesOf(p);
      for (int i = 0; i < part(p).size(); ++i) {
        const int dof = out_.columns[at(p)][at(i)], joint = stands_[at(dof)];
        int& first = from[at(joint)];
        if (first < 0) {
          first = p;
          all[joint] = values[i];
        } else if (std::abs(all[joint] - values[i]) > agreementOfValues * largest) {
          throw ModelError("The " + what + " of " + describe(part(p).dofs[at(i)]) + " is " +
                           formatNumber(all[joint]) + " in part \"" + name(first) + "\" and " +
                           formatNumber(values[i]) + " in part \"" + name(p) + "\". " +
                           (derives(first) || derives(p) ? std::string(derivedStart) : advice));
        }
        all[dof] = all[joint];
      }
    }
    return all;
  }

  void assembleStates() {
    gather([this](int p) -> const Vector& { return alignedParts_[at(p)].offset; },
           "reference state", "Joined parts must be reduced about the same state.");
    const std::string advice = "Joined parts must start from the same state.";
    out_.model.initialDisplacement =
        gather([this](int p) -> const Vector& { return part(p).initialDisplacement; },
               "initial displacement", advice);
    out_.model.initialVelocity =
        gather([this](int p) -> const Vector& { return part(p).initialVelocity; },
               "initial velocity", advice);
  }

  /// An output row of one part.
  struct OutputRow {
    int part;
    int row;
  };

  void assembleRecovery() {
    const int components = static_cast<int>(out_.model.componentNames.size());
    std::map<std::int64_t, std::vector<OutputRow>> nodes;  // component by component
    std::vector<Sparse> rows;
    for (int p = 0; p < parts(); ++p) {
      const SecondOrderModel& m = part(p);
      const auto expected = static_cast<Eigen::Index>(m.recoveryNodes.size()) * components;
      if (expected > 0 && (m.recovery.rows() != expected || m.recovery.cols() != m.size() ||
                           m.recoveryOffset.size() != expected))
        throw ModelError("Part \"" + name(p) + "\": its recovery rows do not match its " +
                         std::to_string(m.recoveryNodes.size()) + " output nodes with " +
                         std::to_string(components) + " components each.");
      rows.push_back(expected > 0 ? moveColumns(m.recovery, out_.columns[at(p)], size())
                                  : Sparse(0, size()));
      for (std::size_t n = 0; n < m.recoveryNodes.size(); ++n) {
        auto& known = nodes[m.recoveryNodes[n]];
        for (int c = 0; c < components; ++c) {
          const OutputRow here{p, static_cast<int>(n) * components + c};
          if (sizeOf(known) <= c)
            known.push_back(here);
          else if (empty(rows, known[at(c)]))
            known[at(c)] = here;
          else if (!empty(rows, here))
            compareRows(rows, known[at(c)], here, DofLabel::physical(m.recoveryNodes[n], c));
        }
      }
    }
    Triplets entries;
    out_.model.recoveryOffset.resize(static_cast<Eigen::Index>(nodes.size()) * components);
    int row = 0;
    for (const auto& [node, known] : nodes) {
      out_.model.recoveryNodes.push_back(node);
      for (const auto& from : known) {
        out_.model.recoveryOffset[row] = offsetOf(from);
        forEachInRow(rows[at(from.part)], from.row,
                     [&](int column, double value) { entries.emplace_back(row, column, value); });
        ++row;
      }
    }
    out_.model.recovery = sparse(row, size(), entries);
  }

  double offsetOf(const OutputRow& row) const { return part(row.part).recoveryOffset[row.row]; }

  /// True if the part does not have the component (its row is zero): another part may recover it.
  bool empty(const std::vector<Sparse>& rows, const OutputRow& row) const {
    bool zero = offsetOf(row) == 0.0;
    forEachInRow(rows[at(row.part)], row.row, [&](int, double) { zero = false; });
    return zero;
  }

  /// True if the dof is released in one of the parts, so that its motion differs.
  bool free(const DofLabel& dof, int a, int b) const {
    for (const auto& [p, i] : rules_.released)
      if ((p == a || p == b) && part(p).dofs[at(i)] == dof) return true;
    return false;
  }

  /// A row in terms of the dofs that represent joints.
  Eigen::SparseVector<double> standing(const Sparse& rows, int row) const {
    Eigen::SparseVector<double> out(size());
    forEachInRow(rows, row,
                 [&](int column, double value) { out.coeffRef(stands_[at(column)]) += value; });
    return out;
  }

  void compareRows(const std::vector<Sparse>& rows, const OutputRow& a, const OutputRow& b,
                   const DofLabel& dof) const {
    if (derives(a.part) || derives(b.part) || free(dof, a.part, b.part)) return;
    const auto left = standing(rows[at(a.part)], a.row);
    const auto right = standing(rows[at(b.part)], b.row);
    const double scale = std::max({1.0, left.norm(), right.norm()});
    const double offsetScale = std::max({std::abs(offsetOf(a)), std::abs(offsetOf(b)),
                                         part(a.part).recoveryOffset.cwiseAbs().maxCoeff()});
    const Eigen::SparseVector<double> difference = left - right;
    if (difference.norm() > agreementOfValues * scale ||
        std::abs(offsetOf(a) - offsetOf(b)) > agreementOfValues * offsetScale)
      throw ModelError("The motion of " + describe(dof) + " is recovered differently by part \"" +
                       name(a.part) + "\" and part \"" + name(b.part) +
                       "\". Join the shared node in every dof, or recover it by one part only.");
  }

  const std::vector<AlignedPart>& alignedParts_;
  const LabelRules& rules_;
  std::set<std::pair<int, int>> own_;  ///< (part, dof): one of several with its label, not joined
  std::vector<int> stands_;  ///< per coordinate: the first of the coordinates it is or will be
                             ///< joined to
  Labelled out_;
};

}  // namespace

Labelled joinByLabels(const std::vector<AlignedPart>& alignedParts, const LabelRules& rules) {
  return Labeller(alignedParts, rules).run();
}

}  // namespace tooljoint::coupling
