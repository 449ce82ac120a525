// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/vectors/LoadVectors.hpp"

#include <Eigen/Dense>
#include <Teuchos_Array.hpp>
#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <string>

#include "common/Error.hpp"
#include "linalg/trilinos/DirectSolver.hpp"
#include "reduction/vectors/ModalVectors.hpp"

namespace tooljoint::reduction {

namespace {

bool chosen(const LoadVectorOptions& options, std::int64_t node) {
  return options.nodes.empty() ||
         std::find(options.nodes.begin(), options.nodes.end(), node) != options.nodes.end();
}

/// Loads and unit forces on points, dofs of the part x columns.
Matrix forces(const model::Substructure& part, const LoadVectorOptions& options) {
  std::vector<Vector> columns;
  if (options.loads)
    for (const auto& load : part.model.loads) columns.push_back(load.vector);
  if (options.points)
    for (const auto& set : part.model.points) {
      const auto width = set.rows.rows() /
                         std::max<Eigen::Index>(1, static_cast<Eigen::Index>(set.entities.size()));
      for (Eigen::Index r = 0; r < set.rows.rows(); ++r)
        if (chosen(options, set.entities[static_cast<std::size_t>(r / width)]))
          columns.push_back(Vector(set.rows.row(r).transpose()));
    }
  Matrix F(part.model.size(), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t j = 0; j < columns.size(); ++j) F.col(static_cast<Eigen::Index>(j)) = columns[j];
  return F;
}

/// Answer of a piece that floats in the motions N, free of them: [K  M N; N' M  0] (x, mu) = (f - M
/// N N' f, 0).
Matrix inertiaRelief(const Sparse& K, const Sparse& M, const Matrix& N, const Matrix& F) {
  const auto n = K.rows(), r = N.cols();
  const Matrix border = M * N;
  const double scale = K.nonZeros() > 0 ? K.coeffs().cwiseAbs().maxCoeff() /
                                              std::max(border.cwiseAbs().maxCoeff(), 1e-300)
                                        : 1.0;
  Matrix A = Matrix::Zero(n + r, n + r);
  A.topLeftCorner(n, n) = K;
  A.topRightCorner(n, r) = scale * border;
  A.bottomLeftCorner(r, n) = scale * border.transpose();
  Matrix b = Matrix::Zero(n + r, F.cols());
  b.topRows(n) = F - border * (N.transpose() * F);
  return Eigen::FullPivLU<Matrix>(A).solve(b).topRows(n);
}

/// K_II^-1 F_I, link by link.
Matrix answers(const model::Substructure& part, const Partition& p, const Matrix& F) {
  const Sparse K = constantStiffness(part.model);
  Matrix X = Matrix::Zero(static_cast<Eigen::Index>(p.interior.size()), F.cols());
  for (std::size_t l = 0; l < p.links.size(); ++l) {
    const auto inner = positionsOf(p, p.links[l]);
    Matrix f(static_cast<Eigen::Index>(inner.size()), F.cols());
    for (std::size_t i = 0; i < inner.size(); ++i)
      f.row(static_cast<Eigen::Index>(i)) = F.row(inner[i]);
    if (f.isZero(0.0)) continue;
    const Sparse KII = block(K, inner, inner);
    Matrix x;
    const Sparse MII = block(part.model.mass, inner, inner);
    const Matrix floating = p.ends[l].empty()
                                ? floatingModes(symmetricPart(KII), MII, namer(part, inner))
                                : Matrix(KII.rows(), 0);
    try {
      x = floating.cols() > 0 ? inertiaRelief(KII, MII, floating, f)
                              : linalg::DirectSolver(KII, namer(part, inner)).solve(f);
    } catch (const ModelError& error) {
      throw ModelError("Part \"" + part.name +
                       "\", load vectors: its interior is a mechanism while its interface and "
                       "retained dofs are held. " +
                       error.what());
    }
    for (std::size_t i = 0; i < inner.size(); ++i)
      X.row(p.links[l][i]) = x.row(static_cast<Eigen::Index>(i));
  }
  return X;
}

void requireFixedInterface(const model::Substructure& part, const Basis& basis) {
  const auto refuse = [&] {
    throw DeckError(
        "\"Load Vectors\" are answers of the interior with its kept dofs held, but the basis of "
        "part \"" +
        part.name +
        "\" has modes that move them, or that must not be added to. Take a basis with fixed "
        "interface, such as \"Craig-Bampton\", or leave "
        "\"Load Vectors\" out.");
  };
  if (basis.forces() > 0 || basis.inertial.size() > 0) refuse();
  const auto kept = static_cast<Eigen::Index>(basis.partition.kept.size());
  for (Eigen::Index j = 0; j < kept; ++j)
    for (Sparse::InnerIterator it(basis.vectors, basis.partition.kept[static_cast<std::size_t>(j)]);
         it; ++it)
      if (it.value() != (it.col() == j ? 1.0 : 0.0)) refuse();
}

bool sameForces(const model::Substructure& a, const model::Substructure& b,
                const LoadVectorOptions& options) {
  const Matrix f = forces(a, options), g = forces(b, options);
  return f.rows() == g.rows() && f.cols() == g.cols() &&
         (f.size() == 0 || (f - g).cwiseAbs().maxCoeff() <= 1e-13 * f.cwiseAbs().maxCoeff());
}

}  // namespace

void addLoadVectors(const model::Substructure& part, const LoadVectorOptions& options,
                    Basis& basis) {
  if (!options.any()) return;
  requireFixedInterface(part, basis);
  if (basis.partition.interior.empty()) return;
  const Matrix F = forces(part, options);
  const Matrix X = answers(part, basis.partition, F);
  const bool orthonormal = basis.orthonormal;
  const int added = appendVectors(part, X, "load", options.independence, orthonormal, basis);
  if (added > 0)
    basis.remarks.push_back(std::to_string(added) + " load vectors of " + std::to_string(F.cols()) +
                            " loads and unit forces stand beside its modes");
}

void requirePointNodes(const std::vector<model::Substructure>& parts,
                       const LoadVectorOptions& options) {
  for (const auto node : options.nodes) {
    const bool known =
        std::any_of(parts.begin(), parts.end(), [&](const model::Substructure& part) {
          return std::any_of(part.model.points.begin(), part.model.points.end(),
                             [&](const model::PointSet& set) {
                               return std::find(set.entities.begin(), set.entities.end(), node) !=
                                      set.entities.end();
                             });
        });
    if (!known)
      throw DeckError("\"Load Vector Nodes\" names node " + std::to_string(node) +
                      ", at which no substructure has a point law. Name nodes with contact, "
                      "springs or other point laws, or leave the list out for all of them.");
  }
}

std::vector<int> sameLoads(const std::vector<model::Substructure>& parts,
                           const std::vector<int>& classes, const LoadVectorOptions& options) {
  requirePointNodes(parts, options);
  std::vector<int> same(classes);
  for (std::size_t p = 0; p < parts.size(); ++p) {
    same[p] = static_cast<int>(p);
    for (std::size_t q = 0; q < p; ++q)
      if (classes[q] == classes[p] && same[q] == static_cast<int>(q) &&
          sameForces(parts[p], parts[q], options)) {
        same[p] = static_cast<int>(q);
        break;
      }
  }
  return same;
}

void declareLoadVectors(deck::ListSpec& list) {
  list.choice("Load Vectors", std::string("None"), {"None", "Loads", "Points", "Loads and points"},
              "Static answers of the interior of each substructure that are added to the modes of "
              "a basis with fixed interface: to its loads, to unit forces on "
              "the points of contact and other point laws, or to both (Dickens, Nakagawa and "
              "Wittbrodt 1997).");
  list.integerArray("Load Vector Nodes", deck::Optional{}, deck::Range::atLeast(1),
                    "Only points of these nodes get load vectors.")
      .expert();
}

LoadVectorOptions readLoadVectors(const Teuchos::ParameterList& list) {
  LoadVectorOptions options;
  const std::string choice =
      list.isParameter("Load Vectors") ? list.get<std::string>("Load Vectors") : "None";
  options.loads = choice == "Loads" || choice == "Loads and points";
  options.points = choice == "Points" || choice == "Loads and points";
  if (!list.isParameter("Load Vector Nodes")) return options;
  if (!options.points)
    throw DeckError("Reduction gives \"Load Vector Nodes\", but \"Load Vectors\" is \"" + choice +
                    "\", which looks at no points. Set it to \"Points\" or \"Loads and "
                    "points\", or leave the nodes out.");
  for (const int node : list.get<Teuchos::Array<int>>("Load Vector Nodes"))
    options.nodes.push_back(node);
  return options;
}

}  // namespace tooljoint::reduction
