// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Craig-Bampton with the residual flexibility of the dropped modes: J.-G. Kim, P.-S. Lee, An
/// enhanced Craig-Bampton method, Int. J. Numer. Meth. Engng 103 (2015) 79-93. With F = K_II^-1 -
/// Phi_D Lambda^-1 Phi_D' and the inertia of the constraint modes L = M_IC + M_II psi, the dropped
/// modes respond with x_I = lambda F L u_C to first order in lambda; O'Callahan's step replaces
/// lambda u_C by the rows of M^-1 K of the coupled Craig-Bampton model.
#include <Eigen/Dense>
#include <Teuchos_ParameterList.hpp>
#include <cmath>
#include <string>

#include "common/Error.hpp"
#include "reduction/methods/BasisBuilder.hpp"
#include "reduction/vectors/FixedInterfaceModes.hpp"
#include "reduction/vectors/ModalVectors.hpp"

namespace tooljoint::reduction {

namespace {

const std::string freeKind = "residual";
/// Smallest fraction of a residual vector (mass norm) that is independent of the other vectors.
constexpr double independentResidual = 1e-6;

class EnhancedCraigBampton : public ReductionMethod {
 public:
  explicit EnhancedCraigBampton(const Teuchos::ParameterList& list)
      : tied_(list.get<std::string>("Residual Coordinates") == "Tied"),
        kind_(tied_ ? followingKind : freeKind) {}

  MethodTraits traits() const override { return {true, false, tied_, true}; }

  Basis build(const PartView& part, const ModeRequest& request) const override {
    return fixedInterfaceBasis(part, fixedInterfaceModes(part, request));
  }

  /// Adds W, an orthonormal basis of F L, to every part that has dropped modes.
  bool augment(const model::SecondOrderModel&, const std::vector<std::vector<int>>&,
               const std::vector<PartView>& parts, std::vector<Basis>& bases) const override {
    bool changed = false;
    for (std::size_t p = 0; p < parts.size(); ++p) {
      if (contains(bases[p].modeKind, kind_) ||
          bases[p].modes() >= sizeOf(bases[p].partition.interior))
        continue;
      changed = appendVectors(parts[p], residualVectors(parts[p], bases[p]), kind_,
                              independentResidual, false, bases[p]) > 0 ||
                changed;
    }
    return changed;
  }

  /// The coordinates eta of W depend on the others z: their modal equation is (Lambda_W - lambda)
  /// eta = lambda W' L u_C to first order in lambda, with lambda u_C = L_C M^-1 K z,
  ///
  ///     eta = Lambda_W^-1 W' L L_C M^-1 K z,   which equals W' (F L) L_C M^-1 K z.
  DependentCoordinates dependentCoordinates(const model::SecondOrderModel& coupled,
                                            const std::vector<Sparse>& maps,
                                            const std::vector<PartView>& parts,
                                            const std::vector<Basis>& bases) const override {
    DependentCoordinates dependent;
    if (!tied_) return dependent;
    std::vector<Matrix> answers;  // per part: eta from lambda u_C
    for (std::size_t p = 0; p < parts.size(); ++p) {
      const std::vector<int> modes = residualModes(bases[p]);
      answers.push_back(quasiStatic(parts[p], bases[p], modes));
      for (int k : modes)
        dependent.dofs.push_back(
            position(maps[p], sizeOf(bases[p].partition.boundary) + k, parts[p]));
    }
    if (dependent.dofs.empty()) return dependent;
    std::vector<char> follows(at(coupled.size()), 0);
    for (int i : dependent.dofs) follows[at(i)] = 1;
    std::vector<int> others;
    for (int i = 0; i < coupled.size(); ++i)
      if (!follows[at(i)]) others.push_back(i);
    // Rows of L_C M^-1 K, from M x = L_C' and K x.
    const Sparse M = symmetricPart(block(coupled.mass, others, others)),
                 K = symmetricPart(block(stiffnessAtStart(coupled), others, others));
    const Eigen::LLT<Matrix> factor{Matrix(M)};
    if (factor.info() != Eigen::Success)
      throw ModelError(
          "\"Enhanced Craig-Bampton\" needs the inverse of the coupled mass, which is not positive "
          "definite. Give every boundary dof a mass, set Coupling/Assembly to \"Primal\", or set "
          "\"Residual Coordinates\" to \"Free\".");
    dependent.rows.resize(sizeOf(dependent.dofs), sizeOf(others));
    Eigen::Index row = 0;
    for (std::size_t p = 0; p < parts.size(); ++p) {
      if (answers[p].rows() == 0) continue;
      const Matrix drive =
          answers[p] * Matrix(block(maps[p], range(sizeOf(bases[p].partition.boundary)), others));
      dependent.rows.middleRows(row, drive.rows()) =
          (K * factor.solve(drive.transpose())).transpose();
      row += drive.rows();
    }
    return dependent;
  }

