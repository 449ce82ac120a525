// SPDX-License-Identifier: BSD-3-Clause
#include "coupling/assembly/Assembler.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/Error.hpp"
#include "common/Index.hpp"
#include "common/Text.hpp"
#include "coupling/assembly/AlignedParts.hpp"
#include "coupling/assembly/Congruence.hpp"
#include "coupling/assembly/DualAssembly.hpp"
#include "coupling/assembly/Elimination.hpp"
#include "coupling/assembly/LabelAssembly.hpp"
#include "coupling/assembly/LawsOnForces.hpp"
#include "coupling/input/ComponentAxes.hpp"
#include "coupling/input/DofLookup.hpp"
#include "model/DofNames.hpp"

namespace tooljoint::coupling {

namespace {

using model::DofLabel;
using model::SecondOrderModel;

/// Largest violation of a constraint by an initial state, relative to the largest value.
constexpr double agreement = 1e-9;

/// Builds the coupled model from aligned parts.
class Coupler {
 public:
  Coupler(std::vector<AlignedPart> alignedParts, const CouplingOptions& options)
      : alignedParts_(std::move(alignedParts)),
        options_(options),
        connections_(options.connections) {}

  Coupling run() {
    if (alignedParts_.empty()) throw ModelError("The model has no part to couple.");
    alignComponents(alignedParts_);
    turn(alignedParts_, connections_.frames);
    DofLookup lookup(alignedParts_);
    labelled_ = joinByLabels(alignedParts_, labelRules(lookup));
    addConnectors(lookup);
    const auto onForces =
        checkLawsOnForces(alignedParts_, labelled_, connections_.connectors.size());
    makeRows(lookup);
    const Elimination elimination = eliminate(rows_, ranks());
    out_.remarks = elimination.redundant;
    if (!onForces.empty()) out_.remarks.push_back(onForces);
    if (options_.requireAgreeingStarts) checkStart(elimination);
    if (dual())
      enforceDual(elimination);
    else
      enforcePrimal(elimination);
    number();
    out_.model.validate();
    return std::move(out_);
  }

 private:
  bool dual() const { return options_.assembly == Assembly::Dual; }
  int column(const DofPosition& place) const {
    return labelled_.columns[at(place.part)][at(place.dof)];
  }
  double offset(const DofPosition& place) const {
    return alignedParts_[at(place.part)].offset[place.dof];
  }

  static std::string nameOf(const Constraint& constraint, std::size_t number) {
    return "constraint " +
           (constraint.name.empty() ? std::to_string(number + 1) : "\"" + constraint.name + "\"");
  }
  static std::string nameOf(const Connector& connector) {
    return "The connector \"" + connector.name + "\"";
  }

  LabelRules labelRules(const DofLookup& lookup) const {
    LabelRules rules;
    rules.apart = dual();
    for (const auto& dof : connections_.released)
      for (const auto& place : lookup.find(dof, "A release")) {
        const AlignedPart& alignedPart = alignedParts_[at(place.part)];
        if (!contains(alignedPart.interface, place.dof))
          throw ModelError("A release names " + lookup.describe(dof) +
                           ", which no other part has: nothing is joined there. Remove it from "
                           "the release.");
        rules.released.insert({place.part, place.dof});
      }
    const auto attach = [&](const std::vector<Term>& terms, const std::string& who) {
      for (const auto& term : terms)
        for (const auto& place : lookup.find(term.dof, who))
          rules.attached.insert({place.part, place.dof});
    };
    for (std::size_t k = 0; k < connections_.constraints.size(); ++k)
      attach(connections_.constraints[k].terms, "The " + nameOf(connections_.constraints[k], k));
    for (const auto& connector : connections_.connectors)
      for (const auto& row : connector.rows) attach(row, nameOf(connector));
    return rules;
  }

