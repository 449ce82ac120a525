// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Free-interface modes and residual flexibility with interface forces as coordinates: D. J. Rixen,
/// A dual Craig-Bampton method for dynamic substructuring, Journal of Computational and Applied
/// Mathematics 168 (2004) 383-391.
#include <Teuchos_ParameterList.hpp>
#include <cmath>

#include "reduction/methods/FreeInterfaceBasis.hpp"
#include "reduction/vectors/ModalVectors.hpp"

namespace tooljoint::reduction {

namespace {

/// If the modes represent the static response to a force up to this fraction, the remainder is
/// rounding and no residual flexibility.
constexpr double nothingLeft = 1e-12;

/// D = Phi p + Psi g, where Psi is the residual flexibility of the interface dofs; with g = C'
/// lambda (coupling::Assembly::Dual)
///
///     [I 0; 0 C M_r C'] (p, lambda)''
///         + [Lambda  -Phi_b' C'; -C Phi_b  -C F_r C'] (p, lambda) = ...
///     F_r = Psi_b, M_r = Psi' M Psi,
///
/// for symmetric parts; every matrix is projected completely, on Phi and Psi of the symmetric part
/// of K.
class DualCraigBampton : public ReductionMethod {
 public:
  explicit DualCraigBampton(const Teuchos::ParameterList& list)
      : residualMass_(list.get<bool>("Residual Mass")) {}

  MethodTraits traits() const override { return {false, true, false, false}; }

  Basis build(const PartView& part, const ModeRequest& request) const override {
    // Phi and Psi use the symmetric part of K: Phi' K Psi then comes only from the skew stiffness
    // and is small, and rigid-body modes are those of the elastic part.
    const auto& interface = part.part().interface;
    FreeInterfaceBasis free =
        freeInterfaceBasis(part.withBoundary({}, part.part().retained, true), request);
    Basis& basis = free.basis;
    if (interface.empty()) return std::move(basis);
    const Matrix Psi = residualAttachments(part, free);
    Triplets modal, entries;
    forEachEntry(basis.vectors,
                 [&](int i, int j, double value) { modal.emplace_back(i, j, value); });
    entries = modal;
    const auto columns = static_cast<int>(basis.vectors.cols());
    for (int j = 0; j < Psi.cols(); ++j)
      for (int i = 0; i < Psi.rows(); ++i)
        if (Psi(i, j) != 0.0)
          entries.emplace_back(basis.partition.interior[at(i)], columns + j, Psi(i, j));
    const Eigen::Index rows = basis.vectors.rows(), all = columns + Psi.cols();
    basis.vectors = sparse(rows, all, entries);
    basis.forceDofs = interface;
    basis.orthonormal = false;
    if (!residualMass_) basis.inertial = sparse(rows, all, modal);
    return std::move(basis);
  }

 private:
  /// Responses to unit forces on the interface with fixed retained dofs, minus their part in the
  /// span of the modal columns W: (1 - W (W' K W)^-1 W' K) K_II^-1 B.
  static Matrix residualAttachments(const PartView& part, const FreeInterfaceBasis& free) {
    const auto& interior = free.basis.partition.interior;
    const auto& interface = part.part().interface;
    Matrix B = Matrix::Zero(part.model().size(), sizeOf(interface));
    for (int j = 0; j < sizeOf(interface); ++j) B(interface[at(j)], j) = 1;
    B = Matrix(B(interior, Eigen::all));
    if (free.basis.modes() == sizeOf(interior)) return Matrix::Zero(B.rows(), B.cols());
    Matrix Psi = free.statics->solve(B);
    const Vector size = Psi.cwiseAbs().colwise().maxCoeff();
    const Sparse W = modalColumns(free.basis), transposed = W.transpose();
    const Sparse K = block(part.stiffness(), interior, interior),
                 M = block(part.mass(), interior, interior), absolute = K.cwiseAbs();
    for (int again = 0; again < 2; ++again) {
      Matrix amplitudes = transposed * Matrix(K * Psi);
      const Matrix inertial = transposed * Matrix(M * Psi);
      for (Eigen::Index k = 0; k < amplitudes.rows(); ++k) {
        const double omega2 = free.basis.eigenvalues[k];
        const Vector shape = Vector(W.col(k)).cwiseAbs();
        if (std::abs(omega2) > 1e-12 * shape.dot(absolute * shape))
          amplitudes.row(k) /= omega2;
        else
          amplitudes.row(k) = inertial.row(k);  // a rigid-body motion
      }
      Psi -= W * amplitudes;
    }
    for (Eigen::Index j = 0; j < Psi.cols(); ++j)
      if (Psi.col(j).cwiseAbs().maxCoeff() <= nothingLeft * size[j]) Psi.col(j).setZero();
    return Psi;
  }

  bool residualMass_;
};

deck::ListSpec dualCraigBamptonParameters() {
  deck::ListSpec list("Dual Craig-Bampton", "Mass and damping of the interface forces.");
  list.boolean(
          "Residual Mass", false,
          "Give the interface forces the mass and damping of the residual flexibility (Rixen "
          "2004). Frequencies gain an order of accuracy, but every force adds a spurious negative "
          "eigenvalue, so that motions are unstable: for `tooljoint modes` alone. Without it the "
          "forces have no mass, as in \"MacNeal\", and implicit integrators can run the model.")
      .expert();
  return list;
}

const bool dualCraigBamptonRegistered = addMethod<DualCraigBampton>(
    "Dual Craig-Bampton",
    "Free-interface modes, rigid-body ones always among them, and residual flexibility with the "
    "forces between substructures as coordinates (Rixen 2004): interfaces match weakly, "
    "frequencies may lie below the exact ones, and the mass is singular, for implicit integrators "
    "only.",
    dualCraigBamptonParameters());

}  // namespace

}  // namespace tooljoint::reduction
