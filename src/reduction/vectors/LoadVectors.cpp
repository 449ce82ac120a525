// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/vectors/LoadVectors.hpp"

#include <Teuchos_Array.hpp>
#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <string>

#include "common/Error.hpp"
#include "reduction/vectors/ModalVectors.hpp"

namespace tooljoint::reduction {

namespace {

/// Loads and unit forces on points, dofs of the part x columns.
Matrix forces(const model::Substructure& part, const LoadVectorOptions& options) {
  std::vector<Vector> columns;
  if (options.loads)
    for (const auto& load : part.model.loads) columns.push_back(load.vector);
  if (options.points)
    for (const auto& set : part.model.points) {
      const auto width = set.rows.rows() / std::max(1, sizeOf(set.entities));
      for (Eigen::Index r = 0; r < set.rows.rows(); ++r)
        if (options.nodes.empty() || contains(options.nodes, set.entities[at(r / width)]))
          columns.push_back(Vector(set.rows.row(r).transpose()));
    }
  Matrix F(part.model.size(), sizeOf(columns));
  for (int j = 0; j < sizeOf(columns); ++j) F.col(j) = columns[at(j)];
  return F;
}

/// Displacement and velocity at t = 0, dofs of the part x 2.
Matrix startStates(const model::Substructure& part, const LoadVectorOptions& options) {
  const auto& m = part.model;
  Matrix X(m.size(), 2);
  X.col(0) = m.initialDisplacement;
  if (options.keepStatic && part.reference.size() > 0) X.col(0) -= part.reference;
  X.col(1) = m.initialVelocity;
  return X;
}

/// The interior part of these that the boundary dofs do not determine, without columns of rounding.
Matrix interiorStarts(const model::Substructure& part, const LoadVectorOptions& options,
                      const Basis& basis) {
  constexpr double rounding = 1e-12;
  const auto& p = basis.partition;
  const Matrix X = startStates(part, options);
  std::vector<Vector> columns;
  for (Eigen::Index j = 0; j < X.cols(); ++j) {
    Vector q = Vector::Zero(basis.vectors.cols());
    q.head(sizeOf(p.boundary)) = Vector(X.col(j))(p.boundary);
    const Vector rest = X.col(j) - basis.vectors * q;
    const Vector interior = rest(p.interior);
    if (interior.norm() > rounding * X.col(j).norm()) columns.push_back(interior);
  }
  Matrix starts(sizeOf(p.interior), sizeOf(columns));
  for (int j = 0; j < sizeOf(columns); ++j) starts.col(j) = columns[at(j)];
  return starts;
}

void requireFixedInterface(const model::Substructure& part, const Basis& basis) {
  const auto refuse = [&] {
    throw DeckError(
        "\"Load Vectors\" and \"Start State Vectors\" need modes with fixed boundary dofs, but the "
        "basis of part \"" +
        part.name +
        "\" has others. Choose a fixed-interface basis such as \"Craig-Bampton\", or remove them.");
  };
  if (basis.forces() > 0 || basis.inertial.size() > 0) refuse();
  for (int j = 0; j < sizeOf(basis.partition.boundary); ++j)
    forEachInRow(basis.vectors, basis.partition.boundary[at(j)], [&](int column, double value) {
      if (value != (column == j ? 1.0 : 0.0)) refuse();
    });
}

bool sameForces(const model::Substructure& a, const model::Substructure& b,
                const LoadVectorOptions& options) {
  const Matrix f = forces(a, options), g = forces(b, options);
  if (options.startState && startStates(a, options) != startStates(b, options)) return false;
  return f.rows() == g.rows() && f.cols() == g.cols() &&
         (f.size() == 0 || (f - g).cwiseAbs().maxCoeff() <= 1e-13 * f.cwiseAbs().maxCoeff());
}

}  // namespace

void addLoadVectors(const PartView& part, const LoadVectorOptions& options, Basis& basis) {
  if (!options.any()) return;
  requireFixedInterface(part.part(), basis);
  if (basis.partition.interior.empty()) return;
  if (options.startState) {
    const bool orthonormal = basis.orthonormal;
    const int added = appendVectors(part, interiorStarts(part.part(), options, basis),
                                    "start state", options.independence, orthonormal, basis);
    if (added > 0)
      basis.remarks.push_back(std::to_string(added) +
                              " vectors of the start state are added to its modes");
  }
  if (!options.loads && !options.points) return;
  const Matrix F = forces(part.part(), options);
  const Matrix X = viewOf(part, basis).solveInterior(F(basis.partition.interior, Eigen::all));
  const bool orthonormal = basis.orthonormal;
  const int added = appendVectors(part, X, "load", options.independence, orthonormal, basis);
  if (added > 0)
    basis.remarks.push_back(std::to_string(added) + " load vectors of " + std::to_string(F.cols()) +
                            " loads and unit forces are added to its modes");
}

void requirePointNodes(const std::vector<model::Substructure>& parts,
                       const LoadVectorOptions& options) {
  for (const auto node : options.nodes) {
    const bool known =
        std::any_of(parts.begin(), parts.end(), [&](const model::Substructure& part) {
          return std::any_of(part.model.points.begin(), part.model.points.end(),
                             [&](const auto& set) { return contains(set.entities, node); });
        });
    if (!known)
      throw DeckError("\"Load Vector Nodes\" names node " + std::to_string(node) +
                      ", but no substructure has a point law there. Give nodes with contact, "
                      "springs or other point laws, or remove the list to include all of them.");
  }
}

std::vector<int> sameLoads(const std::vector<model::Substructure>& parts,
                           const std::vector<int>& classes, const LoadVectorOptions& options) {
  requirePointNodes(parts, options);
  std::vector<int> same(classes);
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const auto like = [&](std::size_t q) {
      return classes[q] == classes[p] && same[q] == static_cast<int>(q) &&
             sameForces(parts[p], parts[q], options);
    };
    std::size_t first = 0;
    while (first < p && !like(first)) ++first;
    same[p] = static_cast<int>(first);
  }
  return same;
}