  /// The coordinate of a dof. If several parts have it and none is named, they must be joined
  /// there.
  DofPosition place(const DofLookup& lookup, const PartDof& dof, const std::string& who) const {
    const auto places = lookup.find(dof, who);
    for (const auto& other : places)
      if (!joined(places.front(), other))
        throw ModelError(who + " names " + lookup.describe(dof) + " without a part, but parts \"" +
                         alignedParts_[at(places.front().part)].name + "\" and \"" +
                         alignedParts_[at(other.part)].name +
                         "\" both have it and are not joined there. Give the part.");
    return places.front();
  }

  bool joined(const DofPosition& a, const DofPosition& b) const {
    if (column(a) == column(b)) return true;
    for (const auto& joint : labelled_.joints) {
      const auto in = [&](const DofPosition& x) {
        return std::any_of(joint.places.begin(), joint.places.end(), [&](const DofPosition& y) {
          return x.part == y.part && x.dof == y.dof;
        });
      };
      if (in(a) && in(b)) return true;
    }
    return false;
  }

  void addConnectors(const DofLookup& lookup) {
    for (const auto& connector : connections_.connectors) {
      const std::string who = nameOf(connector);
      if (!connector.law) throw ModelError(who + " has no law.");
      const int size = connector.law->size(), width = connector.law->width(), rows = size * width;
      if (static_cast<int>(connector.rows.size()) != rows ||
          (connector.offset.size() != 0 && connector.offset.size() != rows))
        throw ModelError(who + " has " + std::to_string(connector.rows.size()) +
                         " rows for a law of " + std::to_string(size) + " points with " +
                         std::to_string(width) + " coordinates each.");
      model::PointSet set;
      set.name = connector.name;
      set.law = connector.law;
      set.offset = connector.offset.size() == 0 ? Vector::Zero(rows) : connector.offset;
      Triplets entries;
      for (int r = 0; r < rows; ++r)
        for (const auto& term : connector.rows[at(r)]) {
          const DofPosition where = place(lookup, term.dof, who);
          entries.emplace_back(r, column(where), term.factor);
          set.offset[r] += term.factor * offset(where);
        }
      for (int p = 0; p < size; ++p) {
        const auto& first = connector.rows[at(p * width)];
        set.entities.push_back(first.empty() ? 0 : first.front().dof.node);
      }
      set.rows = sparse(rows, labelled_.model.mass.rows(), entries);
      labelled_.model.points.push_back(set);
    }
  }

  /// All constraints over the coordinates of labelled_, relative to the reference states of the
  /// reduced parts.
  void makeRows(const DofLookup& lookup) {
    if (dual()) addJoints();
    for (std::size_t k = 0; k < connections_.constraints.size(); ++k) {
      const Constraint& constraint = connections_.constraints[k];
      ConstraintRow row{nameOf(constraint, k), {}, constraint.value};
      double size = std::abs(constraint.value);
      checkKinds(constraint, row.name);
      for (const auto& term : constraint.terms) {
        if (!std::isfinite(term.factor) || !std::isfinite(constraint.value))
          throw ModelError("The " + row.name + " has a factor or a value that is not finite.");
        const DofPosition where = place(lookup, term.dof, "The " + row.name);
        row.entries.emplace_back(column(where), term.factor);
        row.value -= term.factor * offset(where);
        size = std::max(size, std::abs(term.factor * offset(where)));
      }
      if (std::abs(row.value) <= agreement * size) row.value = 0.0;
      rows_.push_back(row);
    }
    if (!dual()) addBoundaries();
  }

  static void checkKinds(const Constraint& constraint, const std::string& name) {
    for (const auto& a : constraint.terms)
      for (const auto& b : constraint.terms)
        if (constraint.sameKind && kindOf(a.dof.component) == ComponentKind::Translation &&
            kindOf(b.dof.component) == ComponentKind::Rotation)
          throw ModelError("The " + name + " makes " + describe(a.dof) + " and " + describe(b.dof) +
                           " equal, but one is a translation and the other a rotation. Join dofs "
                           "of one kind, or give a constraint with a lever arm as factor.");
  }

