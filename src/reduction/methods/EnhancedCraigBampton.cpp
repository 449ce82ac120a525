// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Craig-Bampton with the residual flexibility of the modes left out: J.-G. Kim, P.-S. Lee, An
/// enhanced Craig-Bampton method, Int. J. Numer. Meth. Engng 103 (2015) 79-93. With F = K_II^-1 -
/// Phi_D Lambda^-1 Phi_D' and the inertia of the constraint modes L = M_IC + M_II psi, the dropped
/// modes answer x_I = lambda F L u_C to first order in lambda; O'Callahan's step replaces lambda
/// u_C by the rows of M^-1 K of the coupled Craig-Bampton model.
#include <Eigen/Dense>
#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "common/Error.hpp"
#include "linalg/trilinos/DirectSolver.hpp"
#include "reduction/vectors/ModalVectors.hpp"

namespace tooljoint::reduction {

namespace {

const std::string freeKind = "residual";

class EnhancedCraigBampton : public ReductionMethod {
 public:
  EnhancedCraigBampton(bool tied, double independence)
      : tied_(tied),
        kind_(tied ? followingKind : freeKind),
        independence_(independence),
        base_(MethodRegistry::instance().make("Craig-Bampton", {})) {}

  MethodTraits traits() const override { return {true, false, tied_, true}; }

  Basis build(const model::Substructure& part, const ModeRequest& request) const override {
    return base_->build(part, request);
  }

  /// Adds W, an orthonormal basis of F L, to every part that has dropped modes.
  bool augment(const model::SecondOrderModel&, const std::vector<std::vector<int>>&,
               const std::vector<model::Substructure>& parts,
               std::vector<Basis>& bases) const override {
    bool changed = false;
    for (std::size_t p = 0; p < parts.size(); ++p) {
      const bool done = std::find(bases[p].modeKind.begin(), bases[p].modeKind.end(), kind_) !=
                        bases[p].modeKind.end();
      if (done || bases[p].modes() >= static_cast<int>(bases[p].partition.interior.size()))
        continue;
      changed = appendVectors(parts[p], residualVectors(parts[p], bases[p]), kind_, independence_,
                              false, bases[p]) > 0 ||
                changed;
    }
    return changed;
  }

  /// The coordinates eta of W follow the others z: their modal equation (Lambda_W - lambda) eta =
  /// lambda W' L u_C to first order in lambda, with lambda u_C = L_C M^-1 K z,
  ///
  ///     eta = Lambda_W^-1 W' L L_C M^-1 K z,   which is W' (F L) L_C M^-1 K z.
  DependentCoordinates dependentCoordinates(const model::SecondOrderModel& coupled,
                                            const std::vector<Sparse>& maps,
                                            const std::vector<model::Substructure>& parts,
                                            const std::vector<Basis>& bases) const override {
    DependentCoordinates dependent;
    if (!tied_) return dependent;
    std::vector<Matrix> answers;  // per part: eta from lambda u_C
    for (std::size_t p = 0; p < parts.size(); ++p) {
      answers.push_back(quasiStatic(parts[p], bases[p]));
      for (int k = 0; k < bases[p].modes(); ++k)
        if (bases[p].modeKind[static_cast<std::size_t>(k)] == kind_)
          dependent.dofs.push_back(
              position(maps[p], static_cast<int>(bases[p].partition.kept.size()) + k, parts[p]));
    }
    if (dependent.dofs.empty()) return dependent;
    std::vector<char> follows(static_cast<std::size_t>(coupled.size()), 0);
    for (int i : dependent.dofs) follows[static_cast<std::size_t>(i)] = 1;
    std::vector<int> others;
    for (int i = 0; i < coupled.size(); ++i)
      if (!follows[static_cast<std::size_t>(i)]) others.push_back(i);
    // Rows of L_C M^-1 K, from M x = L_C' and K x.
    const Sparse M = symmetricPart(block(coupled.mass, others, others)),
                 K = symmetricPart(block(constantStiffness(coupled), others, others));
    const Eigen::LLT<Matrix> factor{Matrix(M)};
    if (factor.info() != Eigen::Success)
      throw ModelError(
          "\"Enhanced Craig-Bampton\" needs the inverse of the coupled mass, which is not positive "
          "definite. Give every kept dof mass, assemble "
          "primally, or set \"Residual Coordinates\" to \"Free\".");
    dependent.rows.resize(static_cast<Eigen::Index>(dependent.dofs.size()),
                          static_cast<Eigen::Index>(others.size()));
    Eigen::Index row = 0;
    for (std::size_t p = 0; p < parts.size(); ++p) {
      if (answers[p].rows() == 0) continue;
      std::vector<int> kept(bases[p].partition.kept.size());
      for (std::size_t j = 0; j < kept.size(); ++j) kept[j] = static_cast<int>(j);
      const Matrix drive = answers[p] * Matrix(block(maps[p], kept, others));
      dependent.rows.middleRows(row, drive.rows()) =
          (K * factor.solve(drive.transpose())).transpose();
      row += drive.rows();
    }
    return dependent;
  }

 private:
  /// L = (M Phi_C)_I
  static Matrix inertia(const model::Substructure& part, const Basis& basis) {
    const Partition& p = basis.partition;
    std::vector<int> all(static_cast<std::size_t>(p.size)), constraint(p.kept.size());
    for (int i = 0; i < p.size; ++i) all[static_cast<std::size_t>(i)] = i;
    for (std::size_t j = 0; j < constraint.size(); ++j) constraint[j] = static_cast<int>(j);
    return block(part.model.mass, p.interior, all) * Matrix(block(basis.vectors, all, constraint));
  }

