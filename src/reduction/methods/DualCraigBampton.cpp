// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Free-interface modes and residual flexibility with interface forces as coordinates: D. J. Rixen,
/// A dual Craig-Bampton method for dynamic substructuring, Journal of Computational and Applied
/// Mathematics 168 (2004) 383-391.
#include <Teuchos_ParameterList.hpp>
#include <cmath>
#include <utility>

#include "reduction/methods/FreeInterfaceBasis.hpp"

namespace tooljoint::reduction {

namespace {

/// D = Phi p + Psi g, Psi the residual flexibility of the interface dofs; with g = C' lambda
/// (coupling::Assembly::Dual)
///
///     [I 0; 0 C M_r C'] (p, lambda)'' + [Lambda  -Phi_b' C'; -C Phi_b  -C F_r C'] (p, lambda) =
///     ...,   F_r = Psi_b, M_r = Psi' M Psi,
///
/// for symmetric parts; every matrix is projected full, on Phi and Psi of the symmetric part of K.
class DualCraigBampton : public ReductionMethod {
 public:
  explicit DualCraigBampton(bool residualMass) : residualMass_(residualMass) {}

  MethodTraits traits() const override { return {false, true, false, false}; }

  Basis build(const model::Substructure& part, const ModeRequest& request) const override {
    model::Substructure open = part;
    open.interface.clear();
    // Phi and Psi of the symmetric part: then Phi' K Psi is what skew stiffness makes of it,
    // little, and rigid-body modes are those of the elastic part.
    open.model.stiffness = {{"symmetric part", symmetricPart(constantStiffness(part.model)),
                             open.model.lawIndex(model::ScalarLaw::one())}};
    FreeInterfaceBasis free = freeInterfaceBasis(open, request);
    Basis& basis = free.basis;
    if (part.interface.empty()) return std::move(basis);
    const Matrix Psi = residualAttachments(part, free);
    Triplets entries;
    for (int i = 0; i < basis.vectors.outerSize(); ++i)
      for (Sparse::InnerIterator it(basis.vectors, i); it; ++it)
        entries.emplace_back(i, static_cast<int>(it.col()), it.value());
    const auto columns = static_cast<int>(basis.vectors.cols());
    for (int j = 0; j < Psi.cols(); ++j)
      for (int i = 0; i < Psi.rows(); ++i)
        if (Psi(i, j) != 0.0)
          entries.emplace_back(basis.partition.interior[static_cast<std::size_t>(i)], columns + j,
                               Psi(i, j));
    basis.vectors = Sparse(basis.vectors.rows(), columns + Psi.cols());
    basis.vectors.setFromTriplets(entries.begin(), entries.end());
    basis.boundary = part.interface;
    basis.orthonormal = false;
    if (!residualMass_) basis.inertial = withoutForces(basis.vectors, columns);
    return std::move(basis);
  }

 private:
  static Sparse withoutForces(const Sparse& vectors, int columns) {
    Triplets entries;
    for (int i = 0; i < vectors.outerSize(); ++i)
      for (Sparse::InnerIterator it(vectors, i); it; ++it)
        if (it.col() < columns) entries.emplace_back(i, static_cast<int>(it.col()), it.value());
    Sparse out(vectors.rows(), vectors.cols());
    out.setFromTriplets(entries.begin(), entries.end());
    return out;
  }

  /// Answers to unit forces on the interface with the retained dofs held, less what the modal
  /// columns W hold of them: (1 - W (W' K W)^-1 W' K) K_II^-1 B.
  static Matrix residualAttachments(const model::Substructure& part,
                                    const FreeInterfaceBasis& free) {
    const Partition& p = free.basis.partition;
    const auto interior = static_cast<Eigen::Index>(p.interior.size());
    std::vector<int> place(static_cast<std::size_t>(p.size), -1), columns;
    for (std::size_t i = 0; i < p.interior.size(); ++i)
      place[static_cast<std::size_t>(p.interior[i])] = static_cast<int>(i);
    for (int k = 0; k < free.basis.modes(); ++k)
      columns.push_back(static_cast<int>(p.kept.size()) + k);
    Matrix B = Matrix::Zero(interior, static_cast<Eigen::Index>(part.interface.size()));
    if (free.basis.modes() == interior) return B;  // nothing is left
    for (std::size_t j = 0; j < part.interface.size(); ++j)
      B(place[static_cast<std::size_t>(part.interface[j])], static_cast<Eigen::Index>(j)) = 1;
    Matrix Psi = free.statics->solve(B);
    const Sparse W = block(free.basis.vectors, p.interior, columns),
                 M = block(part.model.mass, p.interior, p.interior);
    const Sparse transposed = W.transpose();
    const Sparse K = block(constantStiffness(part.model), p.interior, p.interior),
                 absolute = K.cwiseAbs();
    for (int again = 0; again < 2; ++again) {
      Matrix amplitudes = transposed * Matrix(K * Psi);
      const Matrix inertial = transposed * Matrix(M * Psi);
      for (Eigen::Index k = 0; k < amplitudes.rows(); ++k) {
        const double omega2 = free.basis.eigenvalues[k];
        const Vector size = Vector(W.col(k)).cwiseAbs();
        if (std::abs(omega2) > 1e-12 * size.dot(absolute * size))
          amplitudes.row(k) /= omega2;
        else
          amplitudes.row(k) = inertial.row(k);  // a rigid-body motion
      }
      Psi -= W * amplitudes;
    }
    return Psi;
  }

  bool residualMass_;
};

deck::ListSpec parameters() {
  deck::ListSpec list("Dual Craig-Bampton", "What goes with the forces between substructures.");
  list.boolean("Residual Mass", false,
               "Give the forces the mass and damping of the residual flexibility, as Rixen 2004: "
               "frequencies gain an order of accuracy, but for every force the model "
               "has a spurious negative eigenvalue, with which motions grow without bound: for "
               "`tooljoint modes` alone. Without it the forces have no mass, as in "
               "\"MacNeal\", and implicit integrators run the model.")
      .expert();
  return list;
}

const bool registered = MethodRegistry::instance().add(
    "Dual Craig-Bampton",
    {"Free-interface modes, rigid-body ones always among them, and residual flexibility with the "
     "forces between substructures as coordinates (Rixen 2004): "
     "interfaces match weakly, frequencies may lie below the exact ones, and the mass is singular, "
     "for implicit integrators only.",
     parameters(), [](const Teuchos::ParameterList& list) {
       return std::unique_ptr<ReductionMethod>(new DualCraigBampton(
           list.isParameter("Residual Mass") && list.get<bool>("Residual Mass")));
     }});

}  // namespace

}  // namespace tooljoint::reduction