  /// u_p - u_first = 0 for every further part of a joint.
  void addJoints() {
    for (const auto& joint : labelled_.joints)
      for (std::size_t k = 1; k < joint.places.size(); ++k)
        rows_.push_back({"joint of parts \"" + alignedParts_[at(joint.places.front().part)].name +
                             "\" and \"" + alignedParts_[at(joint.places[k].part)].name + "\" in " +
                             model::describe(joint.label, labelled_.model.componentNames,
                                             labelled_.model.nodeName),
                         {{column(joint.places[k]), 1.0}, {column(joint.places.front()), -1.0}},
                         0.0});
  }

  /// u_b - B_p q_p = 0.
  void addBoundaries() {
    for (std::size_t p = 0; p < alignedParts_.size(); ++p) {
      const AlignedPart& alignedPart = alignedParts_[p];
      if (alignedPart.forces > 0)
        throw ModelError("The coordinates of part \"" + alignedPart.name +
                         "\" contain its interface forces, which need multipliers. Set "
                         "Coupling/Assembly to \"Dual\", or choose a basis with interface dofs.");
      for (int j = 0; j < alignedPart.boundaryRows.rows(); ++j) {
        const int dof = alignedPart.coordinates + j;
        ConstraintRow row{"interface of part \"" + alignedPart.name + "\" in " +
                              model::dofName(*alignedPart.model, dof),
                          {{labelled_.columns[p][at(dof)], 1.0}},
                          0.0};
        forEachInRow(alignedPart.boundaryRows, j, [&](int column, double value) {
          row.entries.emplace_back(labelled_.columns[p][at(column)], -value);
        });
        rows_.push_back(row);
      }
    }
  }

  /// Elimination order: first interface dofs, then other physical dofs, then modes.
  std::vector<int> ranks() const {
    std::vector<int> rank(labelled_.model.dofs.size(), 2);
    for (std::size_t p = 0; p < alignedParts_.size(); ++p) {
      for (std::size_t i = 0; i < labelled_.columns[p].size(); ++i) {
        int& r = rank[at(labelled_.columns[p][i])];
        if (labelled_.model.dofs[at(labelled_.columns[p][i])].kind == DofLabel::Kind::Physical)
          r = std::min(r, 1);
      }
      for (int i : alignedParts_[p].interface) rank[at(labelled_.columns[p][at(i)])] = 0;
    }
    return rank;
  }

  void checkStart(const Elimination& elimination) const {
    const auto check = [&](const Vector& y, bool velocity) {
      const double largest = y.size() > 0 ? y.cwiseAbs().maxCoeff() : 0.0;
      for (const auto& solved : elimination.solved) {
        double value = velocity ? 0.0 : solved.value;
        double size = std::max(largest, std::abs(value));
        for (const auto& [other, factor] : solved.rest) {
          value += factor * y[other];
          size = std::max(size, std::abs(factor * y[other]));
        }
        if (std::abs(y[solved.unknown] - value) <= agreement * size) continue;
        throw ModelError("The initial " + std::string(velocity ? "velocity" : "displacement") +
                         " of " + model::dofName(labelled_.model, solved.unknown) + " is " +
                         formatNumber(y[solved.unknown]) + ", but the " +
                         rows_[at(solved.row)].name + " requires " + formatNumber(value) +
                         ". Joined parts must start from the same state.");
      }
    };
    check(labelled_.model.initialDisplacement, false);
    check(labelled_.model.initialVelocity, true);
  }

  /// y = L z + offset.
  void enforcePrimal(const Elimination& elimination) {
    out_.model = std::move(labelled_.model);
    const int all = sizeOf(out_.model.dofs);
    offset_ = Vector::Zero(all);
    map_ = Sparse(all, all);
    map_.setIdentity();
    if (elimination.solved.empty()) return;
    std::vector<char> keep(at(all), 1);
    Triplets entries;
    for (const auto& solved : elimination.solved) {
      keep[at(solved.unknown)] = 0;
      for (const auto& [other, factor] : solved.rest)
        entries.emplace_back(solved.unknown, other, factor);
      offset_[solved.unknown] = solved.value;
    }
    Substitution s;
    keepOnly(out_.model, keep, entries, 0, s);
    s.offset = offset_;
    substitute(out_.model, s);
    map_ = s.map;
  }