 private:
  /// Includes the terms with a law of time, and the tangents of springs and other point laws: they
  /// restrain the boundary dofs too.
  static Sparse stiffnessAtStart(const model::SecondOrderModel& model) {
    return model.stiffnessAt(0.0) +
           model.pointStiffness(0.0, model.initialDisplacement, model.initialVelocity);
  }

  /// F L = K_II^-1 L - Phi_D Lambda^-1 Phi_D' L with the symmetric part of K; blocks that touch no
  /// boundary dof have no L.
  static Matrix residualVectors(const PartView& part, const Basis& basis) {
    const Matrix L = constraintInertia(part, basis), V = modalColumns(basis);
    Matrix X = part.solveSymmetricInterior(L);
    for (Eigen::Index k = 0; k < V.cols(); ++k)
      X -= V.col(k) * ((V.col(k).transpose() * L) / basis.eigenvalues[k]);
    // columns of F L that are large relative to their terms; the others are rounding
    std::vector<int> real;
    for (int j = 0; j < X.cols(); ++j) {
      double scale = 0;
      for (Eigen::Index k = 0; k < V.cols(); ++k)
        scale = std::max(scale, std::abs(V.col(k).dot(L.col(j)) / basis.eigenvalues[k]) *
                                    V.col(k).cwiseAbs().maxCoeff());
      if (X.col(j).cwiseAbs().maxCoeff() > 1e-11 * scale) real.push_back(j);
    }
    return X(Eigen::all, real);
  }

  std::vector<int> residualModes(const Basis& basis) const {
    std::vector<int> modes;
    for (int k = 0; k < basis.modes(); ++k)
      if (basis.modeKind[at(k)] == kind_) modes.push_back(k);
    return modes;
  }

  /// Lambda_W^-1 W' L of a part, residual coordinates x boundary dofs.
  static Matrix quasiStatic(const PartView& part, const Basis& basis,
                            const std::vector<int>& modes) {
    Matrix answer(sizeOf(modes), sizeOf(basis.partition.boundary));
    if (modes.empty()) return answer;
    const Matrix V = modalColumns(basis), L = constraintInertia(part, basis);
    for (int r = 0; r < sizeOf(modes); ++r) {
      const int k = modes[at(r)];
      answer.row(r) = V.col(k).transpose() * L / basis.eigenvalues[k];
    }
    return answer;
  }

  static int position(const Sparse& map, int row, const PartView& part) {
    Sparse::InnerIterator it(map, row);
    if (!it)
      throw ModelError(part.who() +
                       "a residual coordinate is not a coordinate of the coupled model.");
    return static_cast<int>(it.col());
  }

  bool tied_;
  std::string kind_;
};

deck::ListSpec enhancedCraigBamptonParameters() {
  deck::ListSpec list("Enhanced Craig-Bampton",
                      "Residual flexibility of the modes left out, as far as the inertia of the "
                      "constraint modes excites it.");
  list.removed({"Independence"},
               "the part of a vector that must be new is a constant. Leave it out.");
  list.choice(
      "Residual Coordinates", std::string("Tied"), {"Tied", "Free"},
      "\"Tied\": the residual coordinates depend on the others by M^-1 K of the coupled model (Kim "
      "and Lee 2015); this adds no dofs but fills the coupled matrices. \"Free\": they are "
      "independent coordinates, at most one for each boundary dof, and the model stays sparse.");
  return list;
}

const bool enhancedCraigBamptonRegistered = addMethod<EnhancedCraigBampton>(
    "Enhanced Craig-Bampton",
    "Craig-Bampton with the residual flexibility of the dropped modes (Kim and Lee 2015).",
    enhancedCraigBamptonParameters());

}  // namespace

}  // namespace tooljoint::reduction
