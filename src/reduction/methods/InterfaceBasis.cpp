// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/methods/InterfaceBasis.hpp"

#include <Eigen/Dense>
#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <cmath>
#include <numeric>

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
Matrix staticAnswer(Sparse K, const Sparse& M, const Matrix& b, const linalg::DofNamer& name) {
  double scale = 0;
  for (int i = 0; i < K.rows(); ++i)
    if (M.coeff(i, i) > 0) scale = std::max(scale, K.coeff(i, i) / M.coeff(i, i));
  if (linalg::eigenvaluesBelow(symmetricPart(K), M, rigid * rigid * scale) > 0)
    K += rigid * scale * M;
  const linalg::DirectSolver solver(K, name);
  return solver.solve(b);
}

struct Members {
  std::vector<std::vector<int>> dofs;    ///< per interface
  std::vector<std::vector<int>> within;  ///< per interface, InterfaceProblem::within
};

/// An interface with those within it, which deform statically with it: u = E u_own.
class Group {
 public:
  Group(const InterfaceProblem& problem, int interface, const Members& members)
      : interface_(interface), own_(members.dofs[at(interface)]), dofs_(own_) {
    std::vector<int> within;
    for (int i : members.within[at(interface)])
      within.insert(within.end(), members.dofs[at(i)].begin(), members.dofs[at(i)].end());
    dofs_.insert(dofs_.end(), within.begin(), within.end());
    const Sparse K = block(problem.stiffness, dofs_, dofs_), M = block(problem.mass, dofs_, dofs_);
    isAlone_ = within.empty();
    if (isAlone_) {
      stiffness_ = K;
      mass_ = M;
      return;
    }
    shapes_.setIdentity(sizeOf(dofs_), sizeOf(own_));
    shapes_.bottomRows(sizeOf(within)) =
        -staticAnswer(block(problem.stiffness, within, within), block(problem.mass, within, within),
                      Matrix(block(problem.stiffness, within, own_)),
                      [&](int i) { return linalg::nameOf(problem.name, within[at(i)]); });
    stiffness_ = Matrix(shapes_.transpose() * (K * shapes_)).sparseView();
    mass_ = symmetricPart(Matrix(shapes_.transpose() * (M * shapes_)).sparseView());
  }

  int interface() const { return interface_; }
  const std::vector<int>& own() const { return own_; }
  /// own(), then the dofs of the interfaces within it.
  const std::vector<int>& dofs() const { return dofs_; }
  /// E'K E and E'M E.
  const Sparse& stiffness() const { return stiffness_; }
  const Sparse& mass() const { return mass_; }
  /// E x
  Matrix expanded(const Matrix& x) const { return isAlone_ ? x : Matrix(shapes_ * x); }
  /// E'f
  Matrix restricted(const Matrix& f) const {
    return isAlone_ ? f : Matrix(shapes_.transpose() * f);
  }

 private:
  int interface_;
  std::vector<int> own_, dofs_;
  Sparse stiffness_, mass_;
  Matrix shapes_;  ///< E = [1; -K_ww^-1 K_wo]
  bool isAlone_ = true;
};

/// Modes of groups of joined dofs with the other groups fixed: all dofs together, or each interface
/// by itself, with those within it.
class Characteristic final : public InterfaceBasis {
 public:
  Characteristic(const InterfaceOptions& options, bool keepPointLaws, bool together)
      : options_(options), keepPointLaws_(keepPointLaws), together_(together) {}
  bool keepsPointLaws() const override { return keepPointLaws_; }

  InterfaceVectors build(const InterfaceProblem& problem) const override {
    InterfaceVectors out;
    Matrix answers = loadAnswers(problem);
    Triplets attached;
    out.vectors.resize(problem.stiffness.rows(), 0);
    for (const auto& group : groupsOf(problem)) {
      const auto name = [&](int i) { return linalg::nameOf(problem.name, group.own()[at(i)]); };
      const Matrix own = answers(group.own(), Eigen::all);
      addModes(group, own, name, out);
      out.interface.resize(at(out.vectors.cols()), group.interface());
      answers(group.dofs(), Eigen::all) -= group.expanded(own);  // the rest is for those within it
      attach(group, problem, name, attached);
    }
    out.attached = sparse(problem.coupling.rows(), problem.coupling.cols(), attached);
    return out;
  }

 private:
  /// Each interface comes before those within it.
  std::vector<Group> groupsOf(const InterfaceProblem& problem) const {
    Members members{{}, together_ ? std::vector<std::vector<int>>(1) : problem.within};
    members.dofs.resize(members.within.size());
    for (int i = 0; i < problem.stiffness.rows(); ++i)
      members.dofs[at(together_ ? 0 : problem.interface[at(i)])].push_back(i);
    std::vector<int> order(members.dofs.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
      return members.within[at(a)].size() > members.within[at(b)].size();
    });
    std::vector<Group> groups;
    for (int g : order) groups.emplace_back(problem, g, members);
    return groups;
  }

  /// Adds modes of a group and the columns `more`, with their Rayleigh quotients.
  void addModes(const Group& group, const Matrix& more, const linalg::DofNamer& name,
                InterfaceVectors& out) const {
    const Sparse &K = group.stiffness(), &M = group.mass();
    const auto pairs = modesOf(symmetricPart(K), M, options_, name);
    OrthonormalSet set(M, dependent, "Interface reduction: ");
    for (int j = 0; j < pairs.count(); ++j) set.add(pairs.vectors.col(j));
    for (Eigen::Index j = 0; j < more.cols(); ++j) set.add(more.col(j));
    const Eigen::Index first = out.vectors.cols(), count = set.size();
    out.vectors.conservativeResize(Eigen::NoChange, first + count);
    out.vectors.rightCols(count).setZero();
    out.vectors(group.dofs(), Eigen::lastN(count)) = group.expanded(set.basis());
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
    return acting.empty() ? loads
                          : staticAnswer(problem.stiffness, problem.mass, loads, problem.name);
  }

  /// u = ... - E (E'K E)^-1 E'K_C u_C
  static void attach(const Group& group, const InterfaceProblem& problem,
                     const linalg::DofNamer& name, Triplets& entries) {
    std::vector<int> others;
    for (int i : group.dofs())
      forEachInRow(problem.coupling, i, [&](int column, double) { others.push_back(column); });
    makeUnique(others);
    if (others.empty()) return;
    const linalg::DirectSolver solver(group.stiffness(), name);
    const Matrix forces = group.restricted(Matrix(block(problem.coupling, group.dofs(), others)));
    const Matrix answer = group.expanded(solver.solve(forces));
    for (int i = 0; i < answer.rows(); ++i)
      for (int j = 0; j < sizeOf(others); ++j)
        if (answer(i, j) != 0.0)
          entries.emplace_back(group.dofs()[at(i)], others[at(j)], -answer(i, j));
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
