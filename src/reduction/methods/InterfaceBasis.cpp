// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/methods/InterfaceBasis.hpp"

#include <Eigen/Dense>
#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <cmath>

#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "common/Index.hpp"
#include "linalg/trilinos/EigenSolver.hpp"
#include "reduction/part/Partition.hpp"
#include "reduction/selection/ModeChoice.hpp"

namespace tooljoint::reduction {

namespace {

using constants::twoPi;
/// A load vector that is this much in the span of the others says nothing new.
constexpr double dependent = 1e-8;
/// A frequency below this fraction of the largest diagonal one is a rigid body's.
constexpr double rigid = 1e-7;

linalg::EigenPairs modesOf(const Sparse& K, const Sparse& M, const InterfaceOptions& chosen,
                           const linalg::DofNamer& name) {
  linalg::EigenOptions options;
  options.keepPairs = true;
  options.name = name;
  if (chosen.modes < 0) return linalg::lowestModesBelow(K, M, twoPi * chosen.cutOffHz, options);
  return linalg::lowestModes(K, M, std::min(chosen.modes, static_cast<int>(K.rows())), options);
}

/// K^-1 b. A model that can move as a whole answers a load by running away; it is then held softly
/// by its own mass.
Matrix staticAnswer(const InterfaceProblem& problem, const Matrix& b) {
  double scale = 0;
  for (int i = 0; i < problem.stiffness.rows(); ++i)
    if (problem.mass.coeff(i, i) > 0)
      scale = std::max(scale, problem.stiffness.coeff(i, i) / problem.mass.coeff(i, i));
  Sparse K = problem.stiffness;
  if (linalg::eigenvaluesBelow(symmetricPart(K), problem.mass, rigid * rigid * scale) > 0)
    K += rigid * scale * problem.mass;
  const linalg::DirectSolver solver(K, problem.name);
  return solver.solve(b);
}

/// `candidates` made M-orthonormal to `basis` and to each other; what depends on the others is left
/// out.
Matrix independent(const Matrix& candidates, const Matrix& basis, const Sparse& M) {
  Matrix all = basis;
  for (Eigen::Index j = 0; j < candidates.cols(); ++j) {
    Vector x = candidates.col(j);
    const double before = std::sqrt(std::max(0.0, x.dot(M * x)));
    if (before == 0.0) continue;
    for (int pass = 0; pass < 2; ++pass) x -= all * (all.transpose() * (M * x));
    const double norm = std::sqrt(std::max(0.0, x.dot(M * x)));
    if (norm <= dependent * before) continue;
    all.conservativeResize(Eigen::NoChange, all.cols() + 1);
    all.col(all.cols() - 1) = x / norm;
  }
  return all.rightCols(all.cols() - basis.cols());
}

class Characteristic : public InterfaceBasis {
 public:
  Characteristic(const InterfaceOptions& options, bool keepPointLaws)
      : options_(options), keepPointLaws_(keepPointLaws) {}
  bool keepsPointLaws() const override { return keepPointLaws_; }

 protected:
  /// Modes of K, M and what `more` adds to them; with their Rayleigh quotients.
  void fill(const Sparse& K, const Sparse& M, const Matrix& more, const linalg::DofNamer& name,
            Matrix& vectors, Vector& values) const {
    const auto pairs = modesOf(symmetricPart(K), M, options_, name);
    const Matrix extra = independent(more, pairs.vectors, M);
    vectors.resize(K.rows(), pairs.vectors.cols() + extra.cols());
    vectors << pairs.vectors, extra;
    values.resize(vectors.cols());
    for (Eigen::Index j = 0; j < vectors.cols(); ++j)
      values[j] =
          j < pairs.values.size() ? pairs.values[j] : vectors.col(j).dot(K * vectors.col(j));
  }
  Matrix loadAnswers(const InterfaceProblem& problem) const {
    std::vector<Eigen::Index> acting;
    for (Eigen::Index j = 0; j < problem.loads.cols() && options_.loadVectors; ++j)
      if (!problem.loads.col(j).isZero(0.0)) acting.push_back(j);
    Matrix loads(problem.stiffness.rows(), static_cast<Eigen::Index>(acting.size()));
    for (std::size_t j = 0; j < acting.size(); ++j)
      loads.col(static_cast<Eigen::Index>(j)) = problem.loads.col(acting[j]);
    return acting.empty() ? loads : staticAnswer(problem, loads);
  }