  void enforceDual(const Elimination& elimination) {
    offset_ = Vector::Zero(static_cast<Eigen::Index>(labelled_.model.dofs.size()));
    DualModel dualModel = addMultipliers(alignedParts_, labelled_, elimination);
    out_.model = std::move(dualModel.model);
    out_.multipliers = std::move(dualModel.multipliers);
    map_.swap(dualModel.map);
  }

  /// Computes the narrow numbering, and the coordinates of every part in it.
  void number() {
    const auto position = narrowNumbering(out_.model);
    renumber(out_.model, position);
    const Sparse map = moveColumns(map_, position, map_.cols());
    for (auto& multiplier : out_.multipliers) {
      multiplier.first = position[at(multiplier.first)];
      multiplier.second = position[at(multiplier.second)];
    }
    for (std::size_t p = 0; p < alignedParts_.size(); ++p) {
      const AlignedPart& alignedPart = alignedParts_[p];
      const auto& columns = labelled_.columns[p];
      Triplets entries;
      Vector local = offset_(columns);
      for (int i = 0; i < sizeOf(columns); ++i)
        forEachInRow(map, columns[at(i)],
                     [&](int column, double value) { entries.emplace_back(i, column, value); });
      Sparse own = sparse(local.size(), map.cols(), entries);
      if (alignedPart.turn.rows() > 0) {
        own = Sparse(alignedPart.turn * own);
        local = alignedPart.turn * local;
      }
      out_.maps.push_back(own.topRows(alignedPart.coordinates));
      out_.recoveryTurns.push_back(alignedPart.recoveryTurn);
      out_.offsets.push_back(local.head(alignedPart.coordinates));
      out_.positions.push_back(positionsOf(out_.maps.back()));
    }
    listInterface(map);
  }

  /// Joined dofs that remain coordinates; in dual assembly those of all parts.
  void listInterface(const Sparse& map) {
    const auto position = positionsOf(map);
    for (const auto& joint : labelled_.joints)
      for (const auto& place : joint.places)
        if (position[at(column(place))] >= 0) out_.interface.push_back(position[at(column(place))]);
    makeUnique(out_.interface);
    out_.joinedDofs = sizeOf(out_.interface);
  }

  std::vector<AlignedPart> alignedParts_;
  const CouplingOptions& options_;
  const Connections& connections_;
  Labelled labelled_;
  std::vector<ConstraintRow> rows_;
  Sparse map_;     ///< coordinates of labelled_ in terms of those of the result
  Vector offset_;  ///< likewise
  Coupling out_;
};

}  // namespace

bool Coupling::boolean() const {
  return std::none_of(positions.begin(), positions.end(),
                      [](const auto& part) { return contains(part, -1); });
}

Coupling coupleWithPositions(const std::vector<reduction::ReducedSubstructure>& parts,
                             const CouplingOptions& options) {
  return Coupler(alignParts(parts), options).run();
}

Coupling coupleWithPositions(const std::vector<model::Substructure>& parts,
                             const CouplingOptions& options) {
  return Coupler(alignParts(parts), options).run();
}

SecondOrderModel couple(const std::vector<reduction::ReducedSubstructure>& parts,
                        const CouplingOptions& options) {
  return coupleWithPositions(parts, options).model;
}
SecondOrderModel couple(const std::vector<model::Substructure>& parts,
                        const CouplingOptions& options) {
  return coupleWithPositions(parts, options).model;
}

int halfBandwidth(const SecondOrderModel& model) {
  int width = 0;
  forEachMatrix(model, [&](const Sparse& A) {
    forEachEntry(A, [&](int i, int j, double value) {
      if (value != 0.0) width = std::max(width, std::abs(i - j));
    });
  });
  return width;
}

}  // namespace tooljoint::coupling
