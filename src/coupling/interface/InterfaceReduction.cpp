// SPDX-License-Identifier: BSD-3-Clause
#include "coupling/interface/InterfaceReduction.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "common/Error.hpp"
#include "common/Index.hpp"
#include "coupling/assembly/Congruence.hpp"
#include "coupling/assembly/DependentCoordinates.hpp"
#include "model/DofNames.hpp"
#include "reduction/part/Partition.hpp"

namespace tooljoint::coupling {

namespace {

using model::DofLabel;

class Reducer {
 public:
  Reducer(Coupling& coupling, const reduction::InterfaceBasis& basis,
          const std::vector<int>& joinable)
      : coupling_(coupling), model_(coupling.model), basis_(basis), joinable_(joinable) {}

  void run() {
    if (!coupling_.multipliers.empty())
      throw ModelError(
          "An interface reduction needs joined dofs, but with dual assembly every part keeps its "
          "own dofs. Set Coupling/Assembly to \"Primal\", or \"Interface Reduction\" to \"None\".");
    choose();
    coupling_.joinedDofs = static_cast<int>(reduced_.size());
    if (reduced_.empty()) {
      coupling_.interfaceModes = 0;
      coupling_.remarks.push_back("No joined dof can be reduced: point laws act on all of them.");
      return;
    }
    const auto problem = makeProblem();
    const auto vectors = basis_.build(problem);
    coupling_.interfaceModes = static_cast<int>(vectors.vectors.cols());
    apply(problem, vectors);
  }

 private:
  void choose() {
    std::vector<char> loaded(model_.dofs.size(), 0);
    if (basis_.keepsPointLaws())
      for (const auto& set : model_.points)
        for (int r = 0; r < set.rows.outerSize(); ++r)
          if (!throughModes(set.rows, r))
            forEachInRow(set.rows, r, [&](int column, double value) {
              if (value != 0.0) loaded[at(column)] = 1;
            });
    std::vector<char> joined(model_.dofs.size(), 0);
    for (int i : coupling_.interface) joined[at(i)] = loaded[at(i)] != 0 ? 0 : 1;
    for (int i = 0; i < model_.size(); ++i) (joined[at(i)] ? reduced_ : others_).push_back(i);
  }

  /// True if the coordinate belongs to an inner dof of a reduced part, which the joined dofs move
  /// only through modes.
  bool throughModes(const Sparse& rows, int r) const {
    bool found = false;
    forEachInRow(rows, r, [&](int column, double value) {
      found = found || (value != 0.0 && model_.dofs[at(column)].kind == DofLabel::Kind::Modal);
    });
    return found;
  }

  /// Interfaces: the sets of parts that a dof joins, in the order of their first dof.
  void findInterfaces(reduction::InterfaceProblem& problem) const {
    std::vector<std::vector<int>> partsOf(model_.dofs.size());
    for (std::size_t p = 0; p < coupling_.maps.size(); ++p)
      forEachEntry(coupling_.maps[p], [&](int row, int column, double) {
        if (!joinable_.empty() && row >= joinable_[p]) return;
        auto& parts = partsOf[at(column)];
        if (parts.empty() || parts.back() != static_cast<int>(p))
          parts.push_back(static_cast<int>(p));
      });
    std::map<std::vector<int>, int> number;
    for (int i : reduced_)
      problem.interface.push_back(
          number.emplace(partsOf[at(i)], static_cast<int>(number.size())).first->second);
    problem.interfaces = static_cast<int>(number.size());
    problem.within.resize(number.size());
    for (const auto& [parts, whole] : number)
      for (const auto& [some, own] : number)
        if (own != whole && std::includes(parts.begin(), parts.end(), some.begin(), some.end()))
          problem.within[at(whole)].push_back(own);
  }

  reduction::InterfaceProblem makeProblem() const {
    reduction::InterfaceProblem problem;
    const Sparse K = reduction::constantStiffness(model_);
    problem.stiffness = reduction::block(K, reduced_, reduced_);
    problem.mass = reduction::symmetricPart(reduction::block(model_.mass, reduced_, reduced_));
    problem.coupling = reduction::block(K, reduced_, others_);
    findInterfaces(problem);
    problem.loads.resize(sizeOf(reduced_), sizeOf(model_.loads));
    for (int j = 0; j < sizeOf(model_.loads); ++j)
      problem.loads.col(j) = model_.loads[at(j)].vector(reduced_);
    problem.name = model::namer(model_, reduced_);
    return problem;
  }

  /// Expresses the old coordinates by (others, modes).
  void apply(const reduction::InterfaceProblem& problem,
             const reduction::InterfaceVectors& vectors) {
    coupling_.wholeInterfaces = std::make_shared<const Coupling>(coupling_);
    const auto modes = static_cast<int>(vectors.vectors.cols());
    const int kept = sizeOf(others_);
    std::vector<char> keep(at(model_.size()), 1);
    for (int i : reduced_) keep[at(i)] = 0;
    Triplets entries;
    for (int i = 0; i < sizeOf(reduced_); ++i)
      for (int k = 0; k < modes; ++k)
        if (vectors.vectors(i, k) != 0.0)
          entries.emplace_back(reduced_[at(i)], model_.size() + k, vectors.vectors(i, k));
    forEachEntry(vectors.attached, [&](int i, int j, double value) {
      entries.emplace_back(reduced_[at(i)], others_[at(j)], value);
    });
    Substitution s;
    keepOnly(model_, keep, entries, modes, s);
    std::vector<int> next(at(std::max(1, problem.interfaces)), 0);
    for (int k = 0; k < modes; ++k)
      s.dofs.push_back(
          DofLabel::interfaceMode(vectors.interface[at(k)], next[at(vectors.interface[at(k)])]++));
    s.initialDisplacement.tail(modes) =
        fit(problem, vectors, model_.initialDisplacement, s.initialDisplacement.head(kept));
    s.initialVelocity.tail(modes) =
        fit(problem, vectors, model_.initialVelocity, s.initialVelocity.head(kept));
    substitute(model_, s);
    const auto position = narrowNumbering(model_);
    renumber(model_, position);
    coupling_.interfaceMap = moveColumns(s.map, position, s.map.cols());
    changeCoordinates(coupling_, coupling_.interfaceMap);
    coupling_.interface.clear();
    for (std::size_t i = 0; i < model_.dofs.size(); ++i)
      if (model_.dofs[i].kind == DofLabel::Kind::Interface)
        coupling_.interface.push_back(static_cast<int>(i));
  }

  /// xi of Psi xi = u - Psi_C u_C by least squares in the mass norm: (Psi' M Psi) xi = Psi' M (u -
  /// Psi_C u_C).
  Vector fit(const reduction::InterfaceProblem& problem, const reduction::InterfaceVectors& vectors,
             const Vector& state, const Vector& others) const {
    const Vector u = Vector(state(reduced_)) - vectors.attached * others;
    if (u.isZero(0.0) || vectors.vectors.cols() == 0) return Vector::Zero(vectors.vectors.cols());
    const Matrix weighted = problem.mass * vectors.vectors;
    return (vectors.vectors.transpose() * weighted).ldlt().solve(weighted.transpose() * u);
  }

  Coupling& coupling_;
  model::SecondOrderModel& model_;
  const reduction::InterfaceBasis& basis_;
  const std::vector<int>& joinable_;
  std::vector<int> reduced_, others_;
};

}  // namespace

void reduceInterfaces(Coupling& coupling, const reduction::InterfaceBasis& basis,
                      const std::vector<int>& joinable) {
  Reducer(coupling, basis, joinable).run();
}

}  // namespace tooljoint::coupling