void declareLoadVectors(deck::ListSpec& list) {
  list.choice("Load Vectors", std::string("None"), {"None", "Loads", "Points", "Loads and points"},
              "Static responses of the interior of each substructure, added to the modes of a "
              "fixed-interface basis: to its loads, to unit forces at its points of contact and "
              "other point laws, or to both (Dickens, Nakagawa and Wittbrodt 1997).");
  list.boolean("Start State Vectors", false,
               "Add displacement and velocity of the interior at the start to the modes of a basis "
               "with fixed interface, so that the reduced motion starts as the full one. Needed "
               "where a run warns that the basis does not represent the initial state.")
      .expert();
  list.integerArray("Load Vector Nodes", deck::Optional{}, deck::Range::atLeast(1),
                    "Nodes whose points get load vectors; all nodes without it.")
      .expert();
}

LoadVectorOptions readLoadVectors(const Teuchos::ParameterList& list) {
  LoadVectorOptions options;
  const auto& choice = list.get<std::string>("Load Vectors");
  options.loads = choice == "Loads" || choice == "Loads and points";
  options.points = choice == "Points" || choice == "Loads and points";
  options.startState = list.get<bool>("Start State Vectors");
  if (!list.isParameter("Load Vector Nodes")) return options;
  if (!options.points)
    throw DeckError(
        "Reduction gives \"Load Vector Nodes\", but \"Load Vectors\" is \"" + choice +
        "\". Set \"Load Vectors\" to \"Points\" or \"Loads and points\", or remove the nodes.");
  for (const int node : list.get<Teuchos::Array<int>>("Load Vector Nodes"))
    options.nodes.push_back(node);
  return options;
}

}  // namespace tooljoint::reduction