  InterfaceOptions options_;
  bool keepPointLaws_;
};

class SystemModes final : public Characteristic {
 public:
  using Characteristic::Characteristic;
  InterfaceVectors build(const InterfaceProblem& problem) const override {
    InterfaceVectors out;
    fill(problem.stiffness, problem.mass, loadAnswers(problem), problem.name, out.vectors,
         out.eigenvalues);
    out.interface.assign(static_cast<std::size_t>(out.vectors.cols()), 0);
    out.attached = Sparse(problem.coupling.rows(), problem.coupling.cols());
    if (problem.coupling.nonZeros() == 0) return out;
    // u = ... - K_GG^-1 K_GC u_C
    const linalg::DirectSolver solver(problem.stiffness, problem.name);
    Triplets entries;
    const Eigen::SparseMatrix<double> columns = problem.coupling;
    for (int c = 0; c < columns.outerSize(); ++c) {
      if (columns.col(c).nonZeros() == 0) continue;
      const Vector answer = solver.solve(Vector(columns.col(c)));
      for (int i = 0; i < answer.size(); ++i)
        if (answer[i] != 0.0) entries.emplace_back(i, c, -answer[i]);
    }
    out.attached.setFromTriplets(entries.begin(), entries.end());
    return out;
  }
};

class LocalModes final : public Characteristic {
 public:
  using Characteristic::Characteristic;
  InterfaceVectors build(const InterfaceProblem& problem) const override {
    InterfaceVectors out;
    const Matrix answers = loadAnswers(problem);
    const auto n = problem.stiffness.rows();
    std::vector<Matrix> blocks;
    std::vector<Vector> values;
    std::vector<std::vector<int>> members(at(problem.interfaces));
    for (int i = 0; i < n; ++i) members[at(problem.interface[at(i)])].push_back(i);
    Triplets attached;
    Eigen::Index modes = 0;
    for (const auto& dofs : members) {
      const Sparse K = block(problem.stiffness, dofs, dofs), M = block(problem.mass, dofs, dofs);
      const auto name = [&](int i) { return linalg::nameOf(problem.name, dofs[at(i)]); };
      Matrix more(static_cast<Eigen::Index>(dofs.size()), answers.cols());
      for (std::size_t i = 0; i < dofs.size(); ++i)
        more.row(static_cast<Eigen::Index>(i)) = answers.row(dofs[i]);
      blocks.emplace_back();
      values.emplace_back();
      fill(K, M, more, name, blocks.back(), values.back());
      modes += blocks.back().cols();
      attach(K, problem, dofs, name, attached);
    }
    out.vectors = Matrix::Zero(n, modes);
    out.eigenvalues.resize(modes);
    Eigen::Index first = 0;
    for (std::size_t k = 0; k < members.size(); ++k) {
      for (std::size_t i = 0; i < members[k].size(); ++i)
        out.vectors.block(members[k][i], first, 1, blocks[k].cols()) =
            blocks[k].row(static_cast<Eigen::Index>(i));
      out.eigenvalues.segment(first, blocks[k].cols()) = values[k];
      out.interface.insert(out.interface.end(), static_cast<std::size_t>(blocks[k].cols()),
                           static_cast<int>(k));
      first += blocks[k].cols();
    }
    out.attached = Sparse(problem.coupling.rows(), problem.coupling.cols());
    out.attached.setFromTriplets(attached.begin(), attached.end());
    return out;
  }

