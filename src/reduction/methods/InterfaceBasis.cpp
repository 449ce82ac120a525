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
#include "reduction/vectors/ModalVectors.hpp"

namespace tooljoint::reduction {

namespace {

using constants::twoPi;
/// A load vector with a smaller independent fraction is linearly dependent.
constexpr double dependent = 1e-8;
/// A frequency below this fraction of the largest diagonal one belongs to a rigid-body mode.
constexpr double rigid = 1e-7;

linalg::EigenPairs modesOf(const Sparse& K, const Sparse& M, const InterfaceOptions& chosen,
                           const linalg::DofNamer& name) {
  linalg::EigenOptions options;
  options.keepPairs = true;
  options.name = name;
  if (chosen.modes < 0) return linalg::lowestModesBelow(K, M, twoPi * chosen.cutOffHz, options);
  return linalg::lowestModes(K, M, std::min(chosen.modes, static_cast<int>(K.rows())), options);
}

/// K^-1 b. A model with rigid-body modes has no static response; it is then supported weakly in
/// proportion to its mass.
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

/// Modes of groups of joined dofs with the other groups fixed: all dofs together, or each interface
/// by itself.
class Characteristic final : public InterfaceBasis {
 public:
  Characteristic(const InterfaceOptions& options, bool keepPointLaws, bool together)
      : options_(options), keepPointLaws_(keepPointLaws), together_(together) {}
  bool keepsPointLaws() const override { return keepPointLaws_; }

  InterfaceVectors build(const InterfaceProblem& problem) const override {
    InterfaceVectors out;
    const Matrix answers = loadAnswers(problem);
    const Eigen::Index n = problem.stiffness.rows();
    std::vector<std::vector<int>> groups(at(together_ ? 1 : problem.interfaces));
    for (int i = 0; i < n; ++i) groups[at(together_ ? 0 : problem.interface[at(i)])].push_back(i);
    Triplets attached;
    out.vectors.resize(n, 0);
    for (int g = 0; g < sizeOf(groups); ++g) {
      const auto& dofs = groups[at(g)];
      const auto name = [&](int i) { return linalg::nameOf(problem.name, dofs[at(i)]); };
      const Sparse K = block(problem.stiffness, dofs, dofs), M = block(problem.mass, dofs, dofs);
      addModes(K, M, answers(dofs, Eigen::all), name, dofs, out);
      out.interface.resize(at(out.vectors.cols()), g);
      attach(K, problem, dofs, name, attached);
    }
    out.attached = sparse(problem.coupling.rows(), problem.coupling.cols(), attached);
    return out;
  }

 private:
  /// Adds modes of K, M on some dofs and the columns `more`, with their Rayleigh quotients.
  void addModes(const Sparse& K, const Sparse& M, const Matrix& more, const linalg::DofNamer& name,
                const std::vector<int>& dofs, InterfaceVectors& out) const {
    const auto pairs = modesOf(symmetricPart(K), M, options_, name);
    OrthonormalSet set(M, dependent, "Interface reduction: ");
    for (int j = 0; j < pairs.count(); ++j) set.add(pairs.vectors.col(j));
    for (Eigen::Index j = 0; j < more.cols(); ++j) set.add(more.col(j));
    const Eigen::Index first = out.vectors.cols(), count = set.size();
    out.vectors.conservativeResize(Eigen::NoChange, first + count);
    out.vectors.rightCols(count).setZero();
    out.vectors(dofs, Eigen::lastN(count)) = set.basis();
    out.eigenvalues.conservativeResize(first + count);
    for (int j = 0; j < count; ++j) {
      const auto shape = set.basis().col(j);
      out.eigenvalues[first + j] = j < pairs.values.size() ? pairs.values[j] : shape.dot(K * shape);
    }
  }

  Matrix loadAnswers(const InterfaceProblem& problem) const {
    std::vector<int> acting;
    for (int j = 0; j < problem.loads.cols() && options_.loadVectors; ++j)
      if (!problem.loads.col(j).isZero(0.0)) acting.push_back(j);
    const Matrix loads = problem.loads(Eigen::all, acting);
    return acting.empty() ? loads : staticAnswer(problem, loads);
  }

  /// u_i = ... - K_ii^-1 K_iC u_C
  static void attach(const Sparse& K, const InterfaceProblem& problem, const std::vector<int>& dofs,
                     const linalg::DofNamer& name, Triplets& entries) {
    std::vector<int> others;
    for (int i : dofs)
      forEachInRow(problem.coupling, i, [&](int column, double) { others.push_back(column); });
    makeUnique(others);
    if (others.empty()) return;
    const linalg::DirectSolver solver(K, name);
    const Matrix answer = solver.solve(Matrix(block(problem.coupling, dofs, others)));
    for (int i = 0; i < sizeOf(dofs); ++i)
      for (int j = 0; j < sizeOf(others); ++j)
        if (answer(i, j) != 0.0) entries.emplace_back(dofs[at(i)], others[at(j)], -answer(i, j));
  }

  InterfaceOptions options_;
  bool keepPointLaws_;
  bool together_;
};

deck::ListSpec own(const std::string& name, const std::string& count) {
  using deck::Range;
  deck::ListSpec list(name, "");
  list.integer("Modes", deck::Optional{}, Range::atLeast(0),
               count + " Either this or \"Cut-off Frequency\".");
  list.real("Cut-off Frequency", "Hz", deck::Optional{}, Range::nonNegative(),
            "Keep the characteristic constraint modes at or below this frequency.");
  list.boolean("Load Vectors", true,
               "Add the static response of the interfaces to every load, which is then exact for "
               "any number of modes.");
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
                           : " does not give the number of interface modes.") +
                    " Give exactly one of them.");
  InterfaceOptions options;
  if (modes) options.modes = list.get<int>("Modes");
  if (cutOff) options.cutOffHz = list.get<double>("Cut-off Frequency");
  options.loadVectors = list.get<bool>("Load Vectors");
  return options;
}

const bool noneRegistered = InterfaceRegistry::instance().add(
    "None", {"All joined dofs stay.", deck::ListSpec("None", ""),
             [](const Teuchos::ParameterList&) { return std::unique_ptr<InterfaceBasis>(); }});
const bool systemRegistered = InterfaceRegistry::instance().add(
    "System",
    {"Characteristic constraint modes of all interfaces together (Castanier, Tan and Pierre 2001).",
     own("System", "Number of characteristic constraint modes of all interfaces together."),
     [](const Teuchos::ParameterList& list) {
       return systemInterfaceModes(read(list, "System"), list.get<bool>("Keep Contact Dofs"));
     }});
const bool localRegistered = InterfaceRegistry::instance().add(
    "Local", {"Characteristic constraint modes of each interface with the others fixed, which "
              "preserves the bandwidth of a chain (Hong, Epureanu and Castanier 2013).",
              own("Local", "Number of characteristic constraint modes of each interface."),
              [](const Teuchos::ParameterList& list) {
                return localInterfaceModes(read(list, "Local"),
                                           list.get<bool>("Keep Contact Dofs"));
              }});

}  // namespace

std::unique_ptr<InterfaceBasis> systemInterfaceModes(const InterfaceOptions& options,
                                                     bool keepPointLaws) {
  return std::make_unique<Characteristic>(options, keepPointLaws, true);
}
std::unique_ptr<InterfaceBasis> localInterfaceModes(const InterfaceOptions& options,
                                                    bool keepPointLaws) {
  return std::make_unique<Characteristic>(options, keepPointLaws, false);
}

}  // namespace tooljoint::reduction