  /// F L = K_II^-1 L - Phi_D Lambda^-1 Phi_D' L with the symmetric part of K, link by link; links
  /// that touch no kept dof have no L.
  static Matrix residualVectors(const model::Substructure& part, const Basis& basis) {
    const Partition& p = basis.partition;
    const Sparse K = symmetricPart(constantStiffness(part.model));
    const Matrix L = inertia(part, basis);
    Matrix X = Matrix::Zero(L.rows(), L.cols());
    for (std::size_t l = 0; l < p.links.size(); ++l) {
      if (p.ends[l].empty()) continue;
      const auto inner = positionsOf(p, p.links[l]);
      Matrix load(static_cast<Eigen::Index>(inner.size()), L.cols());
      for (std::size_t i = 0; i < inner.size(); ++i)
        load.row(static_cast<Eigen::Index>(i)) = L.row(p.links[l][i]);
      Matrix x;
      try {
        x = linalg::DirectSolver(block(K, inner, inner), namer(part, inner)).solve(load);
      } catch (const ModelError& error) {
        throw ModelError(
            "Part \"" + part.name +
            "\", residual flexibility: the symmetric part of its interior stiffness is singular. " +
            error.what());
      }
      for (std::size_t i = 0; i < inner.size(); ++i)
        X.row(p.links[l][i]) = x.row(static_cast<Eigen::Index>(i));
    }
    const Matrix V = modalColumns(basis);
    for (Eigen::Index k = 0; k < V.cols(); ++k)
      X -= V.col(k) * ((V.col(k).transpose() * L) / basis.eigenvalues[k]);
    // F L by columns that are large beside what it was taken from: the rest is rounding.
    std::vector<int> real;
    for (Eigen::Index j = 0; j < X.cols(); ++j) {
      double scale = 0;
      for (Eigen::Index k = 0; k < V.cols(); ++k)
        scale = std::max(scale, std::abs(V.col(k).dot(L.col(j)) / basis.eigenvalues[k]) *
                                    V.col(k).cwiseAbs().maxCoeff());
      if (X.col(j).cwiseAbs().maxCoeff() > 1e-11 * scale) real.push_back(static_cast<int>(j));
    }
    Matrix kept(X.rows(), static_cast<Eigen::Index>(real.size()));
    for (std::size_t j = 0; j < real.size(); ++j)
      kept.col(static_cast<Eigen::Index>(j)) = X.col(real[j]);
    return kept;
  }

  /// Lambda_W^-1 W' L of a part, residual coordinates x kept dofs.
  Matrix quasiStatic(const model::Substructure& part, const Basis& basis) const {
    std::vector<Eigen::Index> columns;
    for (int k = 0; k < basis.modes(); ++k)
      if (basis.modeKind[static_cast<std::size_t>(k)] == kind_) columns.push_back(k);
    Matrix answer(static_cast<Eigen::Index>(columns.size()),
                  static_cast<Eigen::Index>(basis.partition.kept.size()));
    if (columns.empty()) return answer;
    const Matrix V = modalColumns(basis), L = inertia(part, basis);
    for (std::size_t r = 0; r < columns.size(); ++r)
      answer.row(static_cast<Eigen::Index>(r)) =
          V.col(columns[r]).transpose() * L / basis.eigenvalues[columns[r]];
    return answer;
  }

  static int position(const Sparse& map, int row, const model::Substructure& part) {
    Sparse::InnerIterator it(map, row);
    if (!it)
      throw ModelError("Part \"" + part.name +
                       "\": a residual coordinate is not a coordinate of the coupled model.");
    return static_cast<int>(it.col());
  }

  bool tied_;
  std::string kind_;
  double independence_;
  std::unique_ptr<ReductionMethod> base_;
};

deck::ListSpec ownParameters() {
  deck::ListSpec list("Enhanced Craig-Bampton",
                      "Residual flexibility of the modes left out, as far as the inertia of the "
                      "constraint modes excites it.");
  list.choice("Residual Coordinates", std::string("Tied"), {"Tied", "Free"},
              "\"Tied\": the residual vectors follow the other coordinates by M^-1 K of the "
              "coupled model (Kim and Lee 2015), which adds no dofs but makes the "
              "coupled matrices full; \"Free\": they are coordinates of their own, one for each "
              "kept dof at most, and the model stays sparse.");
  list.real("Independence", "", 1e-6, deck::Range{0.0, 0.1, true, false},
            "The part of a residual vector, measured by mass, that must be new for it to be taken.")
      .expert();
  return list;
}

const bool registered = MethodRegistry::instance().add(
    "Enhanced Craig-Bampton",
    {"Craig-Bampton with the residual flexibility of the dropped modes (Kim and Lee 2015).",
     ownParameters(), [](const Teuchos::ParameterList& given) {
       Teuchos::ParameterList list(given);  // an absent list has no defaults
       const std::string choice = list.get("Residual Coordinates", std::string("Tied"));
       if (choice != "Tied" && choice != "Free")
         throw DeckError("\"Residual Coordinates\" is \"" + choice +
                         "\"; expected \"Tied\" or \"Free\".");
       return std::unique_ptr<ReductionMethod>(
           new EnhancedCraigBampton(choice == "Tied", list.get("Independence", 1e-6)));
     }});

}  // namespace

}  // namespace tooljoint::reduction