 private:
  /// u_i = ... - K_ii^-1 K_iC u_C
  static void attach(const Sparse& K, const InterfaceProblem& problem, const std::vector<int>& dofs,
                     const linalg::DofNamer& name, Triplets& entries) {
    std::vector<int> others;
    for (int i : dofs)
      for (Sparse::InnerIterator it(problem.coupling, i); it; ++it)
        others.push_back(static_cast<int>(it.col()));
    std::sort(others.begin(), others.end());
    others.erase(std::unique(others.begin(), others.end()), others.end());
    if (others.empty()) return;
    const linalg::DirectSolver solver(K, name);
    const Matrix answer = solver.solve(Matrix(block(problem.coupling, dofs, others)));
    for (std::size_t i = 0; i < dofs.size(); ++i)
      for (std::size_t j = 0; j < others.size(); ++j)
        if (const double value = answer(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
            value != 0.0)
          entries.emplace_back(dofs[i], others[j], -value);
  }
};

deck::ListSpec own(const std::string& name, const std::string& count) {
  using deck::Range;
  deck::ListSpec list(name, "");
  list.integer("Modes", deck::Optional{}, Range::atLeast(0),
               count + " Either this or \"Cut-off Frequency\".");
  list.real("Cut-off Frequency", "Hz", deck::Optional{}, Range::nonNegative(),
            "Keep the characteristic constraint modes at or below this frequency.");
  list.boolean("Load Vectors", true,
               "Add the static answer of the interfaces to every load, so that it is exact "
               "whatever the number of modes.");
  list.boolean("Keep Contact Dofs", true,
               "Leave joined dofs on which point laws act (contact, springs, stops) as they are.")
      .expert();
  return list;
}

InterfaceOptions read(const Teuchos::ParameterList& list, const std::string& name) {
  const bool modes = list.isParameter("Modes"), cutOff = list.isParameter("Cut-off Frequency");
  if (modes == cutOff)
    throw DeckError("Reduction/" + name +
                    (modes ? " gives both \"Modes\" and \"Cut-off Frequency\"."
                           : " does not say how many modes of the interfaces are kept.") +
                    " Give exactly one of them.");
  InterfaceOptions options;
  if (modes) options.modes = list.get<int>("Modes");
  if (cutOff) options.cutOffHz = list.get<double>("Cut-off Frequency");
  if (list.isParameter("Load Vectors")) options.loadVectors = list.get<bool>("Load Vectors");
  return options;
}

bool keepContact(const Teuchos::ParameterList& list) {
  return !list.isParameter("Keep Contact Dofs") || list.get<bool>("Keep Contact Dofs");
}

const bool noneRegistered = InterfaceRegistry::instance().add(
    "None", {"All joined dofs are kept.", deck::ListSpec("None", ""),
             [](const Teuchos::ParameterList&) { return std::unique_ptr<InterfaceBasis>(); }});
const bool systemRegistered = InterfaceRegistry::instance().add(
    "System",
    {"Characteristic constraint modes of all interfaces together (Castanier, Tan and Pierre 2001).",
     own("System", "Number of characteristic constraint modes of all interfaces together."),
     [](const Teuchos::ParameterList& list) {
       return systemInterfaceModes(read(list, "System"), keepContact(list));
     }});
const bool localRegistered = InterfaceRegistry::instance().add(
    "Local", {"Characteristic constraint modes of each interface, the others held, which keeps a "
              "chain narrow (Hong, Epureanu and Castanier 2013).",
              own("Local", "Number of characteristic constraint modes of each interface."),
              [](const Teuchos::ParameterList& list) {
                return localInterfaceModes(read(list, "Local"), keepContact(list));
              }});

}  // namespace

std::unique_ptr<InterfaceBasis> systemInterfaceModes(const InterfaceOptions& options,
                                                     bool keepPointLaws) {
  return std::make_unique<SystemModes>(options, keepPointLaws);
}
std::unique_ptr<InterfaceBasis> localInterfaceModes(const InterfaceOptions& options,
                                                    bool keepPointLaws) {
  return std::make_unique<LocalModes>(options, keepPointLaws);
}

}  // namespace tooljoint::reduction
